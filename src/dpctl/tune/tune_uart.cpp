// SPDX-License-Identifier: Apache-2.0
#include "tune_uart.hpp"

#include <algorithm>
#include <cmath>

namespace dpslave::dpctl {

using io::UartKind;

namespace {

double percent_off(double made, Baud wanted)
{
    return (made / static_cast<double>(wanted) - 1) * 100;
}

/// The nearest of the divisors n/steps, which is at least 1: percent off.
double fractional_error(double base, double steps, Baud baud)
{
    const double divisor = std::max(std::round(base * steps / static_cast<double>(baud)), steps);
    return percent_off(base * steps / divisor, baud);
}

} // namespace

io::UartKind uart_of(const io::PortFacts& port)
{
    if (port.pty) return UartKind::pty;
    const UartKind kind = io::uart_kind(port.driver);
    if (port.usb) return kind == UartKind::ftdi ? kind : UartKind::usb_other;
    // Only the 8250 family has a receive trigger in sysfs.
    return kind == UartKind::unknown && port.trigger ? UartKind::i8250_kin : kind;
}

bool is_16550(UartKind kind)
{
    return io::is_8250(kind) && kind != UartKind::omap;
}

std::uint32_t idle_timeout(const io::PortFacts& port)
{
    const UartKind kind = uart_of(port);
    if (kind == UartKind::unknown) return io::idle_timeout(UartKind::imx);
    const bool is_at_once = (port.trigger == 1 && !port.dma) || port.fifo == 1; // 16450: FIFO of one
    return io::is_8250(kind) && is_at_once ? 0 : io::idle_timeout(kind);
}

double divisor_error(std::uint32_t clock, Baud baud)
{
    return fractional_error(clock / 16.0, 1, baud);
}

std::optional<double> rate_error(const io::PortFacts& port, Baud baud)
{
    constexpr double kFtdiBase = 3'000'000; // FT232R, eighths
    const UartKind kind = uart_of(port);
    if (kind == UartKind::pty) return 0.0;
    if (kind == UartKind::ftdi) return fractional_error(kFtdiBase, 8, baud);
    if (!port.uart_clock) return std::nullopt;
    if (io::is_8250(kind)) return divisor_error(*port.uart_clock, baud);
    if (kind == UartKind::pl011) return fractional_error(*port.uart_clock / 16.0, 64, baud);
    // Any rate up to a sixteenth of the clock, to a few millionths.
    if (kind == UartKind::imx) return std::min(0.0, percent_off(*port.uart_clock / 16.0, baud));
    return std::nullopt;
}

} // namespace dpslave::dpctl
