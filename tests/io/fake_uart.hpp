// SPDX-License-Identifier: Apache-2.0
/// Makes a UART of every pty of the test program: its ioctls for modem lines and RS-485 are answered here, as
/// a driver answers them. What it does not know goes to the kernel.
#pragma once

#include <linux/serial.h>

#include <cstdint>
#include <vector>

namespace dpslave::io {

class FakeUart {
public:
    FakeUart();
    ~FakeUart(); ///< ptys are ptys again
    FakeUart(const FakeUart&) = delete;
    FakeUart& operator=(const FakeUart&) = delete;

    bool rts = true;               ///< asserted, as the kernel does when it opens a port
    bool rts_is_stuck = false;     ///< takes every order and does nothing
    bool gone = false;             ///< a USB adapter that was pulled
    std::vector<bool> edges{};     ///< every order to RTS
    bool takes_rs485 = false;      ///< an 8250 answers the question but not the order
    std::uint32_t supported = ~0U; ///< flags of RS-485; others are cleared silently
    serial_rs485 rs485{};
};

} // namespace dpslave::io
