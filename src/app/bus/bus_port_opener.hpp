// SPDX-License-Identifier: Apache-2.0
/// Opens and closes the port of the bus with its driver enable, in a thread of its own: each of these calls
/// may stall, and neither the bus thread nor the main thread waits for one.
#pragma once

#include "app/links/links.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/port.hpp"

#include <atomic>
#include <bitset>
#include <chrono>
#include <stop_token>
#include <string>
#include <thread>

namespace dpslave::app {

/// The PROFIBUS character format (8E1, bad characters marked, each octet at once) at the configured rate;
/// where it is searched, at the lowest, which every UART can do.
io::TtySettings bus_tty_settings(const config::Config& config);

class BusPortOpener {
public:
    /// Opens nothing yet. `first_wait`: of io::Port. `driver` and `link` outlive the object.
    BusPortOpener(const config::Config& config, io::DriverEnable& driver, BusLink& link,
                  std::chrono::nanoseconds first_wait = io::Port::kFirstWait);
    ~BusPortOpener(); ///< as end(), for as long as that takes

    // The main thread's.
    void start();
    /// Waits for the end of the first try. False: it takes longer than `limit`.
    bool await_first_try(std::chrono::milliseconds limit) const;
    /// The port is closed and the driver inactive, whoever had them. The bus thread has ended. False: a call
    /// takes longer than `limit`.
    bool end(std::chrono::milliseconds limit);

    // The bus thread's.
    /// The port, open and with `driver` attached to it, from here to give_back(); null: there is none now.
    io::Port* lent() noexcept
    {
        return state_.load(std::memory_order_acquire) == State::lent ? &port_ : nullptr;
    }
    /// The rates that the port can do, where the rate is searched. While it is lent.
    const std::bitset<kBauds.size()>& rates() const { return rates_; }
    /// It could not be opened at first. While it is lent.
    bool was_missing() const { return was_missing_; }
    /// The port has gone: it is closed, and opened again as Port::lose() has it.
    void give_back() noexcept { give_back(State::lost); }
    /// It can be opened and is of no use: Port::refuse().
    void refuse(std::string why)
    {
        why_ = std::move(why);
        give_back(State::refused);
    }
    /// There is something to look at: a driver enable that does not work, which is tried again while the port
    /// stays lent; or BusLink::memory_is_ready. Any thread may call it.
    void wake() noexcept { wake_.ring(); }

private:
    enum class State : std::uint8_t {
        closed,  ///< here
        lent,    ///< the bus thread has the port
        lost,    ///< given back
        refused, ///< the same
        ended,   ///< the thread has ended
    };

    void give_back(State how) noexcept
    {
        state_.store(how, std::memory_order_release);
        wake_.ring();
    }
    void run(const std::stop_token& stop);
    void wait(Instant now);
    void close(State how, Instant now);
    bool open(Instant now);
    std::optional<std::string> join();
    void look_at_rates();
    void tell_first();
    void tell_warnings();
    void tell_trouble();
    void say(bool is_warning, std::string text);

    const std::string place_; ///< of the port in the configuration
    const std::optional<Baud> baud_;
    io::Port port_;
    io::DriverEnable& driver_;
    BusLink& link_;
    std::bitset<kBauds.size()> rates_ = std::bitset<kBauds.size()>{}.set();
    std::string rates_missing_; ///< in words; empty: none that is searched
    std::string why_;           ///< of State::refused
    bool was_open_ = false, was_missing_ = false;
    bool stack_is_small_ = false;
    std::atomic<State> state_{State::closed};
    std::atomic<bool> has_tried_{false};
    io::EventFd wake_;
    std::jthread thread_;
};

} // namespace dpslave::app
