// SPDX-License-Identifier: Apache-2.0
#include "read_plan.hpp"

#include <algorithm>

namespace dpslave::drive {

WordState state_of(AccessError error)
{
    switch (error) {
        case AccessError::none: return WordState::good;
        case AccessError::no_answer:
        case AccessError::deferred: return WordState::stale;
        case AccessError::invalid_tag: return WordState::invalid_tag;
        case AccessError::read_only: return WordState::read_only;
        case AccessError::out_of_range:
        case AccessError::value_not_encoded: return WordState::out_of_range;
        case AccessError::not_understood:
        case AccessError::not_stopped:
        case AccessError::not_config_mode:
        case AccessError::not_kept:
        case AccessError::unsupported_type: return WordState::refused;
        case AccessError::no_scale:
        case AccessError::contradicted: return WordState::unscaled;
    }
    return WordState::refused;
}

/// Not read in every round: the drive has no such tag, or it does not give its value.
bool ReadPlan::excluded(const Item& item)
{
    return !item.asked || item.state == WordState::invalid_tag || item.state == WordState::refused ||
           item.state == WordState::read_only || item.state == WordState::unscaled;
}

void ReadPlan::reset(std::vector<Item> items)
{
    items_ = std::move(items);
    position_ = 0;
    begun_ = false;
    compares_ = false;
    cut_.reset();
    rebuild();
}

void ReadPlan::exchange(std::vector<Item> items)
{
    for (Item& item : items) {
        const auto at = find(item.row->number);
        if (!at) continue;
        const Item& known = items_[*at];
        if (known.asked == item.asked && is_same_value(*known.row, *item.row)) {
            const Item wanted = item;
            item = known;
            item.row = wanted.row;
            item.input = wanted.input;
            item.watched = wanted.watched;
            item.compared = wanted.compared;
            item.form = wanted.form;
            item.unscaled = wanted.unscaled;
            item.starts_block = false; // a cut on the way to a hole: the search begins anew
            item.retry_at = {};        // its row may have what was missing
        } else if (item.asked) {
            item.word = known.word;
            item.tried = known.tried;
            if (known.error != AccessError::no_scale) continue;
            item.state = known.state; // the exchange does not begin with a word that was never read
            item.error = known.error;
            item.answer = known.answer;
        }
    }
    const bool compares = compares_;
    reset(std::move(items));
    compare(compares);
}

void ReadPlan::compare(bool outputs)
{
    if (compares_ == outputs) return;
    compares_ = outputs;
    cut_.reset();
    rebuild();
}

/// Read again and again, so its word can be out of date.
bool ReadPlan::is_cyclic(const Item& item) const
{
    return item.input || item.watched || (item.compared && compares_);
}

bool ReadPlan::in_use(const Item& item) const
{
    return is_cyclic(item) || (item.form && item.state != WordState::good);
}

std::optional<std::size_t> ReadPlan::find(std::uint16_t tag) const
{
    const auto at =
        std::lower_bound(items_.begin(), items_.end(), tag,
                         [](const Item& item, std::uint16_t wanted) { return item.row->number < wanted; });
    if (at == items_.end() || at->row->number != tag) return std::nullopt;
    return static_cast<std::size_t>(at - items_.begin());
}

/// Goes into the open block as far as rule and splits allow.
bool ReadPlan::joins(const Item& item) const
{
    if (item.starts_block || item.after_hole) return false;
    const Block block = blocks_.back();
    const int gap = item.row->number - items_[block.last].row->number - 1;
    const int span = item.row->number - items_[block.first].row->number + 1;
    return gap <= rule_.max_gap && span <= rule_.max_tags;
}

/// Joins neighbours over what is not in use at present, but not over holes (excluded items).
void ReadPlan::rebuild()
{
    blocks_.clear();
    calm_ = true;
    bool open = false;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        const bool apart = item.row->modbus_register.has_value();
        open = open && !excluded(item) && !apart;
        if (excluded(item) || !in_use(item)) continue;
        calm_ = calm_ && !item.input && !item.form && !(item.compared && compares_);
        if (open && joins(item))
            blocks_.back().last = i;
        else
            blocks_.push_back({i, i});
        open = !apart;
    }
}

/// Whether it has a scale is to be known before the exchange begins, however many others there are to read.
bool ReadPlan::is_urgent(const Item& item) const
{
    return item.unscaled && item.asked && !item.tried && in_use(item);
}

std::optional<ReadPlan::Block> ReadPlan::next(Instant now)
{
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (is_urgent(items_[i]) && now >= items_[i].retry_at) return Block{i, i};
    for (const Block block : blocks_) {
        if (block.last < position_) continue;
        if (!begun_) began_at_ = now;
        begun_ = true;
        return block;
    }
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (in_use(item) && item.asked && excluded(item) && now >= item.retry_at) return Block{i, i};
    }
    return std::nullopt;
}

void ReadPlan::begin_round(Instant now)
{
    if (calm_ && begun_ && now < began_at_ + kCalmRound) return;
    position_ = 0;
    begun_ = false;
}

Instant ReadPlan::next_due() const
{
    Instant at = kNever;
    if (!blocks_.empty()) {
        const bool waits = calm_ && begun_ && blocks_.back().last < position_;
        at = waits ? began_at_ + kCalmRound : kAtOnce;
    }
    for (const Item& item : items_)
        if (in_use(item) && item.asked && excluded(item)) at = std::min(at, item.retry_at);
    return at;
}

std::uint16_t ReadPlan::count_of(Block block) const
{
    return static_cast<std::uint16_t>(items_[block.last].row->number - items_[block.first].row->number + 1);
}

bool ReadPlan::serves_input(Block block) const
{
    for (std::size_t i = block.first; i <= block.last; ++i)
        if (items_[i].input) return true;
    return false;
}

bool ReadPlan::serves_output(Block block) const
{
    for (std::size_t i = block.first; i <= block.last; ++i)
        if ((items_[i].compared && compares_) || items_[i].form) return true;
    return false;
}

bool ReadPlan::every_input_tried() const
{
    return std::all_of(items_.begin(), items_.end(),
                       [](const Item& item) { return !(item.input || item.form) || item.tried; });
}

bool ReadPlan::scale_missing() const
{
    return std::any_of(items_.begin(), items_.end(), [](const Item& item) {
        return (item.input || item.form) && item.error == AccessError::no_scale;
    });
}

bool ReadPlan::done(Block block, AccessError error, std::span<const std::uint16_t> words, Instant now,
                    std::string_view answer)
{
    if (error == AccessError::none && words.size() >= count_of(block)) return good(block, words, now);
    if (block.first != block.last) {
        if (error == AccessError::not_understood && ++items_[block.first].busy <= kBusyRounds)
            return busy(block);
        split(block);
        return false;
    }
    return bad(block.first, error, now, answer);
}

bool ReadPlan::good(Block block, std::span<const std::uint16_t> words, Instant now)
{
    bool changed = false;
    bool joins_again = false;
    for (std::size_t i = block.first; i <= block.last; ++i) {
        Item& item = items_[i];
        const auto word = words[static_cast<std::size_t>(item.row->number - items_[block.first].row->number)];
        changed = changed || ((item.input || item.form) &&
                              (!item.tried || item.word != word || item.state != WordState::good));
        joins_again = joins_again || excluded(item) || item.form;
        item.word = word;
        item.state = WordState::good;
        item.error = AccessError::none;
        item.answer = {};
        item.tried = true;
        item.busy = item.failures = 0;
        item.updated_at = now;
    }
    position_ = std::max(position_, block.last + 1);
    look_at_cut(block);
    if (joins_again) rebuild();
    return changed;
}

/// The item that a transaction can begin with, from `index` on.
std::size_t ReadPlan::in_use_from(std::size_t index) const
{
    while (index < items_.size() && !in_use(items_[index])) ++index;
    return index;
}

/// Cut in the middle, where something is read; what is then still refused is cut again. Of its words a
/// refused block says nothing.
void ReadPlan::split(Block block)
{
    hold(block, AccessError::deferred);
    cut_ = Cut{block, in_use_from((block.first + block.last) / 2 + 1), false};
    items_[cut_->at].starts_block = true;
    rebuild();
}

/// Both halves are given and the whole is not: the hole is between them.
void ReadPlan::look_at_cut(Block good)
{
    if (!cut_) return;
    if (good.first <= cut_->block.first && in_use_from(good.last + 1) == cut_->at)
        cut_->first_half_is_good = true;
    if (!cut_->first_half_is_good || good.first != cut_->at || good.last < cut_->block.last) return;
    items_[cut_->at].after_hole = true;
    mend();
}

/// The hole is found: the cuts made on the way to it are no longer needed.
void ReadPlan::mend()
{
    for (Item& item : items_) item.starts_block = false;
    cut_.reset();
    rebuild();
}

/// A cut would not help: the block waits for the next round, its words are held as they were.
bool ReadPlan::busy(Block block)
{
    bool changed = false;
    for (std::size_t i = block.first; i <= block.last; ++i) {
        Item& item = items_[i];
        changed = changed || (item.input && !item.tried);
        item.tried = true;
        if (item.state == WordState::untried) item.state = WordState::stale;
        hold(item, AccessError::not_understood);
    }
    position_ = std::max(position_, block.last + 1);
    return changed;
}

bool ReadPlan::bad(std::size_t index, AccessError error, Instant now, std::string_view answer)
{
    Item& item = items_[index];
    const bool was_excluded = excluded(item);
    const WordState state = state_of(error);
    // A value that does not fit, or that noise kept away, is held as it was; of a tag that gives no value
    // nothing is known, so it reads 0.
    const bool held = state == WordState::out_of_range || error == AccessError::not_understood;
    const std::uint16_t word = held ? item.word : std::uint16_t{0};
    const bool changed = (item.input || item.form) &&
                         (!item.tried || item.state != state || item.error != error || item.word != word);
    item.state = state;
    item.error = error;
    item.answer = answer_text(answer);
    item.word = word;
    item.tried = true;
    item.failures = 0;
    item.retry_at = now + kInvalidRetry;
    position_ = std::max(position_, index + 1);
    if (excluded(item) && !was_excluded)
        mend();
    else if (excluded(item) != was_excluded)
        rebuild();
    return changed;
}

void ReadPlan::refuse(std::uint16_t tag, AccessError error, std::string_view answer)
{
    const auto index = find(tag);
    if (!index) return;
    Item& item = items_[*index];
    item.asked = false;
    item.tried = true;
    item.word = 0;
    item.state = state_of(error);
    item.error = error;
    item.answer = answer_text(answer);
    rebuild();
}

void ReadPlan::skip(Block block)
{
    position_ = std::max(position_, block.last + 1);
    for (std::size_t i = block.first; i <= block.last; ++i) items_[i].retry_at += kInvalidRetry;
}

void ReadPlan::defer(Block block, Instant now)
{
    position_ = std::max(position_, block.last + 1);
    for (std::size_t i = block.first; i <= block.last; ++i) {
        items_[i].retry_at = now + kDeferredRetry;
        hold(items_[i], AccessError::deferred);
    }
}

/// What the drive has denied or refused stays so.
void ReadPlan::hold(Item& item, AccessError why) const
{
    if (!is_cyclic(item)) return;
    ++item.failures;
    if (item.state != WordState::good && item.state != WordState::stale) return;
    item.state = WordState::stale;
    item.error = why;
}

void ReadPlan::hold(Block block, AccessError why)
{
    for (std::size_t i = block.first; i <= block.last; ++i) hold(items_[i], why);
}

void ReadPlan::hold_all()
{
    for (Item& item : items_) hold(item, AccessError::no_answer);
}

void ReadPlan::drive_lost()
{
    for (Item& item : items_) {
        item.tried = true; // with this result: nobody answers
        const bool waits_for_new_row = item.error == AccessError::no_scale && !item.unscaled;
        if (excluded(item) && !waits_for_new_row) continue;
        item.state = WordState::stale;
        item.error = AccessError::no_answer;
    }
}

void ReadPlan::drive_returned(Instant now)
{
    for (Item& item : items_) {
        item.retry_at = now;
        item.starts_block = item.after_hole = false;
    }
    cut_.reset();
    rebuild();
}

} // namespace dpslave::drive
