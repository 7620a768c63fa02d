// SPDX-License-Identifier: Apache-2.0
/// What tty.cpp asks of termios2, kept apart: its header (asm/termbits.h) clashes with <termios.h>, which
/// other system headers may bring along.
#pragma once

#include "dpslave/io/tty.hpp"

namespace dpslave::io {

/// From start bit to stop bit, at the rate asked for.
std::chrono::nanoseconds character_time(const TtySettings& settings);

/// The slave end of a pseudo terminal: it has no UART, and takes and forgets parity and character size.
bool is_pty(int fd);

/// Raw, at the rate and format asked for, everything old thrown away; then reads back what the driver made of
/// it. Empty = done, else a sentence without the path.
std::string apply(int fd, const TtySettings& settings, bool pty);

/// Drivers round or fall back without an error. The standard wants 0.3 %; that much and the rounding of the
/// number itself are allowed for, beyond 1 % no telegram comes through. Empty = good enough, else a sentence
/// without the path.
std::string judge_rate(std::uint32_t asked, std::uint32_t took);

bool flush_input(int fd); ///< false: errno says why
void flush_output(int fd);

} // namespace dpslave::io
