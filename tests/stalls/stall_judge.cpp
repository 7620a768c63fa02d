// SPDX-License-Identifier: Apache-2.0
#include "stall_judge.hpp"

#include <algorithm>

namespace dpslave::stalls {
namespace {

/// no sign of the bus thread, or of the main thread, for so long is a loss of the master.
constexpr Time kBusIsLost = 1s, kMainIsLost = 2500ms;
constexpr std::int64_t kFurtherQuestions = 4;

double seconds(Time time)
{
    return std::chrono::duration<double>(time).count();
}

} // namespace

StallJudge::StallJudge(SimulatedLine& line, std::vector<StationRules> rules, int retries, bool answers_late)
    : line_(line),
      rules_(std::move(rules)),
      retries_(retries),
      answers_late_(answers_late),
      begins_(line.time),
      records_(line.drives.size())
{
    for (std::size_t i = 0; i < records_.size(); ++i)
        for (const SimulatedTag& tag : line_.drives[i].tags)
            if (tag.use == drive_line::TagUse::output)
                records_[i].outputs[tag.number].wanted.push_back({begins_, kSafeState});
    line_.on_write = [this](std::size_t drive, SimulatedTag& tag, std::uint16_t word, Instant) {
        was_written(drive, tag, word);
    };
}

void StallJudge::report_violation(Instant now, const std::string& text)
{
    if (!violation_) violation_ = at(now) + text;
}

void StallJudge::call_came_back(Instant now)
{
    trace(now, "the call comes back");
    came_back_at_ = now;
    stalled_from_ = line_thread.from() - kLook;
    for (Record& one : records_) // what it was about to fetch is no answer
        while (!one.heard_at.empty() && one.heard_at.back() > stalled_from_) one.heard_at.pop_back();
}

// ---- what may be shown

void StallJudge::has_answered(std::uint8_t unit, Instant now)
{
    for (std::size_t i = 0; i < records_.size(); ++i)
        if (line_.drives[i].unit == unit) records_[i].answered_at = now;
}

/// The last whole answer of the drive that was on the wire.
Instant StallJudge::may_be_heard(std::size_t drive) const
{
    return std::max({line_.drives[drive].spoke_at, records_[drive].answered_at, begins_});
}

void StallJudge::note_heard(Instant now)
{
    constexpr std::size_t kKept = 64;
    for (std::size_t i = 0; i < records_.size(); ++i) {
        Record& record = records_[i];
        const Instant named = line_.drives[i].named_at;
        const Instant at = std::max(named <= now ? named : Instant{}, record.answered_at);
        if (at > stalled_from_ && at <= came_back_at_) continue;
        if (at == Instant{} || (!record.heard_at.empty() && at <= record.heard_at.back())) continue;
        record.heard_at.push_back(at);
        if (record.heard_at.size() > kKept) record.heard_at.pop_front();
    }
}

/// The last one that is valid for certain, when the line decided what the bus sees now.
Instant StallJudge::was_heard(std::size_t drive, Instant now) const
{
    const auto& all = records_[drive].heard_at;
    const auto last = std::find_if(all.rbegin(), all.rend(), [&](Instant at) { return at <= now - kLook; });
    return last != all.rend() ? *last : begins_;
}

/// A question that is not answered: the timeout, itself and the longest answer, and the pause behind noise.
Time StallJudge::question() const
{
    constexpr std::int64_t kCharacters = 100;
    return 20ms + line_.rules().timeout + kCharacters * line_.rules().character + line_.rules().port_holds;
}

/// For how long without an answer, as LossJudge has it.
Time StallJudge::may_stay(std::size_t drive) const
{
    const auto drives = static_cast<std::int64_t>(records_.size());
    const Time settle = 10 * line_.rules().timeout + line_.rules().port_holds;
    const Time further = 5 * drives * (kFurtherQuestions + retries_ + 1) * question();
    return 350ms + (retries_ + 1) * question() + std::max({Time{rules_[drive].after}, settle, further});
}

Time StallJudge::silence_of_line(const Timeline& judging, Instant now) const
{
    return line_thread.is_stalled() ? judging.ran(line_thread.from(), now) : 0ns;
}

/// Empty: it need not be gone.
std::string StallJudge::why_gone(std::size_t drive, const Timeline& judging, Instant now) const
{
    const Time silent = silence_of_line(judging, now);
    if (silent > rules_[drive].after + 2 * kLook)
        return fmt::format("its line gave no sign for {:.3f} s, {:.3f} s are allowed", seconds(silent),
                           seconds(rules_[drive].after));
    const Instant from = may_be_heard(drive);
    if (from >= now) return {};
    const Time unheard = line_thread.ran(from, now) - ((now - from) - judging.ran(from, now));
    if (unheard > may_stay(drive))
        return fmt::format("its drive was not heard for {:.3f} s, {:.3f} s are allowed", seconds(unheard),
                           seconds(may_stay(drive)));
    return {};
}

/// The Data_Exchange of a PLC has brought inputs that it takes for good.
void StallJudge::serves(std::size_t drive, Instant now)
{
    if (rules_[drive].when == drive::WhenLost::hold) return;
    if (const std::string why = why_gone(drive, bus_thread, now); !why.empty())
        report_violation(now,
                         fmt::format("the station of drive {} serves words as good, and {}", drive, why));
}

void StallJudge::views(std::size_t drive, const drive::DriveSnapshot& snapshot, Instant now)
{
    const auto is_good = [](WordState state) { return state == WordState::good; };
    const bool any = std::ranges::any_of(snapshot.states, is_good) ||
                     std::ranges::any_of(snapshot.watched, is_good, &drive::Watched::state);
    if (!any) return;
    if (const std::string why = why_gone(drive, main_thread, now); !why.empty())
        report_violation(now, fmt::format("words of drive {} are shown as good, and {}", drive, why));
}

/// It was held by this tag at or after the word shown before, and in a new layout since that was chosen.
void StallJudge::shows(std::size_t drive, std::uint16_t number, std::uint16_t word, Instant chosen_at,
                       Instant now)
{
    Record& record = records_[drive];
    if (std::exchange(record.chosen_at, chosen_at) != chosen_at) record.last.clear();
    const auto known = record.last.find(number);
    if (known != record.last.end() && known->second == word) return;
    const bool is_first = known == record.last.end();
    if (is_first && word == 0) return; // not read yet
    line_.drives[drive].live_until(now, line_.words(), line_.chance());
    const auto& history = line_.drives[drive].find(number)->history;
    std::size_t& shown = record.shown[number];
    for (std::size_t at = shown; at < history.size(); ++at) {
        const bool was_over = at + 1 < history.size() && history[at + 1].from < chosen_at;
        if (history[at].word != word || (is_first && was_over)) continue;
        shown = at;
        record.last[number] = word;
        return;
    }
    report_violation(now,
                     fmt::format("the station of drive {} shows {:04X} for tag {}, which it has not held "
                                 "since the word before",
                                 drive, word, number));
}

// ---- who leaves

/// How long another one stalled as it may have lived it: each of its own stalls may count as one look.
Time StallJudge::with_looks(const Timeline& judging, Instant from, Instant to)
{
    return judging.ran(from, to) + kLook * (judging.stalls_in(from, to) + 1);
}

void StallJudge::is_on_the_bus(std::size_t drive, bool is_on, Instant now)
{
    Record& record = records_[drive];
    if (!line_.drives[drive].alive) record.died_at = now;
    if (main_thread.is_stalled() && with_looks(bus_thread, main_thread.from(), now) >= kMainIsLost)
        main_left_at_ = now;
    const bool left = record.is_on && !is_on;
    if (record.is_on != is_on) trace(now, "station {} is {} the bus", drive, is_on ? "on" : "off");
    if (!record.is_on && is_on) record.attached_at = now;
    record.is_on = is_on;
    if (!is_on) record.zeroed_at.reset();
    if (record.zeroed_at && bus_thread.ran(*record.zeroed_at, now) > 2 * kLook)
        report_violation(
            now, fmt::format("an output of drive {} was set to 0, and its station has not left", drive));
    if (left) judge_leaving(drive, "leaves", now);
    if (is_on && main_thread.is_stalled() &&
        bus_thread.ran(main_thread.from(), now) > kMainIsLost + 2 * kLook)
        report_violation(now, fmt::format("station {} is on the bus, and the main thread stalls", drive));
    if (is_on && rules_[drive].when == drive::WhenLost::silent)
        if (const std::string why = why_gone(drive, bus_thread, now); !why.empty())
            report_violation(now, fmt::format("the station of drive {} is on the bus, and {}", drive, why));
}

void StallJudge::asks_for_diagnosis(std::size_t drive, bool asks, Instant now)
{
    if (std::exchange(records_[drive].asks, asks) || !asks) return;
    judge_leaving(drive, "asks for diagnosis", now);
}

/// It was not heard for so long that it may be gone, and not because of noise alone.
bool StallJudge::was_unwell(std::size_t drive, Instant now) const
{
    const Time after = rules_[drive].after;
    const Instant from = was_heard(drive, now);
    return now - from >= after &&
           (records_[drive].died_at >= from || answers_late_ || line_thread.ran(from, now) >= after ||
            line_thread.stalls_in(from, now) >= 2);
}

/// One of these has to be: its line or the main thread stalled for long enough as the bus thread lived it,
/// the bus thread or the main thread as the line lived it, or its drive was not heard and was not well.
void StallJudge::judge_leaving(std::size_t drive, const char* what, Instant now)
{
    Record& record = records_[drive];
    ++departures_;
    const bool only_diagnosis = record.is_on;
    if (!only_diagnosis) end_layout(drive, now);
    const StationRules& rules = rules_[drive];
    const Instant since = record.attached_at - kLook;
    // A line that stalled right behind it says it only now.
    const Instant lost_at = std::max(bus_lost_at_, main_lost_at_);
    const bool is_of_line = lost_at >= since || line_thread.ran(lost_at, now) <= 2 * kLook;
    if (!only_diagnosis && (main_left_at_ >= since || is_of_line)) return;
    if (rules.when != drive::WhenLost::hold) {
        if (line_thread.count() != 0) {
            const Instant end = line_thread.is_stalled() ? now : std::min(now, line_thread.until());
            if (end >= since - kLook && with_looks(bus_thread, line_thread.from(), end) >= rules.after)
                return;
        }
        if (was_unwell(drive, now)) return;
        // It may have been gone while the bus thread stalled: that is looked at now.
        if (record.unwell_at >= since && bus_thread.ran(record.unwell_at, now) <= 2 * kLook) return;
    }
    report_violation(now, fmt::format("the station of drive {} {}, and its line and its drive were well: "
                                      "heard {:.3f} s ago",
                                      drive, what, seconds(now - was_heard(drive, now))));
}

// ---- what is wanted

void StallJudge::wants(std::size_t drive, std::uint16_t tag, std::uint16_t word, Instant now)
{
    Output& output = records_[drive].outputs[tag];
    if (output.wanted.back().word == word) return;
    trace(now, "PLC {} wants {:04X} in tag {}", drive, word, tag);
    output.wanted.push_back({now, word});
    output.owes_zero.reset();
}

/// A layout ends with its Demand Data.
void StallJudge::end_layout(std::size_t drive, Instant now)
{
    Record& record = records_[drive];
    for (auto& [tag, output] : record.outputs)
        if (output.wanted.back().word != kSafeState) output.wanted.push_back({now, kSafeState});
    for (Demand& one : record.demands) one.superseded_at = std::min(one.superseded_at, now);
}

void StallJudge::demands(std::size_t drive, std::optional<std::uint16_t> word, bool is_taken, Instant now)
{
    trace(now, "PLC {} demands {:04X}", drive, word.value_or(0));
    if (is_taken)
        for (Demand& one : records_[drive].demands) one.superseded_at = std::min(one.superseded_at, now);
    if (word) records_[drive].demands.push_back({*word});
}

void StallJudge::orders(std::uint32_t number, std::size_t drive, std::optional<std::uint16_t> word)
{
    orders_[number] = {.drive = drive, .word = word};
}

void StallJudge::fails(std::uint32_t number, bool is_known, Instant now)
{
    trace(now, "order {} is answered as {}", number, is_known ? "not carried out" : "not known");
    orders_[number].failed_at = now;
    orders_[number].is_known = is_known;
}

/// A second refusal is none.
void StallJudge::answers(const drive::OperateAnswer& answer, Instant now)
{
    const Order& order = orders_[answer.number];
    if (order.failed_at && order.is_known && answer.error == AccessError::none)
        report_violation(
            now, fmt::format("order {} was answered as not carried out, and was carried out", answer.number));
}

// ---- a master that is lost since a thread stalls

void StallJudge::line_turn(Instant now)
{
    for (std::size_t i = 0; i < records_.size(); ++i)
        if (was_unwell(i, now)) records_[i].unwell_at = now;
    note_heard(now);
    const auto lost = [&](const Timeline& thread, Time limit) {
        return thread.is_stalled() && line_thread.ran(thread.from(), now) >= limit;
    };
    const auto may_be_lost = [&](const Timeline& thread,
                                 Time limit) { // its last sign is older than its stall
        return thread.is_stalled() && with_looks(line_thread, thread.from(), now) >= limit - kLook;
    };
    if (may_be_lost(bus_thread, kBusIsLost)) bus_lost_at_ = now;
    if (may_be_lost(main_thread, kMainIsLost)) main_lost_at_ = now;
    if (lost(bus_thread, kBusIsLost + 2 * kLook) && bus_noted_ != bus_thread.count()) {
        bus_noted_ = bus_thread.count();
        lose_master(now);
    }
    if (lost(main_thread, kMainIsLost + 2 * kLook) && main_noted_ != main_thread.count()) {
        main_noted_ = main_thread.count();
        lose_master(now);
    }
    judge_zeros(now);
}

void StallJudge::lose_master(Instant now)
{
    trace(now, "the line has to take the master for lost");
    for (std::size_t i = 0; i < records_.size(); ++i) {
        for (auto& [tag, output] : records_[i].outputs)
            if (output.wanted.back().word > 0 && zero_is_allowed(i) &&
                line_.drives[i].find(tag)->now().word != 0)
                output.owes_zero = now;
        end_layout(i, now);
    }
}

/// The safe state reaches each output, where all drives of the line answer, in the time of one wait that is
/// broken off and of two questions for each output.
void StallJudge::judge_zeros(Instant now)
{
    const bool all_answer = !answers_late_ && std::ranges::all_of(line_.drives, [&](const auto& drive) {
        return drive.alive && (drive.spoke_at >= now ||
                               line_thread.ran(std::max(drive.spoke_at, begins_), now) < question());
    });
    std::int64_t outputs = 0;
    for (const Record& one : records_) outputs += static_cast<std::int64_t>(one.outputs.size());
    const Time answered = 80 * line_.rules().character + 3 * line_.rules().turnaround + 60ms;
    const Time limit = 500ms + question() + (3 * outputs + 10) * answered;
    for (std::size_t i = 0; i < records_.size(); ++i)
        for (auto& [tag, output] : records_[i].outputs) {
            if (!output.owes_zero) continue;
            if (!all_answer)
                output.owes_zero = std::max(*output.owes_zero, now);
            else if (line_thread.ran(*output.owes_zero, now) > limit + kLook)
                report_violation(now, fmt::format("tag {} of drive {} has no safe state {:.3f} s after its "
                                                  "master was lost",
                                                  tag, i, seconds(now - *output.owes_zero)));
        }
}

void StallJudge::leaves(Instant now)
{
    trace(now, "the line is removed");
    removed_at_ = now;
    for (std::size_t i = 0; i < records_.size(); ++i) {
        records_[i].is_on = false;
        end_layout(i, now);
    }
}

/// Where there was time for it: DriveThread::kSafeStateLimit.
void StallJudge::has_left(Instant now)
{
    constexpr Time kLimit = 2s;
    std::int64_t outputs = 0;
    for (const Record& one : records_) outputs += static_cast<std::int64_t>(one.outputs.size());
    const Time answered = 80 * line_.rules().character + 3 * line_.rules().turnaround + 60ms;
    if (answers_late_ || (3 * outputs + 4) * answered > kLimit) return;
    for (std::size_t i = 0; i < records_.size(); ++i)
        for (const auto& [tag, output] : records_[i].outputs) {
            const std::uint16_t word = line_.drives[i].find(tag)->now().word;
            if (output.wanted.size() > 1 && zero_is_allowed(i) && word != 0)
                report_violation(
                    now, fmt::format("the line has left, and tag {} of drive {} holds {:04X}", tag, i, word));
        }
}

void StallJudge::sent_on(Instant now)
{
    report_violation(now, "octets that stood in a call leave behind its return");
}

std::string StallJudge::not_settled(std::size_t drive) const
{
    for (const auto& [tag, output] : records_[drive].outputs) {
        const int wanted = output.wanted.back().word;
        if (wanted < 0 || wanted == line_.drives[drive].find(tag)->now().word) continue;
        return fmt::format("tag {} of drive {} holds {:04X}, its PLC wants {:04X}", tag, drive,
                           line_.drives[drive].find(tag)->now().word, wanted);
    }
    return {};
}

} // namespace dpslave::stalls
