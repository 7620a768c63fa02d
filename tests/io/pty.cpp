// SPDX-License-Identifier: Apache-2.0
#include "pty.hpp"

#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace dpslave::io {

std::uint32_t Pty::rate() const
{
    termios2 settings{};
    if (::ioctl(fd(), TCGETS2, &settings) < 0)
        throw std::system_error{errno, std::system_category(), "TCGETS2"};
    return settings.c_ospeed;
}

} // namespace dpslave::io
