// SPDX-License-Identifier: Apache-2.0
#include "read_plan.hpp"

#include <algorithm>

namespace dpslave::drive {

WordState state_of(AccessError error)
{
    switch (error) {
        case AccessError::none: return WordState::good;
        case AccessError::no_answer: return WordState::stale;
        case AccessError::invalid_tag: return WordState::invalid_tag;
        case AccessError::read_only: return WordState::read_only;
        case AccessError::out_of_range:
        case AccessError::value_not_encoded: return WordState::out_of_range;
        case AccessError::not_understood:
        case AccessError::not_stopped:
        case AccessError::not_config_mode:
        case AccessError::unsupported_type: return WordState::refused;
    }
    return WordState::refused;
}

/// Not read in every round: the drive has no such tag, or it does not give its value.
bool ReadPlan::excluded(const Item& item)
{
    return !item.asked || item.state == WordState::invalid_tag || item.state == WordState::refused ||
           item.state == WordState::read_only;
}

void ReadPlan::reset(std::vector<Item> items)
{
    items_ = std::move(items);
    position_ = 0;
    rebuild();
}

std::optional<std::size_t> ReadPlan::find(std::uint16_t tag) const
{
    const auto at =
        std::lower_bound(items_.begin(), items_.end(), tag,
                         [](const Item& item, std::uint16_t wanted) { return item.row->number < wanted; });
    if (at == items_.end() || at->row->number != tag) return std::nullopt;
    return static_cast<std::size_t>(at - items_.begin());
}

/// Joins neighbours as far as the rule, the splits so far and the holes (excluded items) allow.
void ReadPlan::rebuild()
{
    blocks_.clear();
    bool open = false;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        const Item& item = items_[i];
        if (excluded(item)) {
            open = false;
            continue;
        }
        if (open && !item.starts_block) {
            Block& block = blocks_.back();
            const int gap = item.row->number - items_[block.last].row->number - 1;
            const int span = item.row->number - items_[block.first].row->number + 1;
            if (gap <= rule_.max_gap && span <= rule_.max_tags) {
                block.last = i;
                continue;
            }
        }
        blocks_.push_back({i, i});
        open = true;
    }
}

std::optional<ReadPlan::Block> ReadPlan::next(Instant now) const
{
    for (const Block block : blocks_)
        if (block.last >= position_) return block;
    for (std::size_t i = 0; i < items_.size(); ++i)
        if (items_[i].asked && excluded(items_[i]) && now >= items_[i].retry_at) return Block{i, i};
    return std::nullopt;
}

std::uint16_t ReadPlan::count_of(Block block) const
{
    return static_cast<std::uint16_t>(items_[block.last].row->number - items_[block.first].row->number + 1);
}

Instant ReadPlan::next_retry() const
{
    Instant at = kNever;
    for (const Item& item : items_)
        if (item.asked && excluded(item)) at = std::min(at, item.retry_at);
    return at;
}

bool ReadPlan::every_item_tried() const
{
    return std::all_of(items_.begin(), items_.end(), [](const Item& item) { return item.tried; });
}

bool ReadPlan::done(Block block, AccessError error, std::span<const std::uint16_t> words, Instant now)
{
    if (error == AccessError::none && words.size() >= count_of(block)) return good(block, words, now);
    if (block.first != block.last) {
        split(block);
        return false;
    }
    return bad(block.first, error, now);
}

bool ReadPlan::good(Block block, std::span<const std::uint16_t> words, Instant now)
{
    bool changed = false;
    bool joins_again = false;
    for (std::size_t i = block.first; i <= block.last; ++i) {
        Item& item = items_[i];
        const auto word = words[static_cast<std::size_t>(item.row->number - items_[block.first].row->number)];
        changed = changed || !item.tried || item.word != word || item.state != WordState::good;
        joins_again = joins_again || excluded(item);
        item.word = word;
        item.state = WordState::good;
        item.tried = true;
        item.updated_at = now;
    }
    position_ = std::max(position_, block.last + 1);
    if (joins_again) rebuild();
    return changed;
}

/// Cut in the middle; what is then still refused is cut again, until the hole lies between two blocks.
void ReadPlan::split(Block block)
{
    items_[(block.first + block.last) / 2 + 1].starts_block = true;
    rebuild();
}

bool ReadPlan::bad(std::size_t index, AccessError error, Instant now)
{
    Item& item = items_[index];
    const bool was_excluded = excluded(item);
    const WordState state = state_of(error);
    // A value that does not fit, or that noise kept away, is held as it was; of a tag that gives no value
    // nothing is known, so it reads 0.
    const bool held = state == WordState::out_of_range || error == AccessError::not_understood;
    const std::uint16_t word = held ? item.word : std::uint16_t{0};
    const bool changed = !item.tried || item.state != state || item.word != word;
    item.state = state;
    item.word = word;
    item.tried = true;
    item.retry_at = now + kInvalidRetry;
    position_ = std::max(position_, index + 1);
    if (excluded(item) && !was_excluded) {
        // The hole is found: the cuts made on the way to it are no longer needed.
        for (Item& other : items_) other.starts_block = false;
    }
    if (excluded(item) != was_excluded) rebuild();
    return changed;
}

void ReadPlan::skip(Block block)
{
    position_ = std::max(position_, block.last + 1);
    for (std::size_t i = block.first; i <= block.last; ++i) items_[i].retry_at += kInvalidRetry;
}

void ReadPlan::drive_lost()
{
    for (Item& item : items_) {
        item.tried = true; // with this result: nobody answers
        if (!excluded(item)) item.state = WordState::stale;
    }
}

void ReadPlan::drive_returned(Instant now)
{
    for (Item& item : items_) {
        item.retry_at = now;
        item.starts_block = false;
    }
    rebuild();
}

} // namespace dpslave::drive
