// SPDX-License-Identifier: Apache-2.0
/// Does for tty.cpp what needs termios2. It is separate because its header (asm/termbits.h) clashes with
/// <termios.h>, which other system headers may include.
#pragma once

#include "uart.hpp"

#include "dpslave/io/tty.hpp"

namespace dpslave::io {

/// Returns the time from start bit to stop bit, at the rate asked for.
std::chrono::nanoseconds character_time(const TtySettings& settings);

/// Raw, at the rate and format asked for, everything old discarded; then reads back what the driver made of
/// it. `uart` is asked for its clock again. Empty = done, else a sentence without the path.
std::string apply(int fd, const TtySettings& settings, Uart& uart);

/// Another rate, all else as it is; what was not sent or read yet is discarded. `uart` is asked for its
/// clock again. Empty = done, and nothing was allocated; else a sentence without the path.
std::string change_rate(int fd, std::uint32_t baud, Uart& uart);

/// Returns whether the last stop bit has gone; nullopt if the driver does not know, and errno says why.
std::optional<bool> transmitter_empty(int fd);

bool flush_input(int fd); ///< false: errno says why
void flush_output(int fd);
bool has_unsent(int fd); ///< octets that the kernel has not handed to the transmitter

} // namespace dpslave::io
