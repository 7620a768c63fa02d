// SPDX-License-Identifier: Apache-2.0
#include "output_plan.hpp"

#include <algorithm>

namespace dpslave::drive {

void OutputPlan::reset(std::vector<Item> items)
{
    items_ = std::move(items);
    may_write_ = false;
    stopped_ = false;
}

void OutputPlan::set(std::span<const std::uint16_t> words, bool may_write)
{
    may_write_ = may_write;
    for (Item& item : items_) item.wanted = words[item.parameter];
}

/// A changed word is due at once, kAtOnce. A tag that the drive does not have is dropped and tried
/// rarely; a word that it did not understand is tried as rarely, unless its refresh comes first.
Instant OutputPlan::due_at(const Item& item) const
{
    if (!item.asked) return kNever;
    if (item.state == WordState::invalid_tag) return item.attempted_at + kInvalidRetry;
    if (item.answered != item.wanted) return kAtOnce;
    return item.attempted_at + (item.not_understood ? std::min(refresh_, kInvalidRetry) : refresh_);
}

std::optional<std::size_t> OutputPlan::next(Instant now) const
{
    if (!writes_now()) return std::nullopt;
    std::optional<std::size_t> refresh;
    for (std::size_t i = 0; i < items_.size(); ++i) {
        if (items_[i].round == round_) continue;
        const Instant due = due_at(items_[i]);
        if (due == kAtOnce) return i;
        if (due <= now && !refresh) refresh = i;
    }
    return refresh;
}

Instant OutputPlan::next_due() const
{
    Instant at = kNever;
    if (writes_now())
        for (const Item& item : items_) at = std::min(at, due_at(item));
    for (const Zero& zero : zeros_) at = std::min(at, zero.due);
    return at;
}

void OutputPlan::started(std::size_t index, Instant now)
{
    Item& item = items_[index];
    item.answered.reset(); // from here until the answer nobody knows what the drive holds
    item.attempted_at = now;
}

void OutputPlan::done(std::size_t index, std::uint16_t word, AccessError error, Instant now)
{
    Item& item = items_[index];
    item.answered = word;
    item.round = round_;
    item.state = state_of(error);
    item.not_understood = error == AccessError::not_understood;
    if (error != AccessError::none) return;
    item.written = word;
    item.updated_at = now;
}

void OutputPlan::drive_lost()
{
    for (Item& item : items_)
        if (item.asked && item.state != WordState::invalid_tag) item.state = WordState::stale;
}

/// It may have been without power: whatever it held, every present output is written again.
void OutputPlan::drive_returned()
{
    for (Zero& zero : zeros_) zero.due = kAtOnce;
    for (Item& item : items_) {
        if (!item.asked) continue;
        item.answered.reset();
        item.round = item.waits ? round_ + 1 : round_;
        item.waits = false;
        if (item.state == WordState::invalid_tag) item.state = WordState::stale;
    }
}

void OutputPlan::zero(const Tag* row)
{
    zeroed(row);
    zeros_.push_back({row});
}

const Tag* OutputPlan::next_zero(Instant now)
{
    const auto written_anyway = [this](const Zero& zero) {
        return std::any_of(items_.begin(), items_.end(),
                           [&zero](const Item& i) { return i.row == zero.row; });
    };
    if (writes_now())
        zeros_.erase(std::remove_if(zeros_.begin(), zeros_.end(), written_anyway), zeros_.end());
    const auto at =
        std::find_if(zeros_.begin(), zeros_.end(), [now](const Zero& zero) { return zero.due <= now; });
    return at == zeros_.end() ? nullptr : at->row;
}

void OutputPlan::postpone_zero(const Tag* row, Instant now)
{
    for (Zero& zero : zeros_)
        if (zero.row == row) zero.due = now + kInvalidRetry;
}

void OutputPlan::zeroed(const Tag* row)
{
    zeros_.erase(
        std::remove_if(zeros_.begin(), zeros_.end(), [row](const Zero& zero) { return zero.row == row; }),
        zeros_.end());
}

} // namespace dpslave::drive
