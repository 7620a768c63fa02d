// SPDX-License-Identifier: Apache-2.0
#include "fake_uart.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <asm/termios.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <optional>

namespace dpslave::io {
namespace {

FakeUart* installed = nullptr;

int fail(int error)
{
    errno = error;
    return -1;
}

int order_rts(FakeUart& uart, const int* lines, bool asserted)
{
    if ((*lines & TIOCM_RTS) == 0) return 0;
    uart.edges.push_back(asserted);
    if (!uart.rts_is_stuck) uart.rts = asserted;
    return 0;
}

/// Nothing: not an ioctl of a UART.
std::optional<int> answer(FakeUart& uart, unsigned long request, void* argument)
{
    switch (request) {
        case TIOCMGET:
        case TIOCMBIS:
        case TIOCMBIC:
        case TIOCGRS485:
        case TIOCSRS485: break;
        default: return std::nullopt;
    }
    if (uart.gone) return fail(EIO);
    switch (request) {
        case TIOCMGET: *static_cast<int*>(argument) = uart.rts ? TIOCM_RTS : 0; return 0;
        case TIOCMBIS: return order_rts(uart, static_cast<const int*>(argument), true);
        case TIOCMBIC: return order_rts(uart, static_cast<const int*>(argument), false);
        case TIOCGRS485: *static_cast<serial_rs485*>(argument) = uart.rs485; return 0;
        default: break;
    }
    if (!uart.takes_rs485) return fail(ENOTTY);
    uart.rs485 = *static_cast<const serial_rs485*>(argument);
    uart.rs485.flags &= uart.supported;
    return 0;
}

} // namespace

FakeUart::FakeUart()
{
    installed = this;
}

FakeUart::~FakeUart()
{
    installed = nullptr;
}

} // namespace dpslave::io

/// In front of the C library's.
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept
{
    std::va_list rest;
    va_start(rest, request);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    using namespace dpslave::io;
    if (installed != nullptr)
        if (const auto said = answer(*installed, request, argument)) return *said;
    return static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
}
