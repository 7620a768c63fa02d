// SPDX-License-Identifier: Apache-2.0
#include "stand_in_uart.hpp"

#include "dpslave/io/clock.hpp"

#include <asm/termbits.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdint>

namespace dpslave::test::uart {
namespace {

std::atomic<bool> active{false};
std::atomic<bool> refusing{false};
std::atomic<Shift> shift{Shift::unknown};
std::atomic<Instant> busy_until{kNever};
std::atomic<int> held_back{0};
std::atomic<Instant> held_until{kNever};
std::atomic<unsigned> flushed{0};
std::array<Edge, 16384> seen;
std::atomic<std::size_t> count{0};

int set_rts(bool to)
{
    if (refusing) {
        errno = EIO;
        return -1;
    }
    if (active == to) return 0; // edges come from one thread
    const std::size_t n = count.load();
    if (n == seen.size()) std::abort(); // a test that needs more room says so
    seen[n] = {.active = to, .at = io::monotonic_now()};
    count.store(n + 1);
    active = to; // last: who sees the line sees the edge too
    return 0;
}

int line_status(unsigned* into)
{
    if (shift == Shift::unknown) {
        errno = ENOTTY;
        return -1;
    }
    const bool is_empty = shift == Shift::empty || io::monotonic_now() >= busy_until.load();
    *into = is_empty ? unsigned{TIOCSER_TEMT} : 0U;
    return 0;
}

} // namespace

void reset()
{
    active = refusing = false;
    shift = Shift::unknown;
    held_back = 0;
    flushed = 0;
    count = 0;
}
void refuse_edges(bool refuse)
{
    refusing = refuse;
}
void shift_register(Shift says, Instant until)
{
    busy_until = until;
    shift = says;
}
void hold_back(int octets, Instant until)
{
    held_until = until;
    held_back = octets;
}
unsigned flushes()
{
    return flushed;
}
bool takes_output_queue(unsigned long request, void* argument)
{
    if (held_back == 0 || io::monotonic_now() >= held_until.load()) return false;
    if (request == TIOCOUTQ) {
        *static_cast<int*>(argument) = held_back;
        return true;
    }
    if (request != TCFLSH || reinterpret_cast<std::uintptr_t>(argument) != TCOFLUSH) return false;
    held_back = 0;
    ++flushed;
    return true;
}
bool is_active()
{
    return active;
}
std::vector<Edge> edges()
{
    return {seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count.load())};
}

} // namespace dpslave::test::uart

// NOLINTNEXTLINE: this is the C library's name
extern "C" int ioctl(int fd, unsigned long request, ...) noexcept
{
    using namespace dpslave::test;
    va_list rest;
    va_start(rest, request);
    void* const argument = va_arg(rest, void*);
    va_end(rest);
    if (uart::takes_output_queue(request, argument)) return 0;
    switch (request) {
        case TIOCMGET: *static_cast<int*>(argument) = uart::is_active() ? TIOCM_RTS : 0; return 0;
        case TIOCMBIS:
        case TIOCMBIC:
            if ((*static_cast<const int*>(argument) & TIOCM_RTS) == 0) return 0;
            return uart::set_rts(request == TIOCMBIS);
        case TIOCSERGETLSR: return uart::line_status(static_cast<unsigned*>(argument));
        default: return static_cast<int>(::syscall(SYS_ioctl, fd, request, argument));
    }
}
