// SPDX-License-Identifier: Apache-2.0
#include "scale_check.hpp"

#include "read_plan.hpp"

#include <algorithm>

namespace dpslave::drive {
namespace {

constexpr int kSilentTwice = 2;
/// A register that the instrument neither gives nor denies, because it is busy, is asked for so often.
constexpr int kAskedWhileBusy = 10;
constexpr std::chrono::seconds kBusyRetry{1};

} // namespace

bool concerns(const ScaleRegister& reg, const Tag& row)
{
    return reg.only_display ? row.follows_display : row.is_real;
}

ScaleCheck::ScaleCheck(const std::vector<ScaleRegister>& registers)
{
    for (const ScaleRegister& reg : registers) registers_.push_back({.reg = reg});
}

void ScaleCheck::exchange(const std::vector<ScaleRegister>& registers)
{
    ScaleCheck now{registers};
    for (State& one : now.registers_)
        if (const State* const known = find(one.reg.tag); known != nullptr && known->reg == one.reg)
            one = *known;
    registers_ = std::move(now.registers_);
}

void ScaleCheck::begin(bool is_used)
{
    is_used_ = is_used;
    for (State& one : registers_) {
        one.is_known = one.lost_on >= kSilentTwice;
        one.retry_at = {};
        one.busy = 0;
    }
}

ScaleCheck::State* ScaleCheck::find(std::uint16_t tag)
{
    const auto at = std::ranges::find_if(registers_, [tag](const State& one) { return one.reg.tag == tag; });
    return at == registers_.end() ? nullptr : &*at;
}

bool ScaleCheck::is_due(const State& one, Instant now) const
{
    return is_used_ && now >= one.retry_at && (!one.is_known || one.contradicts);
}

std::optional<std::uint16_t> ScaleCheck::next(Instant now) const
{
    for (const State& one : registers_)
        if (is_due(one, now)) return one.reg.tag;
    return std::nullopt;
}

Instant ScaleCheck::next_due() const
{
    Instant at = kNever;
    for (const State& one : registers_)
        if (is_used_ && (!one.is_known || one.contradicts)) at = std::min(at, one.retry_at);
    return at;
}

bool ScaleCheck::done(std::uint16_t tag, const Outcome& outcome, Instant now)
{
    State* const one = find(tag);
    if (one == nullptr) return false;
    if (outcome.error == AccessError::not_understood && ++one->busy < kAskedWhileBusy) {
        one->retry_at = now + kBusyRetry;
        return false;
    }
    const auto before = one->contradicts;
    one->busy = 0;
    one->is_known = true;
    one->lost_on = 0;
    one->retry_at = now + kInvalidRetry;
    one->contradicts.reset();
    if (outcome.error == AccessError::none && outcome.words.front() != one->reg.expected)
        one->contradicts = outcome.words.front();
    return one->contradicts != before;
}

void ScaleCheck::lost_on(std::uint16_t tag)
{
    if (State* const one = find(tag)) ++one->lost_on;
}

bool ScaleCheck::is_over() const
{
    return !is_used_ || std::ranges::all_of(registers_, &State::is_known);
}

std::optional<ScaleFault> ScaleCheck::fault() const
{
    for (const State& one : registers_)
        if (is_used_ && one.contradicts) return ScaleFault{one.reg.tag, *one.contradicts, one.reg.expected};
    return std::nullopt;
}

bool ScaleCheck::contradicts(const Tag& row) const
{
    return std::ranges::any_of(registers_,
                               [&](const State& one) { return one.contradicts && concerns(one.reg, row); });
}

} // namespace dpslave::drive
