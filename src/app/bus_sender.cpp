// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/bus_sender.hpp"

#include "dpslave/io/clock.hpp"

namespace dpslave::app {

std::optional<Instant> BusSender::send(Bytes telegram, io::Tty& tty, Baud baud)
{
    const bool by_hand = driver_.by_hand();
    if (by_hand && !make_active(tty)) return std::nullopt;
    if (tty.send(telegram)) {
        ++write_errors_;
        if (by_hand) make_inactive(io::monotonic_now());
        return std::nullopt;
    }
    const Instant written = io::monotonic_now();
    if (by_hand) transmission_.begin(telegram.size(), written, baud);
    return written;
}

/// Each reply has a pulse of its own. A request was answered while the last reply seems to be on its way
/// still: the line was free, so it has gone out faster than its rate says (a pty, an emulated UART) - unless
/// the UART itself says that it has not; then this reply comes behind it, and the driver stays as it is.
bool BusSender::make_active(const io::Tty& tty)
{
    if (!driver_.works()) return false;
    if (transmission_.is_running()) {
        if (!tty.transmitter_empty().value_or(true)) return true;
        make_inactive(io::monotonic_now());
    }
    if (!driver_.set(true, io::monotonic_now())) return true;
    ++driver_errors_; // without driver enable a reply is no reply
    return false;
}

void BusSender::make_inactive(Instant now)
{
    transmission_.stop();
    if (driver_.set(false, now)) ++driver_errors_;
}

void BusSender::finish(const io::Tty& tty)
{
    Instant now = io::monotonic_now();
    if (!is_sending() || next_deadline() - now > kSpin) return;
    while (now < next_deadline()) now = io::monotonic_now();
    if (transmission_.is_over(now, tty.transmitter_empty())) make_inactive(now);
}

void BusSender::abort()
{
    if (is_sending()) make_inactive(io::monotonic_now());
}

} // namespace dpslave::app
