// SPDX-License-Identifier: Apache-2.0
/// The orders of `dpctl` (read, write, survey) of a drive line, from the ring to the poller and back. The
/// main thread may end each of them at any time; then nothing of it is sent any more. The drive thread's own.
#pragma once

#include "app/links/links.hpp"
#include "line_unit.hpp"

#include "dpslave/drive/poller.hpp"

#include <cstdint>
#include <map>
#include <vector>

namespace dpslave::app {

class LineOrders {
public:
    /// All outlive this object. `units`: in the order that the poller has.
    LineOrders(LineLink& link, drive::Poller& poller, const std::vector<LineUnit>& units)
        : link_(link), poller_(poller), units_(units)
    {}

    /// From the ring to the poller. An order for a drive that is about to come waits for it.
    void fetch();
    /// Other drives have come: the orders that waited for them go to the poller.
    void on_other_drives();
    /// The poller forgets those that the main thread has ended. No transaction is under way.
    void drop_ended();
    /// None is carried out any more. No transaction is under way.
    void drop_all();
    /// Before a transaction of this order. False: it has ended, and nothing is sent.
    bool begin(std::uint32_t number) { return link_.order_states.begin(number); }
    /// Behind it. `sent`: it may have reached the drive.
    void done(std::uint32_t number, bool sent);
    /// The answers of the poller go to the main thread.
    void answer();

private:
    void apply(LineOrder order);
    void answer(const drive::OperateAnswer& answer);

    LineLink& link_;
    drive::Poller& poller_;
    const std::vector<LineUnit>& units_;
    std::vector<LineOrder> early_;       ///< for drives that are among the next ones
    std::map<std::uint32_t, bool> sent_; ///< of each order that the poller has: whether a part was sent
};

} // namespace dpslave::app
