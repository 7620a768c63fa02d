// SPDX-License-Identifier: Apache-2.0
/// What goes over a drive line, frame by frame, with the judgement of each answer: for a recorder. Both
/// clients note it. Pure, and nothing is allocated.
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

/// What became of something that was heard (OwedAnswers has the rules).
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
    bad_checksum,  ///< whole but for its check sum
    bad_character, ///< with a parity fault, or a character that no frame has
    truncated,     ///< it broke off
    no_frame,      ///< noise, or what came behind something that was no frame
};
inline constexpr std::size_t kJudgements = 14;
/// "taken", "wrong check sum"
std::string_view text(Judgement judgement) noexcept;
/// For programs: "bad_checksum"
std::string_view name(Judgement judgement) noexcept;
/// A frame that was taken, or is an echo: all went well.
constexpr bool is_good(Judgement judgement)
{
    return judgement == Judgement::taken || judgement == Judgement::older || judgement == Judgement::echo;
}

struct LineFrame {
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
    virtual void on_frame(const LineFrame& frame) = 0;

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
    void came(Bytes octets, Instant read_at);
    /// Of all that came since the judgement before.
    void judge(Judgement judgement);
    /// The same, and what comes from now on until silence() belongs to it.
    void judge_until_silence(Judgement judgement) { until_silence_ = judgement; }
    /// What came and was not judged is no frame.
    void silence();
    /// The wait is over without an answer.
    void no_answer(Instant now);

private:
    /// More than the longest frame of both protocols (256 octets of Modbus).
    static constexpr std::size_t kMost = 300;
    void emit(LineFrame::What what, Judgement judgement, Instant begun, Instant at, Bytes octets);

    FrameListener* listener_;
    LineProtocol protocol_;
    std::chrono::nanoseconds character_;
    std::uint8_t drive_ = 0;
    ByteBuffer<kMost> octets_{};
    Instant first_read_{}, last_read_{};
    std::optional<Judgement> until_silence_;
};

} // namespace dpslave::drive
