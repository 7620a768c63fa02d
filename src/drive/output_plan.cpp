// SPDX-License-Identifier: Apache-2.0
#include "output_plan.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

constexpr unsigned kMaxRepeats = 6; ///< 64 s: beyond every limit

/// A refusal of this word, or one for the time being: that the drive holds the word ends it. A tag that is
/// read only stays so.
bool ends_when_held(AccessError error)
{
    return error != AccessError::read_only && error != AccessError::invalid_tag &&
           error != AccessError::unsupported_type && error != AccessError::contradicted;
}

} // namespace

void OutputPlan::reset(std::vector<Item> items)
{
    items_ = std::move(items);
    sort_by_tag();
    failed_blocks_ = 0;
    may_write_ = false;
    stopped_ = false;
}

void OutputPlan::sort_by_tag()
{
    by_tag_.clear();
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (items_[i].asked) by_tag_.push_back(i);
    std::sort(by_tag_.begin(), by_tag_.end(),
              [this](auto a, auto b) { return items_[a].row->number < items_[b].row->number; });
    batch_.clear();
}

void OutputPlan::exchange(std::vector<Item> items, std::chrono::nanoseconds refresh)
{
    rule_.refresh = refresh;
    for (std::size_t i = 0; i < items.size(); ++i) { // the layout is the same, so are the places
        Item& item = items[i];
        const Item& known = items_[i];
        if (known.asked == item.asked && is_same_value(*known.row, *item.row)) {
            const Tag* const row = item.row;
            item = known;
            item.row = row;
        } else {
            item.wanted = known.wanted;
        }
    }
    items_ = std::move(items);
    sort_by_tag();
}

void OutputPlan::set(std::span<const std::uint16_t> words, bool may_write)
{
    const bool begins = may_write && !may_write_;
    may_write_ = may_write;
    for (Item& item : items_) {
        item.wanted = words[item.parameter];
        // A bus that flaps must not cost the memory of the drive a write each time: the first word of a
        // layout is taken for what the drive holds until a read shows another one.
        if (!begins || !rule_.compare || !item.readable || item.answered) continue;
        item.answered = item.wanted;
        item.supposed = true;
    }
}

/// The drive has no such tag, or its scale is not known: dropped, and tried rarely.
bool OutputPlan::is_dropped(const Item& item)
{
    return item.state == WordState::invalid_tag || item.state == WordState::unscaled;
}

/// A changed word is due at once, kAtOnce. What is dropped is tried rarely; a word that it did not understand
/// is tried as rarely, unless its refresh comes first.
Instant OutputPlan::due_at(const Item& item) const
{
    if (!item.asked) return kNever;
    if (is_dropped(item)) return item.attempted_at + kInvalidRetry;
    if (item.answered != item.wanted) return kAtOnce;
    if (rule_.compare) return repeat_at(item);
    const bool not_understood = item.error == AccessError::not_understood;
    return item.attempted_at + (not_understood ? std::min(rule_.refresh, kInvalidRetry) : rule_.refresh);
}

/// Of a compared output whose word was answered. Never while the drive holds it.
Instant OutputPlan::repeat_at(const Item& item) const
{
    if (item.held || (!item.refused && !item.differs)) return kNever;
    if (!item.refused && item.repeats == 0) return kAtOnce; // overridden by somebody, or lost in a block
    const auto pause = kFirstRepeat * (1U << std::min(item.repeats, kMaxRepeats));
    return item.attempted_at + std::min(pause, item.refused ? kInvalidRetry : kRepeatNotKept);
}

bool OutputPlan::joins(const Item& item, Instant now) const
{
    return item.readable && !item.alone && !item.waits && !item.row->modbus_register && !is_dropped(item) &&
           item.round != round_ && due_at(item) <= now;
}

/// Fills the batch with the item and its neighbours by tag as far as they are due.
void OutputPlan::join_neighbours(std::size_t index, Instant now)
{
    batch_.assign(1, index);
    const std::size_t limit = std::min<std::size_t>(rule_.max_written, kMaxParameters);
    const bool blocks = rule_.compare && failed_blocks_ < kMaxFailedBlocks;
    if (!blocks || limit < 2 || !joins(items_[index], now)) return;
    const auto here =
        static_cast<std::size_t>(std::find(by_tag_.begin(), by_tag_.end(), index) - by_tag_.begin());
    const auto adjoins = [&](std::size_t place) { // `place` and the one after it
        return items_[by_tag_[place]].row->number + 1 == items_[by_tag_[place + 1]].row->number;
    };
    std::size_t first = here, last = here;
    while (last - first + 1 < limit && first > 0 && adjoins(first - 1) &&
           joins(items_[by_tag_[first - 1]], now))
        --first;
    while (last - first + 1 < limit && last + 1 < by_tag_.size() && adjoins(last) &&
           joins(items_[by_tag_[last + 1]], now))
        ++last;
    batch_.assign(by_tag_.begin() + static_cast<std::ptrdiff_t>(first),
                  by_tag_.begin() + static_cast<std::ptrdiff_t>(last + 1));
}

std::optional<OutputPlan::Write> OutputPlan::start(Instant now)
{
    if (!writes_now()) return std::nullopt;
    std::optional<std::size_t> chosen;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (items_[i].round == round_) continue;
        const Instant due = due_at(items_[i]);
        if (due > now || (chosen && due != kAtOnce)) continue;
        chosen = i;
        if (due == kAtOnce) break;
    }
    if (!chosen) return std::nullopt;
    join_neighbours(*chosen, now);
    for (std::size_t i = 0; i < batch_.size(); ++i) {
        Item& item = items_[batch_[i]];
        words_[i] = item.wanted;
        item.answered.reset(); // from here until the answer nobody knows what the drive holds
        item.attempted_at = now;
    }
    return Write{items_[batch_.front()].row, std::span{words_}.first(batch_.size())};
}

Instant OutputPlan::next_due() const
{
    Instant at = kNever;
    if (writes_now())
        for (const Item& item : items_) at = std::min(at, due_at(item));
    return at;
}

void OutputPlan::done(AccessError error, Instant now)
{
    if (writes_block() && error != AccessError::none) {
        hold(AccessError::deferred);
        return block_failed();
    }
    if (writes_block()) failed_blocks_ = 0;
    for (std::size_t i = 0; i < batch_.size(); ++i) answered(items_[batch_[i]], words_[i], error, now);
}

void OutputPlan::answered(Item& item, std::uint16_t word, AccessError error, Instant now)
{
    item.answered = word;
    item.answered_at = now;
    item.round = round_;
    item.failures = 0;
    item.state = state_of(error);
    item.error = error;
    item.refused = error != AccessError::none;
    item.repeats = item.repeated == word ? std::min(item.repeats + 1, kMaxRepeats) : 0;
    item.repeated = word;
    item.held = item.differs = item.supposed = false;
    item.unproven = writes_block();
    item.alone = item.refused;
    if (item.refused) return;
    item.written = word;
    item.updated_at = now;
}

void OutputPlan::not_answered(bool drive_lost)
{
    if (drive_lost)
        for (const std::size_t index : batch_) items_[index].waits = true;
    hold(AccessError::no_answer);
    if (writes_block()) block_failed();
}

void OutputPlan::defer()
{
    for (const std::size_t index : batch_) items_[index].round = round_;
    hold(AccessError::deferred);
}

void OutputPlan::hold(AccessError why)
{
    for (const std::size_t index : batch_) hold(items_[index], why);
}

/// A refusal stays what it is.
void OutputPlan::hold(Item& item, AccessError why)
{
    ++item.failures;
    if (item.state != WordState::good && item.state != WordState::stale) return;
    item.state = WordState::stale;
    item.error = why;
}

/// Nothing of it is known to be written: `answered` is empty, so each is due at once.
void OutputPlan::block_failed()
{
    ++failed_blocks_;
    for (const std::size_t index : batch_) items_[index].alone = true;
}

void OutputPlan::observed(const Tag* row, std::uint16_t word, Instant began)
{
    for (Item& item : items_) {
        if (item.row != row || !item.asked) continue;
        item.readable = true;
        if (word == item.wanted) {
            if (item.answered != item.wanted || item.supposed) { // as good as an answer, which may never come
                item.answered = item.written = word;
                item.answered_at = item.updated_at = began;
            }
            item.held = true;
            item.supposed = false;
            item.differs = item.unproven = false;
            item.repeats = 0;
            item.failures = 0;
            item.repeated.reset();
            if (item.refused && !ends_when_held(item.error)) continue;
            item.refused = item.alone = false;
            item.state = WordState::good;
            item.error = AccessError::none;
        } else if (item.answered != item.wanted) {
            continue; // it is written anyway
        } else if (item.supposed || began >= item.answered_at + kSettling) {
            item.alone = item.alone || item.unproven;
            item.held = item.unproven = item.supposed = false;
            item.differs = true;
            if (item.refused || item.repeats == 0) continue;
            item.state = WordState::refused; // accepted again and again, and not kept
            item.error = AccessError::not_understood;
        }
    }
}

void OutputPlan::unreadable(const Tag* row)
{
    for (Item& item : items_) {
        if (item.row != row || !item.asked) continue;
        if (item.unproven || item.supposed) item.answered.reset(); // only a single write tells
        item.readable = item.held = item.differs = item.unproven = item.supposed = false;
    }
}

void OutputPlan::refuse(const Tag* row, AccessError error)
{
    for (Item& item : items_) {
        if (item.row != row) continue;
        item.asked = false;
        item.state = state_of(error);
        item.error = error;
    }
}

void OutputPlan::forget()
{
    for (Item& item : items_) {
        if (!item.asked) continue;
        const Item before = item;
        item = Item{};
        item.parameter = before.parameter;
        item.row = before.row;
        item.readable = before.readable;
        item.wanted = before.wanted;
        item.written = before.written;
        item.updated_at = before.updated_at;
        item.state = WordState::stale;
        item.round = round_;
    }
    batch_.clear();
    failed_blocks_ = 0;
}

void OutputPlan::drive_lost()
{
    for (Item& item : items_) {
        if (!item.asked || is_dropped(item)) continue;
        item.state = WordState::stale;
        item.error = AccessError::no_answer;
    }
}

/// It may have been without power: whatever it held, every present output is written again. Where outputs are
/// compared the reads show which of them. What is known about blocks stays: it may have been lost on one.
void OutputPlan::drive_returned()
{
    for (Item& item : items_) {
        if (!item.asked) continue;
        item.supposed = item.readable && item.answered && !item.refused;
        if (!item.supposed) item.answered.reset();
        item.held = item.differs = item.unproven = item.refused = false;
        item.repeats = 0;
        item.repeated.reset();
        item.round = item.waits ? round_ + 1 : round_;
        item.waits = false;
        if (!is_dropped(item)) continue;
        item.state = WordState::stale;
        item.error = AccessError::no_answer;
    }
}

} // namespace dpslave::drive
