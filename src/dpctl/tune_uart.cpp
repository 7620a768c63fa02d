// SPDX-License-Identifier: Apache-2.0
#include "tune_uart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace dpslave::dpctl {
namespace {

/// Names of drivers as sysfs has them.
constexpr std::array kDrivers = std::to_array<std::pair<std::string_view, Uart>>({
    {"uart-pl011", Uart::pl011},
    {"imx-uart", Uart::imx},
    {"omap8250", Uart::omap},
    {"mt6577-uart", Uart::mediatek},
    {"bcm2835-aux-uart", Uart::mini},
    {"serial", Uart::i8250}, // PNP and PCI
    {"serial8250", Uart::i8250},
    {"dw-apb-uart", Uart::i8250},
    {"of_serial", Uart::i8250},
    {"exar_serial", Uart::i8250},
});

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

Uart uart_of(const io::PortFacts& port)
{
    if (port.pty) return Uart::pty;
    if (port.usb) return port.driver == "ftdi_sio" ? Uart::ftdi : Uart::usb_other;
    for (const auto& [driver, uart] : kDrivers)
        if (port.driver == driver) return uart;
    return port.trigger ? Uart::i8250 : Uart::unknown; // only the 8250 family has a receive trigger in sysfs
}

bool is_usb(Uart uart)
{
    return uart == Uart::ftdi || uart == Uart::usb_other;
}

std::uint32_t idle_timeout(const io::PortFacts& port)
{
    constexpr std::uint32_t kFourCharacters = 44, kEightCharacters = 88;
    switch (uart_of(port)) {
        case Uart::pty:
        case Uart::ftdi:
        case Uart::usb_other:
        case Uart::mini: return 0;
        case Uart::pl011: return 32;
        case Uart::imx:
        case Uart::unknown: return kEightCharacters;
        case Uart::omap:
        case Uart::i8250:
            if (port.trigger == 1 && !port.dma) return 0;
            return port.fifo == 1 ? 0 : kFourCharacters; // 16450: one character, handed on at once
        case Uart::mediatek: break;
    }
    return kFourCharacters;
}

double divisor_error(std::uint32_t clock, Baud baud)
{
    return fractional_error(clock / 16.0, 1, baud);
}

std::optional<double> rate_error(const io::PortFacts& port, Baud baud)
{
    constexpr double kFtdiBase = 3'000'000; // FT232R, eighths
    const Uart uart = uart_of(port);
    if (uart == Uart::pty) return 0.0;
    if (uart == Uart::ftdi) return fractional_error(kFtdiBase, 8, baud);
    if (!port.uart_clock) return std::nullopt;
    switch (uart) {
        case Uart::i8250:
        case Uart::omap: return divisor_error(*port.uart_clock, baud);
        case Uart::pl011: return fractional_error(*port.uart_clock / 16.0, 64, baud);
        case Uart::imx: // any rate up to a sixteenth of the clock, to a few millionths
            return std::min(0.0, percent_off(*port.uart_clock / 16.0, baud));
        default: return std::nullopt;
    }
}

} // namespace dpslave::dpctl
