// SPDX-License-Identifier: Apache-2.0
#include "line_orders.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::app {

/// The highest numbers of stations are the newest.
void LineOrders::fetch()
{
    while (const auto order = link_.orders.pop()) {
        const bool is_early = std::all_of(units_.begin(), units_.end(),
                                          [&](const LineUnit& unit) { return unit.number < order->station; });
        if (is_early)
            early_.push_back(*order);
        else
            apply(*order);
    }
}

void LineOrders::on_other_drives()
{
    for (const LineOrder& order : std::exchange(early_, {})) apply(order);
}

void LineOrders::apply(LineOrder order)
{
    const std::uint32_t number = order.order.number;
    if (link_.order_states.has_ended(number)) return link_.order_states.remove(number);
    const auto unit = std::find_if(units_.begin(), units_.end(),
                                   [&](const LineUnit& one) { return one.number == order.station; });
    order.order.unit = static_cast<std::size_t>(unit - units_.begin());
    const bool taken = order.is_survey ? poller_.survey(order.order.unit, number, order.order.tag, order.rule)
                                       : poller_.operate(order.order);
    if (taken)
        sent_.emplace(number, false);
    else // also where the station has left the line in the meantime
        answer({.number = number, .error = AccessError::no_answer, .word = 0});
}

void LineOrders::drop_ended()
{
    std::erase_if(sent_, [this](const auto& one) {
        const std::uint32_t number = one.first;
        if (!link_.order_states.has_ended(number)) return false;
        poller_.withdraw(number);
        link_.order_states.remove(number);
        return true;
    });
}

/// Whoever still waits for one is answered.
void LineOrders::drop_all()
{
    fetch();
    answer();
    for (const LineOrder& order : std::exchange(early_, {})) sent_.emplace(order.order.number, false);
    for (const auto& [number, sent] : std::exchange(sent_, {})) {
        poller_.withdraw(number);
        answer({.number = number, .error = AccessError::no_answer, .word = 0});
    }
}

void LineOrders::done(std::uint32_t number, bool sent)
{
    const auto order = sent_.find(number);
    if (order == sent_.end()) return;
    order->second = order->second || sent;
    if (!order->second) link_.order_states.not_sent(number);
}

void LineOrders::answer()
{
    while (const auto one = poller_.take_operate_answer()) {
        sent_.erase(one->number);
        answer(*one);
    }
}

void LineOrders::answer(const drive::OperateAnswer& answer)
{
    link_.answers.push(answer);
    link_.order_states.remove(answer.number); // behind the answer: it is there for whoever finds this
}

} // namespace dpslave::app
