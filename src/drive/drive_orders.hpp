// SPDX-License-Identifier: Apache-2.0
/// The orders for one drive that do not come from its layout: Demand Data, `dpctl read` and `dpctl write`,
/// and the survey. Says which of them is next and keeps what became of each.
#pragma once

#include "demand_queue.hpp"
#include "operate_queue.hpp"
#include "order_pacing.hpp"
#include "survey_slot.hpp"

#include "dpslave/drive/poller.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace dpslave::drive {

class DriveOrders {
public:
    // `row`: of the tag. `verdict` other than none answers an order without the drive. `is_lost`: the drive
    // is.
    void set_demand(const DemandOrder& order, const Tag* row, AccessError verdict, bool is_lost);
    bool operate(const OperateOrder& order, const Tag* row, AccessError verdict)
    {
        return operates_.add(order, row, verdict);
    }
    bool survey(std::uint32_t number, const Tag& row, std::optional<MnemonicRule> rule, bool is_lost);
    /// The layouts up to this one have ended, and their Demand Data with them.
    void end(Generation generation) { demand_.end(generation); }
    void drive_lost();
    void drop_superseded() { demand_.drop_superseded(); }
    /// Drops what is left of this order of dpctl, without an answer.
    void withdraw(std::uint32_t number)
    {
        operates_.withdraw(number);
        survey_.withdraw(number);
    }
    /// The row of each order is now the one that `row_of` makes of it.
    template <class RowOf>
    void exchange(RowOf row_of)
    {
        demand_.exchange(row_of);
        operates_.exchange(row_of);
    }

    /// One that may go now: Demand Data first, then dpctl.
    std::optional<Transaction> next();
    /// One that next() gives as soon as its turn has come.
    bool wait() const { return demand_.front() != nullptr || operates_.front() != nullptr; }
    std::optional<Transaction> next_survey(Instant now) const;
    Instant survey_due() const { return survey_.due(); }
    /// The cyclic transactions between the orders.
    OrderPacing& pacing() { return pacing_; }

    /// The end of a transaction of next(). `proven_by_reading`: see DemandQueue::done().
    void done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading, int retries);
    void survey_done(const Outcome& outcome, Instant now) { survey_.done(outcome, now); }

    std::uint64_t dropped() const { return demand_.dropped(); }
    std::optional<DemandAnswer> take_demand_answer() { return demand_.take_answer(); }
    std::optional<OperateAnswer> take_operate_answer();

private:
    Transaction write_once(Purpose purpose, const Tag* row, std::uint16_t word);

    DemandQueue demand_;
    OperateQueue operates_;
    SurveySlot survey_;
    OrderPacing pacing_;
    std::uint32_t demanded_ = 0;          ///< the order of Demand Data under way
    std::array<std::uint16_t, 1> word_{}; ///< of a write under way
};

} // namespace dpslave::drive
