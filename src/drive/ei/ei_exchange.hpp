// SPDX-License-Identifier: Apache-2.0
/// One question on an EI-ASCII line and what is heard until its wait is over: takes the echo away, makes
/// frames of octets and lets OwedAnswers say whose they are.
#pragma once

#include "dpslave/drive/ei_ascii_client.hpp"
#include "dpslave/drive/owed_answers.hpp"
#include "dpslave/drive/wire_time.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace dpslave::drive::ei {

/// Removes the echo of a request from the octets that are heard. No answer looks like a request, because EOT
/// with more octets after it is no answer.
class EchoFilter {
public:
    explicit EchoFilter(EchoMode mode) : mode_(mode) {}

    void sent(Bytes request);
    /// Appends what is no echo. Returns true if this was the last octet of the echo.
    bool feed(std::uint8_t octet, std::string& out);
    void silence(std::string& out); ///< what looked like an echo until now was none
    bool withholds() const { return matched_ > 0; }
    Bytes echo() const { return bytes_of(echo_); } ///< the last one that was heard completely

private:
    EchoMode mode_;
    std::string expected_; ///< empty = there is none any more
    std::size_t matched_ = 0;
    std::string echo_;
};

DriveNumber number_of(UnitAddress unit);

/// Notices requests that come back although the line has no echo by its settings. The octets of one may come
/// while the next one is already waited for.
class EchoWatch {
public:
    void sent(Bytes request);
    bool feed(std::uint8_t octet); ///< true: the complete request has come back

private:
    std::string last_, before_; ///< requests
    std::string heard_;
};

class Exchange {
public:
    Exchange(SerialLine& line, EiTiming timing);

    /// The way in which the wait for an answer ended.
    enum class End : std::uint8_t {
        value,    ///< answer(): to this question and no other
        older,    ///< answer(): right, but no proof of a write
        before,   ///< a value that may be older than the last write of this tag
        ack,      ///< of this write
        doubtful, ///< an ACK that may be of another write
        refused,  ///< a lone EOT or NAK, which names nothing: EE is asked next
        silence,
        damaged,
        not_asked, ///< the answer could not have been taken
    };

    End poll(UnitAddress unit, Mnemonic mnemonic);
    End select(UnitAddress unit, Mnemonic mnemonic, std::string_view text);
    const std::string& answer() const { return answer_; }   ///< the text of a value
    const std::string& trouble() const { return trouble_; } ///< why there is no answer; empty = there is

    /// Judges what has come since the last question, and forgets owed answers that have expired.
    void listen() { fall_silent(); }
    bool may_poll(UnitAddress unit, Mnemonic mnemonic); ///< no other drive owes it
    bool owes(UnitAddress unit, Mnemonic mnemonic) const;
    bool is_owed(Mnemonic mnemonic) const; ///< by any drive
    /// The last question got on the line.
    bool has_sent() const { return has_sent_; }
    AnswerCounts counts(UnitAddress unit) const;
    /// The drive says that the checksum of a request was wrong.
    void note_not_accepted(UnitAddress unit) { owed_.not_accepted(number_of(unit)); }

private:
    enum class WaitsFor : std::uint8_t { nothing, value, ack };

    End ask(const Question& question, Bytes request, WaitsFor what);
    End wait(Instant begins_by, WaitsFor what);
    bool fall_silent();
    void hear(Bytes octets, std::string& out);
    std::optional<End> take(std::string_view octets, WaitsFor what);
    std::optional<End> take_frame(const Answer& frame, bool is_alone, WaitsFor what);
    bool refuse_early();
    std::optional<End> take_value(const Answer& frame, WaitsFor what);
    std::optional<End> broken(Flaw flaw, WaitsFor what);
    bool in_frame() const { return parser_.has_value() || skips_ || echo_.withholds(); }
    std::chrono::nanoseconds duration_of(std::size_t count) const;
    std::chrono::nanoseconds gap() const;

    SerialLine& line_;
    EiTiming timing_;
    OwedAnswers owed_;
    EchoFilter echo_;
    EchoWatch echo_watch_;
    FrameNotes notes_;
    std::optional<AnswerParser> parser_; ///< of a frame that has begun
    FrameBegin begin_;                   ///< of the same frame
    bool heard_noise_ = false;           ///< since the line was silent, or before that frame
    bool skips_ = false;                 ///< what comes until the next gap is the rest of something broken
    DriveNumber asked_ = 0;
    Mnemonic asked_for_{};
    Instant heard_at_{};
    std::string answer_;
    bool has_sent_ = false;
    std::string trouble_;
};

} // namespace dpslave::drive::ei
