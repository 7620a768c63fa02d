// SPDX-License-Identifier: Apache-2.0
/// Says of a daemon whose threads stall whether something old is served as good or sent, whether a station
/// leaves whose line and drive were well, and whether each output gets what it owes. It
/// knows what was on the wire, what the PLCs and the operator want and when each thread stalled, and nothing
/// of how the program decides.
#pragma once

#include "drive_line/simulated_line.hpp"
#include "timeline.hpp"

#include "dpslave/drive/poller.hpp"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::stalls {

using drive_line::SimulatedLine;
using drive_line::SimulatedTag;

struct StationRules {
    drive::WhenLost when = drive::WhenLost::silent;
    Time after = 2s;
    drive::ZeroAfter zero_after = 0ns;
};

class StallJudge {
public:
    /// `answers_late`: the drives do so by up to ten timeouts.
    StallJudge(SimulatedLine& line, std::vector<StationRules> rules, int retries, bool answers_late);

    // When they stall; the script tells it.
    Timeline line_thread, bus_thread, main_thread;
    /// A call of the port has come back after so long that what it had not sent is thrown away.
    void call_came_back(Instant now);
    /// The drive has answered a question, as the program took it.
    void has_answered(std::uint8_t unit, Instant now);
    /// Octets leave that stood in such a call.
    void sent_on(Instant now);

    // On the bus.
    void is_on_the_bus(std::size_t drive, bool is_on, Instant now);
    void serves(std::size_t drive, Instant now);
    void shows(std::size_t drive, std::uint16_t tag, std::uint16_t word, Instant chosen_at, Instant now);
    void asks_for_diagnosis(std::size_t drive, bool asks, Instant now);
    void wants(std::size_t drive, std::uint16_t tag, std::uint16_t word, Instant now);
    /// `is_taken`: for certain; a station that asks for diagnosis need not.
    void demands(std::size_t drive, std::optional<std::uint16_t> word, bool is_taken, Instant now);

    // At the control socket.
    void views(std::size_t drive, const drive::DriveSnapshot& snapshot, Instant now);
    void orders(std::uint32_t number, std::size_t drive, std::optional<std::uint16_t> word);
    void fails(std::uint32_t number, bool is_known, Instant now);
    void answers(const drive::OperateAnswer& answer, Instant now);

    /// The line is removed from the configuration, and its thread has ended.
    void leaves(Instant now);
    void has_left(Instant now);
    /// The line goes round.
    void line_turn(Instant now);

    /// What is still wrong when all goes round again; empty: nothing.
    std::string not_settled(std::size_t drive) const;

    std::uint64_t departures() const { return departures_; }
    const std::optional<std::string>& violation() const { return violation_; }
    void report_violation(Instant now, const std::string& text);

private:
    /// Threads look at one another at least this often, and give a sign as often.
    static constexpr Time kLook = 100ms;
    static constexpr int kSafeState = -1; ///< the layout has ended: 0, or nothing at all
    struct Wanted {
        Instant from;
        int word;
    };
    struct Output {
        std::vector<Wanted> wanted;         ///< the last one is wanted now
        std::optional<Instant> owes_zero{}; ///< since the master was taken for lost by its line
    };
    struct Demand {
        std::uint16_t word;
        Instant superseded_at = kNever;
    };
    struct Order {
        std::size_t drive = 0;
        std::optional<std::uint16_t> word; ///< of a write
        std::optional<Instant> failed_at{};
        bool is_known = true; ///< it was said that it was not carried out
    };
    struct Record {
        bool is_on = false, asks = false;
        Instant attached_at{};
        Instant answered_at{};
        std::optional<Instant> zeroed_at; ///< an output, where no zero was wanted: then it leaves at once
        std::deque<Instant> heard_at;     ///< valid for certain, the newest last
        Instant died_at{};                ///< it was dead then, the last time
        Instant unwell_at{};              ///< it may have been gone then, the last time
        std::map<std::uint16_t, Output> outputs;
        std::map<std::uint16_t, std::size_t> shown; ///< place in the history of the tag
        std::vector<Demand> demands;
        std::map<std::uint16_t, std::uint16_t> last{}; ///< word shown last in this layout
        Instant chosen_at{};
    };

    template <class... Args>
    void trace(Instant now, fmt::format_string<Args...> text, Args&&... args) const
    {
        if (line_.traces()) line_.trace(at(now) + fmt::format(text, std::forward<Args>(args)...));
    }
    static std::string at(Instant now)
    {
        return fmt::format("{:.1f} ms: ", static_cast<double>(now.time_since_epoch().count()) / 1e6);
    }

    void was_written(std::size_t drive, const SimulatedTag& tag, std::uint16_t word);
    void judge_output(std::size_t drive, std::uint16_t tag, std::uint16_t word, Instant handed);
    void judge_demand(std::size_t drive, std::uint16_t word, Instant handed);
    void judge_order(std::size_t drive, std::uint16_t word, Instant handed);
    bool was_unwell(std::size_t drive, Instant now) const;
    void judge_leaving(std::size_t drive, const char* what, Instant now);
    bool is_overtaken(std::size_t drive, Instant superseded_at, Instant handed) const;
    Instant was_judged_until(std::size_t drive, Instant handed) const;
    bool zero_is_allowed(std::size_t drive) const { return rules_[drive].zero_after.has_value(); }
    void end_layout(std::size_t drive, Instant now);
    void lose_master(Instant now);
    void note_heard(Instant now);
    void judge_zeros(Instant now);

    Instant may_be_heard(std::size_t drive) const;
    Instant was_heard(std::size_t drive, Instant now) const;
    Time question() const;
    Time may_stay(std::size_t drive) const;
    Time silence_of_line(const Timeline& judging, Instant now) const;
    std::string why_gone(std::size_t drive, const Timeline& judging, Instant now) const;
    static Time with_looks(const Timeline& judging, Instant from, Instant to);

    SimulatedLine& line_;
    std::vector<StationRules> rules_;
    int retries_;
    bool answers_late_;
    Instant begins_;
    std::vector<Record> records_;
    std::map<std::uint32_t, Order> orders_;
    Instant came_back_at_{}, stalled_from_{};                 ///< of the last call that took so long
    Instant bus_lost_at_{}, main_lost_at_{}, main_left_at_{}; ///< such a stall was long enough then
    Instant removed_at_ = kNever;                             ///< then the bus judges the line no more
    std::size_t bus_noted_ = 0, main_noted_ = 0;              ///< stalls that count as a loss of the master
    std::uint64_t departures_ = 0;
    std::optional<std::string> violation_;
};

} // namespace dpslave::stalls
