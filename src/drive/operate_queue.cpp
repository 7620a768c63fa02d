// SPDX-License-Identifier: Apache-2.0
#include "operate_queue.hpp"

namespace dpslave::drive {
namespace {

constexpr std::size_t kMaxOperates = 16;

} // namespace

bool OperateQueue::add(const OperateOrder& order, const Tag* row, AccessError verdict)
{
    if (entries_.size() + answers_.size() >= kMaxOperates) return false;
    if (verdict == AccessError::none)
        entries_.push_back({order, row});
    else
        answers_.push_back({order.number, verdict, 0});
    return true;
}

void OperateQueue::done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading,
                        int retries)
{
    Entry& entry = entries_.front();
    const bool may_pass =
        outcome.error == AccessError::no_answer || outcome.error == AccessError::not_understood;
    if (may_pass && ++entry.attempts <= retries) return;
    if (is_write(transaction) && outcome.error == AccessError::none && proven_by_reading) {
        entry.acknowledged = true;
        return;
    }
    OperateAnswer answer{entry.order.number, outcome.error, word_of(transaction, outcome)};
    const AccessError silence = entry.silence();
    if (entry.acknowledged) {
        const auto proof = proof_of(entry.order.word, outcome);
        entry.acknowledged = false;
        const bool is_again = !proof && !entry.row->once && ++entry.attempts <= retries;
        if (is_again) return; // it does not hold it: written again
        answer = {entry.order.number, proof.value_or(AccessError::not_kept), entry.order.word};
        if (proof == AccessError::no_answer) answer.error = silence;
    }
    answers_.push_back(answer);
    entries_.pop_front();
}

void OperateQueue::drive_lost()
{
    for (const Entry& entry : entries_) answers_.push_back({entry.order.number, entry.silence(), 0});
    entries_.clear();
}

std::optional<OperateAnswer> OperateQueue::take_answer()
{
    if (answers_.empty()) return std::nullopt;
    const OperateAnswer first = answers_.front();
    answers_.pop_front();
    return first;
}

} // namespace dpslave::drive
