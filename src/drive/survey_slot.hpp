// SPDX-License-Identifier: Apache-2.0
/// The survey read that a drive still has to do, and what came of it.
#pragma once

#include "dpslave/drive/poller.hpp"

#include <chrono>
#include <optional>
#include <utility>

namespace dpslave::drive {

class SurveySlot {
public:
    /// `row`: the row of the tag, or one made for it. False: one waits already.
    bool set(std::uint32_t number, const Tag& row)
    {
        if (order_ || answer_) return false;
        order_ = number;
        rests_until_ = {};
        row_ = unlisted_tag(row.number);
        // Only where the tag is found counts: the answer is to show what the row cannot be trusted for.
        row_.mnemonic = row.mnemonic;
        row_.modbus_register = row.modbus_register;
        return true;
    }

    /// When it may be asked; kNever: nothing waits.
    Instant due() const { return order_ ? rests_until_ : kNever; }
    const Tag* row() const { return &row_; } ///< of the waiting order

    void done(const Outcome& outcome, Instant now)
    {
        if (outcome.error == AccessError::deferred) rests_until_ = now + kRest; // once more in a later round
        if (!order_ || outcome.error == AccessError::deferred) return;
        OperateAnswer answer{.number = *order_, .error = outcome.error, .word = 0, .said = {}};
        if (!outcome.answer.empty()) answer.error = AccessError::none; // a value, whatever can be made of it
        if (answer.error == AccessError::none && !outcome.words.empty()) answer.word = outcome.words.front();
        const std::string_view said = answer.error == AccessError::none ? outcome.answer : outcome.trouble;
        said.copy(answer.said.data(), answer.said.size() - 1);
        answer_ = answer;
        order_.reset();
    }

    std::optional<OperateAnswer> take() { return std::exchange(answer_, std::nullopt); }

private:
    static constexpr std::chrono::milliseconds kRest{5}; ///< what is owed to the line needs time

    std::optional<std::uint32_t> order_; ///< its number
    Instant rests_until_{};
    Tag row_;
    std::optional<OperateAnswer> answer_;
};

} // namespace dpslave::drive
