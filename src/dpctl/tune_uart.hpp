// SPDX-License-Identifier: Apache-2.0
/// What is known of UARTs and their drivers: which rates they make, and how long they keep received
/// characters to themselves. Pure. Source: wire reference 11.2 and 11.5.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/io/machine.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::dpctl {

enum class Uart : std::uint8_t {
    pty,       ///< no UART at all
    i8250,     ///< 16550 and its kin: integer divisor, receive trigger in sysfs
    omap,      ///< 8250_omap (AM335x): FIFO of 64
    pl011,     ///< fractional divisor, idle time-out of 32 T_bit that cannot be changed
    imx,       ///< rational divisor, aging timer
    mediatek,  ///< receives by DMA
    mini,      ///< mini-UART of the Raspberry Pi: no parity
    ftdi,      ///< USB, latency timer
    usb_other, ///< USB: CP210x, CH34x, CDC-ACM ...
    unknown,
};
Uart uart_of(const io::PortFacts& port);
bool is_usb(Uart uart);

/// Idle time on the line after which fewer characters than the receive trigger are handed on, T_bit; 0 =
/// every character is handed on at once, or the delay is not of this kind (USB, pty). Of a UART that is not
/// known the longest of those that are.
std::uint32_t idle_timeout(const io::PortFacts& port);

/// How far the rate that the UART makes of `baud` is off, in percent; nothing = its clock or its divider is
/// not known.
std::optional<double> rate_error(const io::PortFacts& port, Baud baud);
/// The rate with the nearest integer divisor of 16 * `baud`, as the 8250 driver takes it, in percent off.
double divisor_error(std::uint32_t clock, Baud baud);

} // namespace dpslave::dpctl
