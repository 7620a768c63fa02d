// SPDX-License-Identifier: Apache-2.0
/// What the judge says of a word that reaches a drive.
#include "stall_judge.hpp"

#include <algorithm>

namespace dpslave::stalls {

void StallJudge::was_written(std::size_t drive, const SimulatedTag& tag, std::uint16_t word)
{
    const Instant handed = line_.carried_out_handed();
    trace(handed, "handed: {:04X} to tag {} of drive {}", word, tag.number, drive);
    switch (tag.use) {
        case drive_line::TagUse::input:
            return report_violation(handed, fmt::format("{:04X} was written to input {}", word, tag.number));
        case drive_line::TagUse::output: return judge_output(drive, tag.number, word, handed);
        case drive_line::TagUse::demand: return judge_demand(drive, word, handed);
        case drive_line::TagUse::operated: return judge_order(drive, word, handed);
    }
}

/// The end of the last stall of the line, where the bus has judged it; before everything: it has not.
Instant StallJudge::was_judged_until(std::size_t drive, Instant handed) const
{
    if (line_thread.count() == 0 || line_thread.is_stalled() || line_thread.until() > handed)
        return Instant{};
    const Time silent = bus_thread.ran(line_thread.from(), std::min(line_thread.until(), removed_at_));
    return silent > rules_[drive].after + 2 * kLook ? line_thread.until() : Instant{};
}

/// What was superseded then is older than the questions of one access, or than the return of a call. Time in
/// which the line did not run is no excuse where a call stalled, and was judged by others where none did.
bool StallJudge::is_overtaken(std::size_t drive, Instant superseded_at, Instant handed) const
{
    if (superseded_at > handed) return false;
    if (superseded_at < came_back_at_ && came_back_at_ <= handed) return true;
    if (superseded_at < was_judged_until(drive, handed)) return true;
    return line_thread.ran(superseded_at, handed) > 3 * question() + 2 * kLook;
}

void StallJudge::judge_output(std::size_t drive, std::uint16_t tag, std::uint16_t word, Instant handed)
{
    Output& output = records_[drive].outputs[tag];
    if (word == 0) output.owes_zero.reset();
    Instant superseded_at = kNever;
    std::optional<Instant> was_wanted;
    for (auto one = output.wanted.rbegin(); one != output.wanted.rend() && !was_wanted; ++one) {
        const bool is_safe = one->word == kSafeState && word == 0 && zero_is_allowed(drive);
        if (one->word == word || is_safe) was_wanted = superseded_at;
        superseded_at = one->from;
    }
    const Instant may_be_lost = std::max(bus_lost_at_, main_lost_at_); // the line may have seen it already
    if (word == 0 && zero_is_allowed(drive) && line_thread.ran(may_be_lost, handed) <= 3 * question()) return;
    if (!was_wanted)
        return report_violation(handed, fmt::format("{:04X} was written to tag {} of drive {} and was never "
                                                    "wanted",
                                                    word, tag, drive));
    if (word == 0 && zero_is_allowed(drive) && rules_[drive].when == drive::WhenLost::silent) {
        if (is_overtaken(drive, *was_wanted, handed) && !records_[drive].zeroed_at)
            records_[drive].zeroed_at =
                handed; // the line may know that the drive is gone before the bus does
        return;
    }
    if (is_overtaken(drive, *was_wanted, handed))
        report_violation(handed,
                         fmt::format("{:04X} was written to tag {} of drive {}, {:.3f} s after it was "
                                     "overtaken",
                                     word, tag, drive,
                                     std::chrono::duration<double>(handed - *was_wanted).count()));
}

/// After a stall that the bus has judged only the newest order is carried out, and none of a layout that has
/// ended.
void StallJudge::judge_demand(std::size_t drive, std::uint16_t word, Instant handed)
{
    const auto& demands = records_[drive].demands;
    const auto order = std::ranges::find(demands, word, &Demand::word);
    if (order == demands.end())
        return report_violation(handed,
                                fmt::format("Demand Data {:04X} was never ordered of drive {}", word, drive));
    if (order->superseded_at < was_judged_until(drive, handed))
        report_violation(handed, fmt::format("Demand Data {:04X} reaches drive {} behind a stall, and was "
                                             "overtaken before",
                                             word, drive));
}

void StallJudge::judge_order(std::size_t drive, std::uint16_t word, Instant handed)
{
    const auto order = std::ranges::find_if(
        orders_, [&](const auto& one) { return one.second.drive == drive && one.second.word == word; });
    if (order == orders_.end())
        return report_violation(handed, fmt::format("{:04X} was never ordered of drive {}", word, drive));
    const Order& what = order->second;
    if (!what.failed_at) return;
    // What was sent and not answered before may be carried out by a drive that is late.
    if ((what.is_known && !answers_late_) || *what.failed_at < handed)
        report_violation(handed, fmt::format("order {} of drive {} was answered as {}, and is carried out",
                                             order->first, drive,
                                             what.is_known ? "not carried out" : "not known, before"));
}

} // namespace dpslave::stalls
