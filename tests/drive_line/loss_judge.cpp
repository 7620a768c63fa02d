// SPDX-License-Identifier: Apache-2.0
#include "loss_judge.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::drive_line {
namespace {

constexpr std::int64_t kFurtherQuestions = 4;

double seconds(Time time)
{
    return std::chrono::duration<double>(time).count();
}

} // namespace

LossJudge::LossJudge(SimulatedLine& line, const drive::LossRule& rule, int retries)
    : line_(line), rule_(rule), retries_(retries), records_(line.drives.size())
{}

void LossJudge::report_violation(std::size_t drive, const std::string& text)
{
    if (!violation_)
        violation_ =
            fmt::format("{:.1f} ms: the station of drive {} {}",
                        static_cast<double>(line_.time.time_since_epoch().count()) / 1e6, drive, text);
}

void LossJudge::answered(std::size_t drive)
{
    records_[drive].has_answered = true;
    records_[drive].answered_at = line_.time;
}

void LossJudge::entered(std::size_t drive)
{
    records_[drive].entered_at = line_.time;
}

void LossJudge::left(std::size_t drive, const OutputImage& image, bool goes_to_zero)
{
    Record& record = records_[drive];
    record.to_zero.clear();
    record.left_at = line_.time;
    if (!record.is_away || !image.may_write || !goes_to_zero) return; // its zeros are no matter of its drive
    for (std::size_t i = 0; i < image.layout.count; ++i)
        if (image.layout.parameters[i].writes) record.to_zero.push_back(image.layout.parameters[i].tag);
}

/// A question that is not answered takes the timeout, itself and the longest answer on the wire, and the
/// pause behind noise.
Time LossJudge::question() const
{
    constexpr std::int64_t kCharacters = 100;
    return 20ms + line_.rules().timeout + kCharacters * line_.rules().character + line_.rules().port_holds;
}

void LossJudge::shown(std::size_t drive, const drive::DriveSnapshot& snapshot)
{
    if (rule_.when != drive::WhenLost::silent) return;
    Record& record = records_[drive];
    if (!record.is_away && snapshot.away) {
        ++departures_;
        judge_leaving(drive);
    }
    if (record.is_away && !snapshot.away) judge_appearing(drive, snapshot);
    record.is_away = snapshot.away;
    if (!record.is_away) judge_staying(drive);
}

void LossJudge::judge_leaving(std::size_t drive)
{
    const Instant heard = std::max(records_[drive].answered_at, line_.drives[drive].named_at);
    records_[drive].has_answered = false;
    if (heard <= line_.time && line_.time - heard < rule_.after)
        report_violation(drive,
                         fmt::format("left {:.3f} s after its drive was heard", seconds(line_.time - heard)));
}

/// It is asked at least every 250 ms. On a line with several drives a question to a silent one waits for a
/// round of the living ones and for the other silent ones: here only that it ends.
void LossJudge::judge_staying(std::size_t drive)
{
    const auto drives = static_cast<std::int64_t>(records_.size());
    const Time settle = 10 * line_.rules().timeout + line_.rules().port_holds;
    const Time further = drives == 1 ? 0ns : 5 * drives * (kFurtherQuestions + retries_ + 1) * question();
    const Time limit = 250ms + (retries_ + 1) * question() + std::max({Time{rule_.after}, settle, further});
    const Time silent = line_.time - std::max(records_[drive].answered_at, line_.drives[drive].spoke_at);
    if (silent > limit)
        report_violation(
            drive, fmt::format("has stayed for {:.3f} s since its drive was heard, {:.3f} s are allowed",
                               seconds(silent), seconds(limit)));
}

void LossJudge::judge_appearing(std::size_t drive, const drive::DriveSnapshot& snapshot)
{
    Record& record = records_[drive];
    if (!record.has_answered && record.answered_at != Instant{})
        report_violation(drive, "appeared and its drive had not answered");
    for (const std::uint16_t number : record.to_zero) {
        const SimulatedTag& tag = *line_.drives[drive].find(number);
        if (tag.counts) continue; // its zero is not repeated
        bool was_zero = false;    // or denied, since the station left
        for (std::size_t at = tag.history.size(); at-- > 0 && !was_zero;) {
            was_zero = tag.history[at].word == 0 || tag.history[at].denied;
            if (tag.history[at].from <= record.left_at) break;
        }
        if (!was_zero && snapshot.not_zeroed == 0)
            report_violation(drive, fmt::format("appeared and tag {} was not set to 0, it holds {:04X}",
                                                number, tag.now().word));
    }
    record.to_zero.clear();
}

/// When the master may begin to exchange each input was held since it chose the layout.
void LossJudge::shown(std::size_t drive, const Layout& layout, const InputImage& image)
{
    if (rule_.when != drive::WhenLost::silent || !image.every_input_tried) return;
    for (std::size_t i = 0; i < layout.count; ++i) {
        const std::uint16_t word = image.words[i];
        if (!layout.parameters[i].reads || word == 0) continue;
        const auto& history = line_.drives[drive].find(layout.parameters[i].tag)->history;
        bool was_held = false;
        for (std::size_t at = history.size(); at-- > 0 && !was_held;) {
            const bool is_over = at + 1 < history.size() && history[at + 1].from < records_[drive].entered_at;
            if (is_over) break;
            was_held = history[at].word == word;
        }
        if (!was_held)
            report_violation(drive, fmt::format("shows {:04X} for tag {}, which its drive has not held since",
                                                word, layout.parameters[i].tag));
    }
}

} // namespace dpslave::drive_line
