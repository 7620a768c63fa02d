// SPDX-License-Identifier: Apache-2.0
/// One slave of the bus: a dp::Slave that fetches the newest inputs at each request, so that the cost of a
/// telegram does not grow with the number of stations.
#pragma once

#include "app/links/links.hpp"
#include "stalled_line.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/dp/slave.hpp"

#include <memory>
#include <optional>

namespace dpslave::app {

/// Built by the main thread, then the bus thread's alone while it is in its StationSet.
class BusStation final : public fdl::SapUser {
public:
    /// Takes from `config` what it needs.
    BusStation(const config::StationConfig& config, std::shared_ptr<StationLink> link);

    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override;
    void sdn(const fdl::Indication& request) override;
    void heard(std::uint8_t sa, Instant at) override { slave_.heard(sa, at); }
    Tbit min_tsdr() const override { return slave_.min_tsdr(); }
    fdl::Supervision supervision() const override { return slave_.supervision(); }
    void on_time(Instant now) override;
    Instant next_deadline() const override { return slave_.next_deadline(); }

    dp::Slave& slave() { return slave_; }
    const dp::Personality& personality() const { return *personality_; }

    /// Takes what the main thread ordered, also without a request of a master. True: it was new.
    bool take_orders();
    const BusOrders& orders() const { return orders_; }
    /// As the main thread orders, and its drive is not gone.
    bool is_wanted() const
    {
        return orders_.enabled && departures_ % 2 == 0 && !(leaves_when_lost_ && line_.is_stalled());
    }
    /// True: the drive was gone since the last call. Then the station leaves the bus, even if it comes back.
    bool take_departure();
    /// Judges the line of its drive. Call it at least every Silence::kLongestLook. True: something has
    /// changed, and forward() is due.
    bool judge_line(Instant now);

    /// Passes outputs, orders and events on. False: a full ring has refused an order; call again. While the
    /// line stalls only the newest order is kept, as a drive that is lost keeps it.
    bool forward();
    /// For the main thread.
    void publish_snapshot() { link_->bus_snapshot.publish(slave_.snapshot()); }

private:
    void fetch();
    void take_inputs();
    bool forward_orders();
    void keep_newest_order();

    std::shared_ptr<StationLink> link_;
    std::shared_ptr<const dp::Personality> personality_; // the slave refers to it
    dp::Slave slave_;
    BusOrders orders_;             ///< as taken last
    std::uint32_t departures_ = 0; ///< StationLink::departures, as taken last
    StalledLine line_;
    bool leaves_when_lost_, is_diagnosed_when_lost_; ///< when_drive_lost
    std::optional<DemandOrder> waiting_order_;       ///< refused by a full ring, or by a line that stalls
};

} // namespace dpslave::app
