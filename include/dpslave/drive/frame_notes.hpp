// SPDX-License-Identifier: Apache-2.0
/// Notes what goes over a drive line, frame by frame, with the judgement of each answer: for a recorder. Both
/// clients note it. It is pure and allocates nothing.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::drive {

enum class LineProtocol : std::uint8_t { ei_ascii, modbus_rtu };
inline constexpr std::size_t kLineProtocols = 2;

/// The result for something that was heard (OwedAnswers has the rules).
enum class Judgement : std::uint8_t {
    taken,         ///< the answer to the question asked last, and to no other
    refused,       ///< the same, and the drive refuses: EOT, NAK, an exception
    older,         ///< right, but it may answer an older question: no proof of a write
    before_write,  ///< it may be older than the last write of this tag: not taken
    doubtful,      ///< an ACK that may belong to another write
    late,          ///< answers an older question, whose wait was over
    unclear,       ///< an EOT, NAK or ACK that nothing waits for
    duplicate,     ///< of a frame since the last question
    foreign,       ///< answers nothing that was asked
    echo,          ///< of the question
    bad_checksum,  ///< complete, but its checksum is wrong
    bad_character, ///< with a parity error, or a character that no frame has
    truncated,     ///< it broke off
    no_frame,      ///< noise, or octets after something that was no frame
    early,         ///< it began before the question had left: it answers nothing
    noise_before,  ///< octets before a frame that are no part of it
};
inline constexpr std::size_t kJudgements = 16;
/// Returns the judgement in words: "taken", "wrong checksum".
std::string_view text(Judgement judgement) noexcept;
/// Returns the judgement for programs: "bad_checksum".
std::string_view name(Judgement judgement) noexcept;
/// Returns whether the frame was accepted or is an echo.
constexpr bool is_good(Judgement judgement)
{
    return judgement == Judgement::taken || judgement == Judgement::older || judgement == Judgement::echo;
}

struct TracedFrame {
    enum class What : std::uint8_t {
        sent,
        heard,   ///< judged
        silence, ///< the wait for the answer is over; no octets
    };
    What what = What::sent;
    LineProtocol protocol = LineProtocol::ei_ascii;
    std::uint8_t drive =
        0; ///< that was asked last: the unit of Modbus; of EI-ASCII group and unit, 4 bits each
    Judgement judgement = Judgement::taken; ///< of something heard
    /// Begin of the first and end of the last character. Sent: the second is computed, heard: the first.
    Instant begun{}, at{};
    Bytes octets{}; ///< as on the wire, valid during the call
};

class FrameListener {
public:
    /// May not block.
    virtual void on_frame(const TracedFrame& frame) = 0;

protected:
    ~FrameListener() = default;
};

/// Collects what comes until it is judged, for one client.
class FrameNotes {
public:
    /// `listener` outlives this object; null: nobody listens. `character`: its time on the line.
    FrameNotes(FrameListener* listener, LineProtocol protocol, std::chrono::nanoseconds character)
        : listener_(listener), protocol_(protocol), character_(character)
    {}

    /// A question to `drive`, handed to the line at `begun`.
    void sent(std::uint8_t drive, Bytes octets, Instant begun);
    /// Octets that were read at `read_at`, not judged yet.
    void received(Bytes octets, Instant read_at);
    /// Judges everything that came since the judgement before.
    void judge(Judgement judgement);
    /// Judges like judge(), and octets from now on until silence() belong to it.
    void judge_until_silence(Judgement judgement) { until_silence_ = judgement; }
    /// The line is silent: octets that came and were not judged are no frame.
    void silence();
    /// The wait is over without an answer.
    void no_answer(Instant now);

private:
    /// More than the longest frame of both protocols (256 octets of Modbus).
    static constexpr std::size_t kMost = 300;
    void emit(TracedFrame::What what, Judgement judgement, Instant begun, Instant at, Bytes octets);

    FrameListener* listener_;
    LineProtocol protocol_;
    std::chrono::nanoseconds character_;
    std::uint8_t drive_ = 0;
    ByteBuffer<kMost> octets_{};
    Instant first_read_{}, last_read_{};
    std::optional<Judgement> until_silence_;
};

} // namespace dpslave::drive
