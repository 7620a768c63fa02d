// SPDX-License-Identifier: Apache-2.0
/// Tells what is known of a UART by the name of its driver. It is pure. Source: wire reference 11.2 and 11.5.
#pragma once

#include <cstdint>
#include <string_view>

namespace dpslave::io {

enum class UartKind : std::uint8_t {
    unknown,
    pty,       ///< no UART at all
    i8250,     ///< 16550 and compatible ones: divides its clock by a whole number, receive trigger in sysfs
    i8250_kin, ///< the same registers, driven by a driver of its own (DesignWare, Exar), which sees to the
               ///< clock
    omap,      ///< 8250_omap (AM335x): FIFO of 64
    pl011,     ///< fractional divisor, idle timeout that cannot be changed
    imx,       ///< rational divisor, aging timer
    mediatek,  ///< receives by DMA
    mini,      ///< mini UART of the Raspberry Pi: its driver takes PARENB, and the hardware sends without
    ftdi,      ///< USB, latency timer
    usb_other, ///< USB: CP210x, CH34x, CDC-ACM ...
};

/// `driver`: as sysfs calls it, "uart-pl011".
UartKind uart_kind(std::string_view driver);
bool is_usb(UartKind kind);
/// Returns whether the UART is of the 8250 family, with its receive trigger in sysfs.
bool is_8250(UartKind kind);

/// Idle time on the line after which fewer characters than the receive trigger are handed on, T_bit; 0 = it
/// has no such wait (USB, pty), or nothing is known about it.
std::uint32_t idle_timeout(UartKind kind);

} // namespace dpslave::io
