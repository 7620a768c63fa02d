// SPDX-License-Identifier: Apache-2.0
#include "demand_queue.hpp"

#include "generations.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

/// A master that gives writes faster than the line carries them waits for its answers; this many may wait for
/// one that does not. Then the newest takes the place of the one before it: the last value is what counts.
constexpr std::size_t kMaxWaiting = 64;
constexpr std::size_t kMaxAnswers = 64;

} // namespace

void DemandQueue::set(const DemandOrder& order, const Tag* row, AccessError verdict)
{
    if (!entries_.empty() && entries_.back().order.kind == DemandOrder::Kind::read) entries_.pop_back();
    standing_.reset();
    answers_.clear(); // of orders that are no longer in force
    if (order.kind == DemandOrder::Kind::cancel) return;
    standing_ = order.number;
    if (verdict != AccessError::none) {
        answer({order.number, verdict, 0});
        return;
    }
    if (entries_.size() == kMaxWaiting) {
        entries_.pop_back();
        ++dropped_;
    }
    entries_.push_back({order, row});
}

void DemandQueue::end(Generation generation)
{
    entries_.erase(
        std::remove_if(entries_.begin(), entries_.end(),
                       [generation](const Entry& e) { return !is_newer(e.order.generation, generation); }),
        entries_.end());
}

void DemandQueue::drop_superseded()
{
    const auto rest = std::remove_if(entries_.begin(), entries_.end(),
                                     [this](const Entry& entry) { return !stands(entry); });
    dropped_ += static_cast<std::uint64_t>(entries_.end() - rest);
    entries_.erase(rest, entries_.end());
}

void DemandQueue::done(std::uint32_t number, const Transaction& transaction, const Outcome& outcome,
                       bool proven_by_reading, int retries)
{
    if (entries_.empty() || entries_.front().order.number != number) return;
    if (outcome.error == AccessError::no_answer) return;
    Entry& entry = entries_.front();
    if (outcome.error == AccessError::not_understood) {
        if (++entry.attempts <= retries || stands(entry)) return;
        entries_.pop_front();
        ++dropped_;
    } else if (is_write(transaction) && outcome.error == AccessError::none && proven_by_reading) {
        entry.stage = Stage::acknowledged;
    } else if (is_write(transaction) || entry.stage != Stage::acknowledged) {
        finish(outcome.error, word_of(transaction, outcome));
    } else if (const auto proof = proof_of(entry.order.value, outcome)) {
        finish(*proof, entry.order.value);
    } else {
        entry.stage = Stage::ordered;
        if (entry.row->once || ++entry.attempts > retries) finish(AccessError::not_kept, entry.order.value);
    }
}

/// Finishes the first order.
void DemandQueue::finish(AccessError error, std::uint16_t value)
{
    Entry& entry = entries_.front();
    // The result of an order that is no longer in force is dropped: else it would replace the answer
    // to the present order.
    const bool has_value = error == AccessError::none || error == AccessError::not_kept;
    if (stands(entry)) answer({entry.order.number, error, has_value ? value : std::uint16_t{0}});
    if (entry.order.kind == DemandOrder::Kind::write)
        entries_.pop_front();
    else
        entry.stage = Stage::answered;
}

void DemandQueue::answer(const DemandAnswer& what)
{
    if (answers_.size() == kMaxAnswers) answers_.pop_front();
    answers_.push_back(what);
}

std::optional<DemandAnswer> DemandQueue::take_answer()
{
    if (answers_.empty()) return std::nullopt;
    const DemandAnswer first = answers_.front();
    answers_.pop_front();
    return first;
}

} // namespace dpslave::drive
