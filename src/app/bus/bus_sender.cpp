// SPDX-License-Identifier: Apache-2.0
#include "bus_sender.hpp"

#include "dpslave/io/clock.hpp"

namespace dpslave::app {

Result<Instant, BusSender::Unsent> BusSender::send(Bytes telegram, io::Tty& tty, Baud baud, Instant not_after)
{
    const bool by_hand = driver_.by_hand();
    if (by_hand && !make_active(tty)) return Failure{Unsent::no_driver};
    if (const Instant now = io::monotonic_now(); now > not_after) {
        if (by_hand) make_inactive(now);
        return Failure{Unsent::too_late};
    }
    if (const std::error_code error = tty.send(telegram)) {
        ++write_errors_;
        if (by_hand) make_inactive(io::monotonic_now());
        return Failure{error == std::errc::no_buffer_space ? Unsent::not_taken : Unsent::port_gone};
    }
    const Instant written = io::monotonic_now();
    if (by_hand) transmission_.begin(telegram.size(), written, baud);
    return written;
}

/// Each reply has a pulse of its own. A request was answered while the last reply seems to be on its way
/// still: the line was free, so it has gone out faster than its rate says (a pty, an emulated UART) - unless
/// the UART itself says that it has not; then this reply comes behind it, and the driver stays as it is, if
/// the guard has not let it go meanwhile. From then on it may still do so: this reply is then cut, as a stuck
/// one is.
bool BusSender::make_active(const io::Tty& tty)
{
    if (!driver_.works()) return false;
    if (transmission_.is_running()) {
        const bool goes_out = !shift_register(tty).value_or(true);
        if (goes_out && driver_.active_since()) return true;
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
    if (transmission_.is_over(now, shift_register(tty))) make_inactive(now);
}

/// A UART that was never empty within the guard time is not asked any more: its driver does not know.
std::optional<bool> BusSender::shift_register(const io::Tty& tty) const
{
    constexpr std::uint64_t kTrusted = 3;
    if (transmission_.guarded() >= kTrusted) return std::nullopt;
    return tty.transmitter_empty();
}

void BusSender::abort()
{
    if (is_sending()) make_inactive(io::monotonic_now());
}

} // namespace dpslave::app
