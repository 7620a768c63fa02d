// SPDX-License-Identifier: Apache-2.0
/// The bus thread: octets from the tty to layer 2, replies back in their window, then everything that others
/// want to know. Nothing is decided here, nothing is allocated after start, nothing blocks but the wait for
/// octets.
#pragma once

#include "dpslave/app/config.hpp"
#include "dpslave/app/links.hpp"
#include "dpslave/dp/slave.hpp"
#include "dpslave/fdl/station.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/ticker.hpp"
#include "dpslave/io/tty.hpp"

#include <array>
#include <bitset>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace dpslave::app {

/// One slave as the bus sees it: a dp::Slave that fetches the newest inputs and answers when it is spoken to,
/// so that the cost of a telegram does not grow with the number of stations. It is on the bus while the main
/// thread wants it there.
class BusStation final : public fdl::SapUser {
public:
    BusStation(const StationConfig& config, StationLink& link);

    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override;
    void sdn(const fdl::Indication& request) override;
    void heard(std::uint8_t sa, Instant at) override { slave_.heard(sa, at); }
    Tbit min_tsdr() const override { return slave_.min_tsdr(); }
    fdl::Supervision supervision() const override { return slave_.supervision(); }
    void on_time(Instant now) override;
    Instant next_deadline() const override { return slave_.next_deadline(); }

    dp::Slave& slave() { return slave_; }

    /// Takes what the main thread ordered, also while nobody speaks to the station. True: it was news.
    bool take_orders();
    const BusOrders& orders() const { return orders_; }

    /// Hands outputs, orders and events on. False: a full ring has refused an order; call again.
    bool hand_on();
    /// Hands a fresh snapshot to the main thread.
    void publish_snapshot() { link_.bus_snapshot.publish(slave_.snapshot()); }

private:
    void fetch();

    StationLink& link_;
    dp::Slave slave_;
    BusOrders orders_;                         ///< as they were seen last
    std::optional<DemandOrder> waiting_order_; ///< refused by a full ring: late, not lost
};

/// The PROFIBUS character format (8E1, bad characters marked) at the configured rate.
io::TtySettings bus_tty_settings(const Config& config);

class BusThread {
public:
    /// `tty` is open; it is opened again with back-off when it vanishes. `stations` in the order of
    /// config.stations.
    BusThread(const Config& config, io::Tty tty, std::vector<std::unique_ptr<StationLink>>& stations,
              BusLink& link);

    /// Serves the bus until `stop`; then every slave leaves it, with all that leaving means.
    void run(std::stop_token stop, io::EventFd& wake);

private:
    /// The longest sleep: also the heartbeat, and the resolution of every deadline that is further away.
    static constexpr std::chrono::milliseconds kTick{10};
    static constexpr std::chrono::milliseconds kSnapshotInterval{50};
    static constexpr std::chrono::milliseconds kReopenAfter{500};
    /// A wait shorter than this is spun: going to sleep and coming back takes longer.
    static constexpr std::chrono::microseconds kSpin{25};
    static constexpr std::chrono::microseconds kLastLook{1};

    bool octets_before(Instant when);
    void look(bool octets);
    void wait_for_window();
    bool read_line();
    void send();
    void hand_on();
    void obey_orders();
    void take_off(std::size_t station);
    void put_on(std::size_t station);
    void show(Instant now);
    void show_bus(Instant now);
    void watch_port();
    void lose_port();
    void try_reopen(Instant now);

    const Config& config_;
    std::optional<io::Tty> tty_;
    fdl::Station station_;
    std::vector<std::unique_ptr<BusStation>> stations_;
    std::array<std::optional<std::uint8_t>, 128> at_{}; ///< which station is at this address
    std::vector<std::optional<std::uint8_t>> address_;  ///< of each station; nothing = not on the bus
    BusLink& link_;
    io::Epoll epoll_;
    io::Ticker ticker_{kTick};
    std::array<std::uint8_t, 512> buffer_{};
    bool orders_due_ = true;   ///< the orders of the main thread are looked at with each tick
    std::bitset<128> waiting_; ///< stations with an order that could not be handed on yet
    std::bitset<128> unseen_;  ///< stations whose snapshot is older than their state
    Instant next_snapshot_{};
    Instant next_bus_snapshot_{};
    unsigned turn_ = 0; ///< station whose snapshot went last
    Instant next_reopen_{};
    Instant last_telegram_{};
    std::uint64_t telegrams_seen_ = 0;
    std::uint64_t write_errors_ = 0;
};

} // namespace dpslave::app
