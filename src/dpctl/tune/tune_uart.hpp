// SPDX-License-Identifier: Apache-2.0
/// What is known of UARTs and their drivers: which rates they make, and how long they keep received
/// characters to themselves, as far as a look from outside shows it. Pure. Source: wire reference 11.2
/// and 11.5.
#pragma once

#include "machine.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/io/uart_kind.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::dpctl {

/// By its driver, or by what else gives it away.
io::UartKind uart_of(const io::PortFacts& port);
/// The 8250 family but 8250_omap, which has its own ways.
bool is_16550(io::UartKind kind);

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
