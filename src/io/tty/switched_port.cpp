// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/switched_port.hpp"

#include "tty_settings.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <algorithm>
#include <utility>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kLongestRequest = 255; ///< octets
/// A wait shorter than this is spun: to sleep takes longer.
constexpr auto kSpin = 25us;
/// No instrument answers sooner, at any rate: above 19200 bit/s a frame of Modbus begins 1.75 ms after the
/// one before (MODBUS over Serial Line V1.02, 2.5.1.1).
constexpr auto kSoonestAnswer = 500us;
/// A UART that was never empty within the guard time for so many requests is not asked any more.
constexpr std::uint64_t kTrusted = 3;

void count(TransceiverCounts* counts, std::atomic<std::uint64_t> TransceiverCounts::*which)
{
    if (counts != nullptr) (counts->*which).fetch_add(1, std::memory_order_relaxed);
}

Result<DriverEnable, std::string> open_driver(const DriverEnableSettings& settings)
{
    const InCall open{PortCall::driver_enable};
    return DriverEnable::open(settings);
}

Transmission::Times times_of(const TtySettings& settings)
{
    const auto character = character_time(settings);
    return {.character = character, .guard = 2 * kLongestRequest * character};
}

} // namespace

SwitchedPort::SwitchedPort(Port port, DriverEnable driver, const TransceiverSettings& settings)
    : port_(std::move(port)),
      driver_(std::move(driver)),
      settings_(settings),
      times_(times_of(port_.settings()))
{}

Result<SwitchedPort, std::string> SwitchedPort::open(std::string path, const TtySettings& settings,
                                                     const TransceiverSettings& transceiver,
                                                     std::chrono::nanoseconds first_wait)
{
    auto driver = open_driver(transceiver.driver);
    if (!driver) return Failure{driver.error()};
    TtySettings wanted = settings;
    wanted.drop_rts_at_close =
        transceiver.driver.direction != Direction::rts || !transceiver.driver.active_low;
    auto port = Port::open(std::move(path), wanted, first_wait);
    if (!port) return Failure{port.error()};
    SwitchedPort made{*std::move(port), *std::move(driver), transceiver};
    if (auto trouble = made.join()) return Failure{*std::move(trouble)};
    return made;
}

std::optional<std::string> SwitchedPort::join()
{
    const InCall joins{PortCall::driver_enable};
    if (auto trouble = driver_.attach(port_.tty())) return trouble;
    auto trouble = driver_.self_check();
    if (trouble) driver_.detach();
    return trouble;
}

std::chrono::nanoseconds SwitchedPort::late_after() const
{
    return std::max<std::chrono::nanoseconds>(times_.character, kSoonestAnswer);
}

bool SwitchedPort::ready(Instant now)
{
    if (port_.is_open()) return true;
    if (!port_.ready(now)) return false;
    const InCall joins{PortCall::driver_enable};
    std::optional<std::string> trouble = driver_.attach(port_.tty());
    if (!trouble && !driver_.ready(now)) trouble = "the driver enable does not work yet";
    if (!trouble) return true;
    driver_.detach();
    port_.refuse(now, port_.path() + ": " + *trouble);
    return false;
}

void SwitchedPort::lose(Instant now)
{
    transmission_.stop();
    if (port_.is_open()) driver_.detach();
    port_.lose(now);
}

void SwitchedPort::reopen(Instant now)
{
    transmission_.stop();
    if (port_.is_open()) driver_.detach();
    port_.reopen(now);
}

std::error_code SwitchedPort::write(Bytes octets)
{
    if (!this_thread_may_write()) return std::make_error_code(std::errc::operation_canceled);
    port_.tty().discard_output();
    if (!this_thread_may_write()) return std::make_error_code(std::errc::operation_canceled);
    const std::error_code error = write_switched(octets);
    // The call came back long after it was made: nobody knows what has left and when.
    return this_thread_stalled() ? std::make_error_code(std::errc::timed_out) : error;
}

std::error_code SwitchedPort::write_switched(Bytes octets)
{
    if (!driver_.by_hand()) return port_.tty().write(octets);
    const RaisedPriority raised{settings_.priority};
    if (const auto error = switch_driver(true)) {
        count(settings_.counts, &TransceiverCounts::errors);
        if (error != std::errc::resource_unavailable_try_again) refuse(error);
        return error;
    }
    count(settings_.counts, &TransceiverCounts::requests);
    const std::error_code error = port_.tty().write(octets);
    if (error)
        static_cast<void>(port_.tty().discard_unsent()); // it must not leave with the next request
    else
        wait_until_gone(octets.size());
    release(!error);
    return error;
}

std::error_code SwitchedPort::switch_driver(bool active)
{
    const InCall edge{PortCall::driver_enable};
    return driver_.set(active, monotonic_now());
}

/// Sleeps until the last stop bit should have gone, and then until the UART agrees or the guard time is over.
void SwitchedPort::wait_until_gone(std::size_t octets)
{
    const std::uint64_t guarded = transmission_.guarded();
    transmission_.begin(static_cast<std::int64_t>(octets) * times_.character, monotonic_now(), times_);
    std::optional<bool> empty;
    do {
        while (monotonic_now() < transmission_.ends_at() - kSpin) {
            sleep_until(std::min(transmission_.ends_at() - kSpin, monotonic_now() + ThreadSign::kSlice));
            give_sign();
        }
        while (monotonic_now() < transmission_.ends_at()) {
        }
        const InCall drain{PortCall::drain};
        empty = transmission_.guarded() < kTrusted ? port_.tty().transmitter_empty() : std::nullopt;
    } while (!transmission_.is_over(monotonic_now(), empty));
    if (transmission_.guarded() != guarded) count(settings_.counts, &TransceiverCounts::guarded);
}

void SwitchedPort::release(bool is_sent)
{
    transmission_.stop();
    const std::error_code error = switch_driver(false);
    if (is_sent && monotonic_now() - transmission_.busy_until() > late_after())
        count(settings_.counts, &TransceiverCounts::late);
    if (!error) return;
    count(settings_.counts, &TransceiverCounts::errors);
    refuse(error);
}

/// Nothing is sent through a port whose driver enable does not work.
void SwitchedPort::refuse(const std::error_code& why)
{
    driver_.detach();
    port_.refuse(monotonic_now(), port_.path() + ": the driver enable cannot be switched (" + why.message() +
                                      "): look at gpio_chip, gpio_line and `direction`");
}

} // namespace dpslave::io
