// SPDX-License-Identifier: Apache-2.0
#include "drive_orders.hpp"

#include "transactions.hpp"

namespace dpslave::drive {
namespace {

constexpr Outcome kSilence{.error = AccessError::no_answer, .words = {}};

} // namespace

void DriveOrders::set_demand(const DemandOrder& order, const Tag* row, AccessError verdict, bool is_lost)
{
    demand_.set(order, row, verdict);
    if (is_lost) demand_.drop_superseded();
}

bool DriveOrders::survey(std::uint32_t number, const Tag& row, std::optional<MnemonicRule> rule, bool is_lost)
{
    if (!survey_.set(number, row, rule)) return false;
    if (is_lost) survey_.done(kSilence, {});
    return true;
}

void DriveOrders::drive_lost()
{
    demand_.drop_superseded();
    operates_.drive_lost();
    survey_.done(kSilence, {});
}

std::optional<Transaction> DriveOrders::next()
{
    const DemandQueue::Entry* const demand = demand_.front();
    if (demand != nullptr && pacing_.may_go(*demand)) {
        pacing_.demand_sent(*demand);
        demanded_ = demand->order.number;
        return demand->writes_next() ? write_once(Purpose::demand, demand->row, demand->order.value)
                                     : read_of(Purpose::demand, demand->row);
    }
    const OperateQueue::Entry* const operate = operates_.front();
    if (operate == nullptr || !pacing_.may_operate()) return std::nullopt;
    pacing_.operation_sent();
    Transaction transaction = operate->writes_next()
                                  ? write_once(Purpose::operate, operate->row, operate->order.word)
                                  : read_of(Purpose::operate, operate->row);
    transaction.order = operate->order.number;
    return transaction;
}

std::optional<Transaction> DriveOrders::next_survey(Instant now) const
{
    if (survey_.due() > now) return std::nullopt;
    Transaction transaction = read_of(Purpose::survey, survey_.row());
    transaction.order = survey_.number();
    return transaction;
}

Transaction DriveOrders::write_once(Purpose purpose, const Tag* row, std::uint16_t word)
{
    word_[0] = word;
    Transaction transaction = write_of(purpose, row, word_);
    transaction.once = true;
    return transaction;
}

void DriveOrders::done(const Transaction& transaction, const Outcome& outcome, bool proven_by_reading,
                       int retries)
{
    if (transaction.purpose == Purpose::demand)
        demand_.done(demanded_, transaction, outcome, proven_by_reading, retries);
    else
        operates_.done(transaction, outcome, proven_by_reading, retries);
}

std::optional<OperateAnswer> DriveOrders::take_operate_answer()
{
    if (auto answer = operates_.take_answer()) return answer;
    return survey_.take();
}

} // namespace dpslave::drive
