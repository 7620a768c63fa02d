// SPDX-License-Identifier: Apache-2.0
#include "judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace dpslave::drive_line {
namespace {

/// A word that the tag gave up so long ago, and at least so many timeouts, is not shown as good.
constexpr Time kOutOfDate = 60s;
constexpr int kOutOfDateTimeouts = 300;

/// When the drive took the word of a write since it was ordered.
template <class Order>
auto taken(const SimulatedTag& tag, const Order& order)
{
    return std::find_if(tag.history.begin(), tag.history.end(), [&order](const Held& held) {
        return held.word == order.word && held.from >= order.at;
    });
}

} // namespace

Judge::Judge(SimulatedLine& line) : line_(line), drives_(line.drives.size())
{
    line_.on_write = [this](std::size_t drive, SimulatedTag& tag, std::uint16_t word, Instant at) {
        was_written(drive, tag, word, at);
    };
}

void Judge::report_violation(const std::string& text)
{
    if (!violation_)
        violation_ = fmt::format("{:.1f} ms: {}",
                                 static_cast<double>(line_.time.time_since_epoch().count()) / 1e6, text);
}

SimulatedTag& Judge::tag_of(std::size_t drive, std::uint16_t number)
{
    line_.drives[drive].live_until(line_.time, line_.words(), line_.chance());
    return *line_.drives[drive].find(number);
}

std::optional<std::size_t> Judge::held(const SimulatedTag& tag, std::uint16_t word, std::size_t from) const
{
    for (std::size_t i = from; i < tag.history.size(); ++i) {
        const Held& held = tag.history[i];
        if (held.from > line_.time) break;
        if (held.denied ? word == 0 : held.word == word) return i;
    }
    return std::nullopt;
}

// ---- what is wanted

void Judge::set_outputs(std::size_t drive, const OutputImage& image)
{
    DriveRecord& record = drives_[drive];
    if (image.layout.generation != record.image.layout.generation) record.was_shown = {};
    record.image = image;
    if (!image.may_write) return;
    for (std::size_t i = 0; i < image.layout.count; ++i) {
        const LayoutEntry& parameter = image.layout.parameters[i];
        if (!parameter.writes) continue;
        TagRecord& known = record.tags[parameter.tag];
        known.is_output = true;
        auto& wanted = known.wanted;
        if (wanted.empty() || wanted.back().word != image.words[i])
            wanted.push_back({image.words[i], line_.time});
    }
}

void Judge::left(std::size_t drive, bool goes_to_zero)
{
    DriveRecord& record = drives_[drive];
    if (!record.image.may_write || !goes_to_zero) return;
    for (std::size_t i = 0; i < record.image.layout.count; ++i) {
        const LayoutEntry& parameter = record.image.layout.parameters[i];
        if (parameter.writes) record.tags[parameter.tag].wanted.push_back({0, line_.time});
    }
}

void Judge::ordered(std::size_t drive, const DemandOrder& order)
{
    if (order.kind == DemandOrder::Kind::cancel) return;
    DriveRecord& record = drives_[drive];
    const bool is_write = order.kind == DemandOrder::Kind::write;
    record.orders[order.number] = {drive, order.tag, order.value, is_write, line_.time};
    if (is_write) record.tags[order.tag].wanted.push_back({order.value, line_.time});
}

void Judge::operates(const drive::OperateOrder& order)
{
    operates_[order.number] = {order.unit, order.tag, order.word, order.is_write, line_.time};
    if (order.is_write) drives_[order.unit].tags[order.tag].wanted.push_back({order.word, line_.time});
}

void Judge::attempted(const drive::Transaction& transaction, AccessError error, Instant began)
{
    using drive::Purpose;
    DriveRecord& record = drives_[transaction.unit];
    const bool is_survey = transaction.purpose == Purpose::survey; // nothing follows from it, but it is owed
    if (!is_survey) record.in_doubt = error == AccessError::no_answer;
    if (transaction.tag == nullptr) return;
    const bool is_read = transaction.kind == drive::Transaction::Kind::read;
    const bool is_cyclic =
        is_read && (transaction.purpose == Purpose::input || transaction.purpose == Purpose::output ||
                    transaction.purpose == Purpose::watch);
    for (std::uint16_t i = 0; i < transaction.count; ++i) {
        const auto known =
            record.tags.try_emplace(static_cast<std::uint16_t>(transaction.tag->number + i)).first;
        TagRecord& tag = known->second;
        if (is_cyclic) tag.was_refreshed = error == AccessError::none;
        if (is_cyclic && tag.was_refreshed)
            tag.sampled_from = std::exchange(tag.unanswered_at, std::nullopt).value_or(began);
        if (error != AccessError::none && !tag.unanswered_at) tag.unanswered_at = began;
    }
}

void Judge::was_written(std::size_t drive, const SimulatedTag& tag, std::uint16_t word, Instant at)
{
    TagRecord& record = drives_[drive].tags[tag.number];
    if (tag.counts && word != 0 && !record.written_words.insert(word).second)
        report_violation(
            fmt::format("{:04X} was written to tag {} of drive {} a second time", word, tag.number, drive));
    for (std::size_t i = record.written; i < record.wanted.size(); ++i) {
        if (record.wanted[i].word != word) continue;
        record.written = i;
        record.was_written = true;
        record.written_at = at;
        return;
    }
    const bool was_wanted = std::any_of(record.wanted.begin(), record.wanted.end(),
                                        [word](const Wanted& one) { return one.word == word; });
    report_violation(fmt::format("{:04X} was written to tag {} of drive {}, {}", word, tag.number, drive,
                                 was_wanted ? "an older word after a newer one" : "and it was never wanted"));
}

// ---- what is shown

void Judge::shown(std::size_t drive, const InputImage& image)
{
    DriveRecord& record = drives_[drive];
    if (image.generation != record.image.layout.generation)
        return report_violation(fmt::format("inputs of layout {} of drive {} while {} stands",
                                            image.generation, drive, record.image.layout.generation));
    for (std::size_t i = 0; i < record.image.layout.count; ++i)
        if (record.image.layout.parameters[i].reads) judge_word(drive, i, image.words[i]);
}

void Judge::judge_word(std::size_t drive, std::size_t place, std::uint16_t word)
{
    DriveRecord& record = drives_[drive];
    const std::uint16_t number = record.image.layout.parameters[place].tag;
    TagRecord& known = record.tags[number];
    const SimulatedTag& tag = tag_of(drive, number);
    if (const auto at = held(tag, word, known.shown)) {
        // a 0 before the first reading may look like one that was held long after
        if (word != 0 || record.was_shown[place]) known.shown = *at;
        record.was_shown[place] = record.was_shown[place] || word != 0;
        return;
    }
    if (word == 0 && !record.was_shown[place]) return; // not read yet
    const bool was_held = held(tag, word, 0).has_value();
    report_violation(fmt::format("tag {} of drive {} shows {:04X}, {}", number, drive, word,
                                 was_held    ? "which it held before the word that was shown last"
                                 : word == 0 ? "though the drive has not denied it"
                                             : "which it never held"));
}

void Judge::shown(std::size_t drive, const drive::DriveSnapshot& snapshot,
                  const std::vector<std::uint16_t>& watched)
{
    DriveRecord& record = drives_[drive];
    for (std::size_t i = 0; i < watched.size(); ++i) {
        const drive::Watched& word = snapshot.watched[i];
        if (word.state == WordState::untried) continue;
        TagRecord& known = record.tags[watched[i]];
        const auto at = held(tag_of(drive, watched[i]), word.word, known.watched);
        if (at)
            known.watched = *at;
        else if (word.word != 0)
            report_violation(fmt::format("watched tag {} of drive {} shows {:04X}, which it does not hold",
                                         watched[i], drive, word.word));
    }
    if (snapshot.generation != record.image.layout.generation) return;
    for (std::size_t i = 0; i < record.image.layout.count; ++i) {
        const LayoutEntry& parameter = record.image.layout.parameters[i];
        if (!parameter.reads || snapshot.states[i] != WordState::good) continue;
        judge_good(drive, i, snapshot.words[i]);
        if (snapshot.words[i] == 0) continue;
        const SimulatedTag& tag = tag_of(drive, parameter.tag);
        Instant given_up = kNever;
        for (std::size_t at = tag.history.size(); at-- > 0 && tag.history[at].word != snapshot.words[i];)
            given_up = tag.history[at].from;
        if (given_up < line_.time - std::max<Time>(kOutOfDate, kOutOfDateTimeouts * line_.rules().timeout))
            report_violation(fmt::format(
                "tag {} of drive {} shows {:04X} as good, which it gave up {:.1f} s ago", parameter.tag,
                drive, snapshot.words[i], static_cast<double>((line_.time - given_up).count()) / 1e9));
    }
}

/// It was held when, or after, the last attempt to read it began, and that attempt has not failed.
void Judge::judge_good(std::size_t drive, std::size_t place, std::uint16_t word)
{
    DriveRecord& record = drives_[drive];
    const std::uint16_t number = record.image.layout.parameters[place].tag;
    const TagRecord& known = record.tags[number];
    const std::string what = fmt::format("tag {} of drive {} shows {:04X} as good, ", number, drive, word);
    if (record.in_doubt) return report_violation(what + "while the drive has not answered");
    if (!known.was_refreshed) return report_violation(what + "though the last attempt to read it failed");
    const SimulatedTag& tag = tag_of(drive, number);
    std::size_t from = 0;
    while (from + 1 < tag.history.size() && tag.history[from + 1].from <= known.sampled_from) ++from;
    if (!held(tag, word, from)) report_violation(what + "which it has not held since it was asked last");
}

// ---- answers to orders

/// Has the drive denied it since it gave the last value?
bool Judge::was_denied(const SimulatedTag& tag, const TagRecord& known)
{
    const auto from = tag.history.begin() + static_cast<std::ptrdiff_t>(std::max(known.shown, known.ordered));
    return std::any_of(from, tag.history.end(), [](const Held& held) { return held.denied; });
}

void Judge::judge_answer(const Order& order, AccessError error, std::uint16_t word)
{
    const SimulatedTag& tag = tag_of(order.drive, order.tag);
    TagRecord& known = drives_[order.drive].tags[order.tag];
    const std::string what = fmt::format("{} of tag {} of drive {}", order.is_write ? "a write" : "a read",
                                         order.tag, order.drive);
    const Instant oldest = order.at - line_.rules().timeout * 12; // a late answer to a question of before
    switch (error) {
        case AccessError::none: break;
        case AccessError::not_kept:
            if (taken(tag, order) == tag.history.end() && tag.disturbed_at < order.at)
                report_violation(what + " is answered as taken and not kept, and the drive has not taken it");
            return;
        case AccessError::invalid_tag:
            if (!was_denied(tag, known))
                report_violation(what + " is answered as an invalid tag, which it is not");
            return;
        case AccessError::read_only:
            if (!tag.read_only) report_violation(what + " is answered as read only, which it is not");
            return;
        case AccessError::out_of_range:
            if (!tag.refuses && !tag.read_only && tag.disturbed_at < order.at)
                report_violation(what + " is answered as out of range, which it was not");
            return;
        default: return;
    }
    if (order.is_write) {
        const auto done = taken(tag, order);
        if (done == tag.history.end())
            return report_violation(fmt::format(
                "{} of {:04X} is answered as done, and the drive has not taken it", what, order.word));
        known.ordered = std::max(known.ordered, static_cast<std::size_t>(done - tag.history.begin()));
        return;
    }
    std::size_t from = known.ordered;
    while (from + 1 < tag.history.size() && tag.history[from + 1].from <= oldest) ++from;
    const auto at = held(tag, word, from);
    if (!at)
        return report_violation(
            fmt::format("{} is answered {:04X}, which it has not held since", what, word));
    known.ordered = *at;
}

void Judge::answered(std::size_t drive, const DemandAnswer& answer)
{
    const auto order = drives_[drive].orders.find(answer.number);
    if (order == drives_[drive].orders.end())
        return report_violation(
            fmt::format("an answer to order {} of drive {}, which was not given", answer.number, drive));
    judge_answer(order->second, answer.error, answer.value);
}

void Judge::answered(const drive::OperateAnswer& answer)
{
    const auto order = operates_.find(answer.number);
    if (order == operates_.end())
        return report_violation(
            fmt::format("an answer to order {} of the operator, which was not given", answer.number));
    judge_answer(order->second, answer.error, answer.word);
}

// ---- the end

bool Judge::outputs_now(std::size_t drive, std::uint16_t number) const
{
    const OutputImage& image = drives_[drive].image;
    const auto end = image.layout.parameters.begin() + image.layout.count;
    return image.may_write &&
           std::any_of(image.layout.parameters.begin(), end,
                       [number](const LayoutEntry& one) { return one.writes && one.tag == number; });
}

std::string Judge::not_settled(std::size_t drive, const drive::DriveSnapshot& snapshot)
{
    DriveRecord& record = drives_[drive];
    if (!snapshot.answers) return fmt::format("drive {} is shown as silent", drive);
    for (std::size_t i = 0; i < record.image.layout.count; ++i) {
        const LayoutEntry& parameter = record.image.layout.parameters[i];
        const SimulatedTag& tag = tag_of(drive, parameter.tag);
        if (parameter.reads && !tag.now().denied && !parameter.writes) {
            if (snapshot.states[i] != WordState::good || snapshot.words[i] != tag.now().word)
                return fmt::format("input {} (tag {}) of drive {} shows {:04X}, the drive holds {:04X}", i,
                                   parameter.tag, drive, snapshot.words[i], tag.now().word);
        }
    }
    for (const auto& [number, known] : record.tags) {
        if (!known.is_output) continue; // a block also reads numbers that are no tags
        const SimulatedTag& tag = tag_of(drive, number);
        if (tag.now().denied || tag.read_only || tag.counts) continue; // what got lost stays so
        // What is no output any more is only sent to its safe state, and is not looked at again.
        const bool is_over = known.wanted.back().word != 0 || tag.disturbed_at >= known.wanted.back().at;
        if (!outputs_now(drive, number) && is_over) continue;
        if (tag.now().word != known.wanted.back().word)
            return fmt::format("tag {} of drive {} holds {:04X}, the master wants {:04X}", number, drive,
                               tag.now().word, known.wanted.back().word);
    }
    return {};
}

} // namespace dpslave::drive_line
