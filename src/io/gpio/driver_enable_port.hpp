// SPDX-License-Identifier: Apache-2.0
/// Sets what a serial port can do about its direction: the ioctls of driver_enable.cpp, which are separate
/// because their header (asm/termbits.h) clashes with <termios.h>.
#pragma once

#include "dpslave/io/driver_enable.hpp"

#include <linux/serial.h>

#include <optional>
#include <string>

namespace dpslave::io {

/// Returns the settings that the program asks for; the driver may take others, as with bit rate and parity.
serial_rs485 rs485_wanted(const DriverEnableSettings& settings);
/// Empty = it does as asked, else a clause why it does not: "it does not switch at all".
std::string judge_rs485(const serial_rs485& wanted, const serial_rs485& took);
/// Returns for the log the differences that are no error; empty if there are none.
std::string remarks_on_rs485(const serial_rs485& wanted, const serial_rs485& took);

/// TIOCSRS485, then read back into `took`; 0, or errno. An 8250 answers the reading although it cannot do it.
int set_rs485(int fd, const serial_rs485& wanted, serial_rs485& took);
/// Returns whether the driver would accept TIOCSRS485; it is tried with the present setting, which changes
/// nothing.
bool can_rs485(int fd);

/// Ends the RS-485 mode that another program has left, in which the driver of the UART would switch RTS on
/// its own and may shut the receiver off. Returns nullopt if there was none, or it has ended; else a
/// sentence.
std::optional<std::string> end_rs485(int fd);

/// RTS asserted or not; 0, or errno. One system call.
int set_rts(int fd, bool asserted) noexcept;
/// Returns whether RTS is asserted; nullopt if this port has no RTS.
std::optional<bool> rts(int fd);
/// Sets whether the kernel drops RTS when the port is closed, however its owner ended.
int drop_rts_on_close(int fd, bool drop);

std::string name_of_port(int fd);
/// "direction = "kernel", or ...": what would work with this port, but for `but`.
std::string other_ways(int fd, Direction but);
/// A sentence: the port cannot do `direction`, why, and what it can do.
std::string cannot(int fd, Direction direction, const std::string& why);

/// A sentence: the line cannot be switched, why, and what to do.
std::string cannot_switch(const DriverEnableSettings& settings, const std::error_code& error);
/// "12.3 us"
std::string microseconds(std::chrono::nanoseconds time);

} // namespace dpslave::io
