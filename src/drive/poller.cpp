// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/poller.hpp"

#include "poller_unit.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::drive {

Poller::Poller(const std::vector<UnitSettings>& units, BlockRule rule)
{
    for (const UnitSettings& settings : units)
        units_.push_back(std::make_unique<Unit>(settings, rule, units_.size()));
}

Poller::~Poller() = default;

void Poller::set_outputs(std::size_t unit, const OutputImage& image)
{
    units_[unit]->set_outputs(image);
}

void Poller::left_data_exchange(std::size_t unit, const LeftDataExchange& left)
{
    units_[unit]->left_data_exchange(left.generation);
}

void Poller::set_demand(std::size_t unit, const DemandOrder& order)
{
    units_[unit]->set_demand(order);
}

void Poller::set_zero_after(std::size_t unit, ZeroAfter after)
{
    units_[unit]->set_zero_after(after);
}

void Poller::ride_no_longer()
{
    for (const auto& unit : units_) unit->ride_no_longer();
}

void Poller::ride_no_longer(std::size_t unit)
{
    units_[unit]->ride_no_longer();
}

bool Poller::operate(const OperateOrder& order)
{
    return order.unit < units_.size() && units_[order.unit]->operate(order);
}

/// One transaction a turn, the drives in a circle: what one of them costs, the others do not pay.
std::optional<Transaction> Poller::next(Instant now)
{
    for (const auto& unit : units_) unit->tell_time(now);
    if (doing_) return std::nullopt;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const std::size_t unit = (turn_ + i) % units_.size();
        doing_ = units_[unit]->next(now);
        if (!doing_) continue;
        turn_ = (unit + 1) % units_.size();
        return doing_;
    }
    return std::nullopt;
}

void Poller::done(const Outcome& outcome, Instant now)
{
    if (!doing_) return;
    const Transaction transaction = *std::exchange(doing_, std::nullopt);
    units_[transaction.unit]->done(transaction, outcome, now);
}

Instant Poller::next_deadline() const
{
    Instant at = kNever;
    if (doing_) return at; // done() comes first
    for (const auto& unit : units_) at = std::min(at, unit->next_deadline());
    return at;
}

std::optional<InputImage> Poller::take_inputs(std::size_t unit)
{
    return units_[unit]->take_inputs();
}

std::optional<DemandAnswer> Poller::take_demand_answer(std::size_t unit)
{
    return units_[unit]->take_demand_answer();
}

std::optional<OperateAnswer> Poller::take_operate_answer()
{
    for (const auto& unit : units_)
        if (auto answer = unit->take_operate_answer()) return answer;
    return std::nullopt;
}

bool Poller::safe_state_pending() const
{
    return std::any_of(units_.begin(), units_.end(),
                       [](const auto& unit) { return unit->safe_state_pending(); });
}

bool Poller::safe_state_pending(std::size_t unit) const
{
    return units_[unit]->safe_state_pending();
}

const UnitSnapshot& Poller::snapshot(std::size_t unit) const
{
    return units_[unit]->snapshot();
}

void Poller::exchange(const std::vector<UnitSettings>& units,
                      const std::vector<std::optional<std::size_t>>& stays, BlockRule rule)
{
    std::vector<std::unique_ptr<Unit>> next;
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (stays[i]) {
            next.push_back(std::move(units_[*stays[i]]));
            next[i]->go_on_as(i, units[i].retries);
        } else {
            next.push_back(std::make_unique<Unit>(units[i], rule, i));
        }
    }
    units_ = std::move(next);
    turn_ = 0;
}

} // namespace dpslave::drive
