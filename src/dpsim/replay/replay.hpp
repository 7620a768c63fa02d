// SPDX-License-Identifier: Apache-2.0
/// The master's side of a capture, sent again, and the answers compared with those of the capture. It is
/// pure: octets and times go in, telegrams, deadlines and lines come out.
#pragma once

#include "answer_judge.hpp"

#include "dpslave/base/units.hpp"

namespace dpslave::sim {

struct ReplaySettings {
    Baud baud = Baud::k187_5;
    bool in_time = true;  ///< with the pauses of the capture; else as soon as the bus allows
    unsigned retries = 3; ///< of a telegram that was answered in the capture, and is not now
    std::chrono::nanoseconds allowance = std::chrono::milliseconds{20}; ///< beyond the slot time
};

struct ReplayCounters {
    std::uint64_t sent = 0;     ///< telegrams, without retries
    std::uint64_t compared = 0; ///< answers
    std::uint64_t masked = 0;   ///< of them: not octet by octet
    std::uint64_t retries = 0;
    std::uint64_t differences = 0; ///< answers that are others, missing, or were not asked for
};

/// Call after every on_*: take_transmit(), then take_lines(), then next_deadline(), until done().
class Replay {
public:
    /// The script outlives this object. It begins at `now`.
    Replay(const ReplayScript& script, DriveSide drive, const ReplaySettings& settings, Instant now);

    void on_bytes(Bytes octets, Instant now);
    void on_time(Instant now);
    /// A telegram to be written now; the slot time runs from `now` plus its length on the wire.
    std::optional<Octets> take_transmit(Instant now);
    Instant next_deadline() const;
    /// All was sent, and the last answer is judged.
    bool done() const { return is_done_; }

    /// Differences, in sentences that name the packets.
    std::vector<std::string> take_lines() { return std::exchange(lines_, {}); }
    const ReplayCounters& counters() const { return counters_; }
    /// The place in the capture, for the drive side: when its present packet was on the line.
    std::chrono::nanoseconds capture_time() const;

private:
    const ReplayStep& step() const { return script_.steps[next_]; }
    Instant due() const;
    void answered(Instant now);
    void unanswered(Instant now);
    void go_on(Instant idle_until);
    void unasked(Bytes octets);

    const ReplayScript& script_;
    ReplaySettings settings_;
    AnswerJudge judge_;
    ReplayCounters counters_;

    std::size_t next_ = 0; ///< the step that is sent next, or waits for its answer
    bool waits_ = false;   ///< for an answer
    bool again_ = false;   ///< the telegram is to be repeated
    bool is_done_ = false;
    bool is_reported_ = false; ///< octets that were not asked for, since the last telegram
    unsigned tries_ = 0;
    Octets rx_;
    Instant last_begin_; ///< of the last telegram or answer
    Instant idle_until_; ///< the bus has to be silent until then
    Instant give_up_{};
    std::vector<std::string> lines_;
};

/// Returns for the end what was sent, compared and found.
std::string in_words(const ReplayCounters& counters);

} // namespace dpslave::sim
