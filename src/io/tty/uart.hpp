// SPDX-License-Identifier: Apache-2.0
/// Finds out what the kernel knows of the UART behind a tty: the rate that is really on the wire, and how
/// soon a received octet can be read. Source: wire reference 11.2 and 11.5.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::io {

struct Uart {
    bool pty = false;             ///< the slave end of a pseudo terminal: it has no UART at all
    int type = 0;                 ///< PORT_... of linux/serial_core.h; 0 = not known
    std::uint32_t baud_base = 0;  ///< clock / 16, in bit/s; 0 = not known
    std::string name;             ///< "ttyS1"; empty = sysfs does not know it
    std::string driver;           ///< "serial8250", as sysfs calls it; empty = not known
    std::filesystem::path folder; ///< of the tty in sysfs
    /// note_triggers() fills them.
    std::optional<long> latency_timer, receive_trigger;
};

/// `sysfs`: where it lies. Fields that cannot be found out stay empty.
Uart look_at(int fd, const std::filesystem::path& sysfs);
/// Type and clock once more: some drivers set the clock by the rate.
void refresh(Uart& uart, int fd);

/// Returns the rate that an integer divisor makes of `asked` bit/s. The 8250 driver divides by the nearest
/// one and reports the rate that was asked for (93750 from a base of 115200 is 115200 on the wire). It is
/// nullopt if this UART does not divide like that, or its clock is not known.
std::optional<std::uint32_t> rate_on_the_wire(const Uart& uart, std::uint32_t asked);

/// Drivers round or fall back without an error. The standard wants 0.3 %; that much and the rounding of the
/// number itself are allowed, beyond 1 % no telegram comes through. `took`: the rate that the driver reads
/// back. The result is empty if the rate is good enough, else a sentence without the path.
std::string judge_rate(const Uart& uart, std::uint32_t asked, std::uint32_t took);

/// A clause that says what to do about a rate that the UART cannot make.
std::string rate_remedy(const Uart& uart);

/// Makes every received octet readable at once, as far as the driver can: receive trigger 1,
/// latency timer 1 ms. Gives back what is left of delay, each a sentence without the path, with its cost in
/// bit times.
std::vector<std::string> set_prompt(const Uart& uart);

/// Looks in sysfs when the driver hands on what it has received, for hold_back(): no thread that serves asks
/// sysfs.
void note_triggers(Uart& uart);

/// Returns how long an octet may stay in the port before a read gives it, after note_triggers(); 0 if not at
/// all, or if nothing is known about it. `bit_time` at the present rate.
std::chrono::nanoseconds hold_back(const Uart& uart, std::chrono::nanoseconds bit_time);

} // namespace dpslave::io
