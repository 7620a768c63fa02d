// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/poller.hpp"

#include "poller_unit.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::drive {

AnswerText answer_text(std::string_view text)
{
    AnswerText shown{};
    text.copy(shown.data(), shown.size() - 1);
    return shown;
}

Poller::Poller(const std::vector<DriveSettings>& units, BlockRule rule)
{
    for (const DriveSettings& settings : units)
        units_.push_back(std::make_unique<Unit>(settings, rule, units_.size()));
}

Poller::~Poller() = default;

void Poller::heard(std::size_t unit, Instant valid_at)
{
    units_[unit]->heard(valid_at);
}

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

void Poller::cancel_ride_through(std::size_t unit)
{
    units_[unit]->cancel_ride_through();
}

void Poller::end_ride(std::size_t unit)
{
    units_[unit]->end_ride();
}

bool Poller::operate(const OperateOrder& order)
{
    return order.unit < units_.size() && units_[order.unit]->operate(order);
}

bool Poller::survey(std::size_t unit, std::uint32_t number, std::uint16_t tag,
                    std::optional<MnemonicRule> rule)
{
    return unit < units_.size() && units_[unit]->survey(number, tag, rule);
}

void Poller::withdraw(std::uint32_t number)
{
    for (const auto& unit : units_) unit->withdraw(number);
}

/// One transaction a turn, the drives in a circle: what one of them costs, the others do not pay. Between two
/// rounds of the living drives at most one transaction that can time out, whatever its reason.
std::optional<Transaction> Poller::next(Instant now)
{
    shows_first_ = false;
    for (const auto& unit : units_) shows_first_ = unit->set_now(now) || shows_first_;
    if (doing_ || shows_first_) return std::nullopt;
    doing_ = next_survey(now);
    if (!doing_) doing_ = next_of(now);
    if (!doing_)
        doing_ = next_of(now); // the living drives have nothing to do: that is the end of their round
    began_ = now;
    return doing_;
}

/// A drive that may not answer is passed over while a living one still has its round.
std::optional<Transaction> Poller::next_of(Instant now)
{
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const std::size_t index = (turn_ + i) % units_.size();
        Unit& unit = *units_[index];
        const bool risks = unit.contact().link().is_in_doubt();
        if (risks && !may_time_out()) continue;
        const auto transaction = unit.contact().link().is_lost() ? probe(index, now) : unit.next(now);
        if (!transaction) continue;
        turn_ = (index + 1) % units_.size();
        return transaction;
    }
    return std::nullopt;
}

bool Poller::may_time_out() const
{
    return std::none_of(units_.begin(), units_.end(), [](const auto& unit) { return unit->owes_round(); });
}

/// When a lost drive is probed next. Until it is decided whether it is gone: once a round. Then the one that
/// has waited longest, one of the line each probe interval.
Instant Poller::probe_due(std::size_t unit) const
{
    if (units_[unit]->contact().is_doubtful()) return units_[unit]->contact().decides_at();
    const auto longest = std::min_element(units_.begin(), units_.end(), [](const auto& a, const auto& b) {
        return a->contact().is_given_up() != b->contact().is_given_up()
                   ? a->contact().is_given_up()
                   : a->contact().asked_at() < b->contact().asked_at();
    });
    if (longest->get() != units_[unit].get()) return kNever;
    if (!probed_at_ || (*longest)->contact().is_asked_at_once()) return (*longest)->contact().probe_due();
    return std::max((*longest)->contact().probe_due(), *probed_at_ + (*longest)->contact().probe_interval());
}

std::optional<Transaction> Poller::probe(std::size_t unit, Instant now)
{
    if (now < probe_due(unit)) return std::nullopt;
    probes_ = units_[unit]->contact().is_given_up();
    return units_[unit]->probe();
}

/// A survey read may time out as well. It takes the place of a probe, but never goes before one.
std::optional<Transaction> Poller::next_survey(Instant now)
{
    if (!may_time_out()) return std::nullopt;
    for (std::size_t i = 0; i < units_.size(); ++i)
        if (units_[i]->contact().link().is_in_doubt() &&
            (!units_[i]->contact().link().is_lost() || now >= probe_due(i)))
            return std::nullopt;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        const auto transaction = units_[(turn_ + i) % units_.size()]->next_survey(now);
        if (!transaction) continue;
        for (const auto& unit : units_) unit->owe_round();
        return transaction;
    }
    return std::nullopt;
}

void Poller::done(const Outcome& outcome, Instant now)
{
    if (!doing_) return;
    const Transaction transaction = *std::exchange(doing_, std::nullopt);
    if (std::exchange(probes_, false)) probed_at_ = now;
    units_[transaction.unit]->done(transaction, outcome, began_, now);
    if (outcome.error == AccessError::no_answer)
        for (const auto& unit : units_) unit->owe_round();
}

Instant Poller::next_deadline() const
{
    Instant at = kNever;
    if (doing_) return at; // done() comes first
    if (shows_first_) return kAtOnce;
    for (std::size_t i = 0; i < units_.size(); ++i) {
        at = std::min(at, units_[i]->next_deadline());
        if (units_[i]->contact().link().is_lost()) at = std::min(at, probe_due(i));
    }
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

std::vector<ZeroLeft> Poller::safe_state_left(std::size_t unit) const
{
    return units_[unit]->safe_state_left();
}

const DriveSnapshot& Poller::snapshot(std::size_t unit) const
{
    return units_[unit]->snapshot();
}

void Poller::not_asked(std::size_t unit, Instant now)
{
    units_[unit]->not_asked(now);
}

void Poller::leave_port()
{
    for (const auto& unit : units_) unit->leave_port();
}

void Poller::port_changed()
{
    for (const auto& unit : units_) unit->port_changed();
}

void Poller::exchange(const std::vector<DriveSettings>& units,
                      const std::vector<std::optional<std::size_t>>& stays, BlockRule rule)
{
    std::vector<std::unique_ptr<Unit>> next;
    for (std::size_t i = 0; i < units.size(); ++i) {
        if (stays[i]) {
            next.push_back(std::move(units_[*stays[i]]));
            next[i]->go_on_as(i, units[i]);
        } else {
            next.push_back(std::make_unique<Unit>(units[i], rule, i));
        }
    }
    units_ = std::move(next);
    turn_ = 0;
}

} // namespace dpslave::drive
