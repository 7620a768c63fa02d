// SPDX-License-Identifier: Apache-2.0
/// Holds the survey read that a drive still has to do, and its result.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace dpslave::drive {

class SurveySlot {
public:
    /// `row`: the row of the tag, or one made for it. `rule` names the tag if its row has no mnemonic;
    /// nullopt means the rule of the drive. Returns false if one waits already.
    bool set(std::uint32_t number, const Tag& row, std::optional<MnemonicRule> rule)
    {
        if (order_ || answer_) return false;
        order_ = number;
        rests_until_ = {};
        row_ = unlisted_tag(row.number);
        // Only where the tag is found counts: the answer is to show what the row cannot be trusted for.
        row_.mnemonic = row.mnemonic;
        row_.modbus_register = row.modbus_register;
        if (const auto named = rule ? mnemonic_of(row, *rule) : std::nullopt)
            row_.mnemonic.assign(named->begin(), named->end());
        return true;
    }

    /// Returns when it may be asked; kNever: nothing waits.
    Instant due() const { return order_ ? rests_until_ : kNever; }
    const Tag* row() const { return &row_; } ///< of the waiting order

    void done(const Outcome& outcome, Instant now)
    {
        if (outcome.error == AccessError::deferred) rests_until_ = now + kRest; // once more in a later round
        if (!order_ || outcome.error == AccessError::deferred) return;
        OperateAnswer answer{.number = *order_, .error = outcome.error, .word = 0, .said = {}};
        const bool is_value = !outcome.answer.empty() && outcome.error != AccessError::invalid_tag;
        if (is_value) answer.error = AccessError::none; // whatever can be made of it
        if (answer.error == AccessError::none && !outcome.words.empty()) answer.word = outcome.words.front();
        const std::string_view said = answer.error == AccessError::none ? outcome.answer : outcome.trouble;
        said.copy(answer.said.data(), answer.said.size() - 1);
        answer_ = answer;
        order_.reset();
    }

    /// OperateQueue::withdraw().
    void withdraw(std::uint32_t number)
    {
        if (order_ == number) order_.reset();
    }
    std::uint32_t number() const { return order_.value_or(0); } ///< of the waiting order; 0: none

    std::optional<OperateAnswer> take() { return std::exchange(answer_, std::nullopt); }

private:
    static constexpr std::chrono::milliseconds kRest{5}; ///< owed answers of the line need time

    std::optional<std::uint32_t> order_; ///< its number
    Instant rests_until_{};
    Tag row_;
    std::optional<OperateAnswer> answer_;
};

} // namespace dpslave::drive
