// SPDX-License-Identifier: Apache-2.0
/// The bus thread: octets from the tty to layer 2, replies back in their window, then everything that others
/// want to know. Nothing is decided here, nothing is allocated after start while the port is there, nothing
/// blocks but the wait for octets.
#pragma once

#include "app/links.hpp"
#include "bus_sender.hpp"
#include "bus_station.hpp"
#include "snapshot_turns.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/fdl/echo.hpp"
#include "dpslave/fdl/layer2.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/port.hpp"
#include "dpslave/io/ticker.hpp"

#include <array>
#include <bitset>
#include <memory>
#include <optional>
#include <stop_token>

namespace dpslave::app {

/// The PROFIBUS character format (8E1, bad characters marked, each octet at once) at the configured rate;
/// where it is searched, at the lowest, which every UART can do.
io::TtySettings bus_tty_settings(const config::Config& config);

class BusThread {
public:
    /// `port` is open, and `driver` attached to it. Where the rate is searched the port is asked which rates
    /// it can do. More and other stations come through BusLink::roster.
    BusThread(const config::BusConfig& config, io::Port port, io::DriverEnable& driver,
              std::unique_ptr<Roster> roster, BusLink& link);
    ~BusThread();
    BusThread(const BusThread&) = delete;
    BusThread& operator=(const BusThread&) = delete;

    /// Serves the bus until `stop`; then every slave leaves it, with all that leaving means.
    void run(std::stop_token stop, io::EventFd& wake);

private:
    /// The longest sleep: also the heartbeat, and the resolution of every deadline that is further away.
    static constexpr std::chrono::milliseconds kTick{10};
    static constexpr std::chrono::microseconds kSpin = BusSender::kSpin;
    static constexpr std::chrono::microseconds kLastLook{1};
    /// While a driver is to be let go within this time nothing longer is begun.
    static constexpr std::chrono::microseconds kHurry{200};
    static constexpr std::size_t kPlaces = SnapshotTurns::kPlaces;
    /// Who has something to say, in the epoll.
    static constexpr std::uint64_t kTtyKey = 0, kWakeKey = 1, kTickKey = 2;

    /// Where a station is held, so that it keeps its place while others come and go.
    struct Place {
        BusStation* station = nullptr;
        std::optional<std::uint8_t> address; ///< nothing = not on the bus
        bool leaving = false; ///< not in the next roster: it stays only until its last word was taken
    };

    Instant next_wake() const;
    bool octets_before(Instant when);
    void look(bool octets);
    void wait_for_window();
    bool read_line();
    void hear(Bytes octets, Instant read_at, bool more);
    void send();
    void count_turnaround(Instant written, Baud baud);
    void finish_sending();
    bool in_a_hurry(Instant now) const;
    bool may_show(Instant now) const;
    void hand_on();

    void follow_roster();
    bool part_with_leavers(const Roster& next);
    void seat_newcomers();
    void obey_orders();
    void take_off(std::size_t place);
    void put_on(std::size_t place);
    void leave_bus();

    void follow_rate();
    void set_baud(Baud baud);
    void show(Instant now);
    void show_bus(Instant now);
    void tell(PortNews news) { link_.port_news.push(news); } // full: the log is not worth a lost telegram
    void watch_port();
    void lose_port();
    void refuse_port(const std::string& why);
    void let_go_of_port();
    void tell_trouble();
    void tell(PortWords words);
    void try_reopen(Instant now);
    void mind_driver(Instant now);

    io::Port port_;
    io::DriverEnable& driver_;
    BusSender sender_;
    fdl::Echo echo_;
    fdl::Layer2 layer2_;
    BusLink& link_;

    std::unique_ptr<Roster> roster_;
    std::array<Place, kPlaces> places_{};
    std::array<std::optional<std::uint8_t>, kPlaces> at_{}; ///< which place has this address
    std::bitset<kPlaces> waiting_; ///< places with an order that could not be handed on yet
    SnapshotTurns turns_;
    bool orders_due_ = true; ///< roster and orders of the main thread are looked at with each tick

    io::Epoll epoll_;
    io::Ticker ticker_{kTick};
    std::array<std::uint8_t, 512> buffer_{};
    Instant heard_at_{}; ///< when the newest octets were read that are not our own
    Histogram turnaround_us_;
    Histogram turnaround_tbit_;
    std::uint64_t too_late_ = 0;
    std::uint64_t unsent_ = 0;

    Instant next_bus_snapshot_{};
    std::uint64_t faults_at_start_ = 0;
    bool driver_worked_ = true;
    bool guard_told_ = false;
    std::uint64_t guarded_ = 0; ///< as seen last
};

} // namespace dpslave::app
