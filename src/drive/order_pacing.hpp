// SPDX-License-Identifier: Apache-2.0
/// When an order of Demand Data or dpctl may go between the cyclic transactions of one drive.
#pragma once

#include "demand_queue.hpp"

namespace dpslave::drive {

class OrderPacing {
public:
    /// A new order waits for the transaction under way only, unless that belongs to an order of Demand Data
    /// that is not a repetition. An order that is asked again is asked once a round.
    bool may_go(const DemandQueue::Entry& demand) const
    {
        if (in_round_ >= (demand.is_again() ? 1 : kPerRound)) return false;
        if (is_repetition(demand)) return cyclic_since_ >= kBeforeRepeat;
        const bool is_new = demand.stage == DemandQueue::Stage::ordered && demand.attempts == 0;
        return cyclic_since_ > 0 || (is_new && new_may_follow_);
    }
    bool may_operate() const { return cyclic_since_ > 0; } ///< an order of dpctl

    void demand_sent(const DemandQueue::Entry& demand)
    {
        new_may_follow_ = is_repetition(demand);
        cyclic_since_ = 0;
        ++in_round_;
    }
    void operation_sent()
    {
        new_may_follow_ = true;
        cyclic_since_ = 0;
    }
    void cyclic_sent() { ++cyclic_since_; }
    void round_begins() { in_round_ = 0; }
    void no_cyclic_left() { cyclic_since_ = kBeforeRepeat; } ///< is there to go first

private:
    /// Active Demand Data may lengthen a round by 16 ms on the 590 and by 30 ms on the 584S, where a
    /// parameter takes 8 and 15 ms (HA389815 ch. 8): that is two transactions. One repeats the standing
    /// order, one is for a new order.
    static constexpr int kPerRound = 2;
    /// On the 620 a parameter takes 25 ms and Demand Data adds 16 ms: less than one transaction. So a
    /// standing order is repeated after two cyclic transactions at the earliest, also in a round of one.
    static constexpr int kBeforeRepeat = 2;

    static bool is_repetition(const DemandQueue::Entry& demand)
    {
        return demand.stage == DemandQueue::Stage::answered;
    }

    int in_round_ = 0;                 ///< transactions of Demand Data
    int cyclic_since_ = kBeforeRepeat; ///< the last order
    bool new_may_follow_ = true;       ///< the last order: at once
};

} // namespace dpslave::drive
