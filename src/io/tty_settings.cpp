// SPDX-License-Identifier: Apache-2.0
#include "tty_settings.hpp"

#include <asm/termbits.h>
#include <linux/major.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cerrno>

namespace dpslave::io {
namespace {

constexpr tcflag_t kFormat = CSIZE | PARENB | PARODD | CMSPAR | CSTOPB;

tcflag_t format_of(const TtySettings& settings)
{
    tcflag_t flags = settings.data_bits == 7 ? CS7 : CS8;
    if (settings.parity != 'N') flags |= PARENB;
    if (settings.parity == 'O') flags |= PARODD;
    if (settings.stop_bits == 2) flags |= CSTOPB;
    return flags;
}

/// "8E1"
std::string text(tcflag_t flags)
{
    const char* size = "5";
    switch (flags & CSIZE) {
        case CS6: size = "6"; break;
        case CS7: size = "7"; break;
        case CS8: size = "8"; break;
        default: break;
    }
    const char* parity = (flags & PARENB) == 0 ? "N" : (flags & PARODD) != 0 ? "O" : "E";
    return std::string{size} + parity + ((flags & CSTOPB) != 0 ? "2" : "1");
}

/// Drivers that gather octets (FTDI: 16 ms) hand them on at once. A wish: most drivers do not know it.
void ask_for_low_latency(int fd)
{
    serial_struct serial{};
    if (::ioctl(fd, TIOCGSERIAL, &serial) < 0) return;
    serial.flags |= static_cast<int>(ASYNC_LOW_LATENCY);
    static_cast<void>(::ioctl(fd, TIOCSSERIAL, &serial));
}

std::string last_error_text()
{
    return std::system_category().message(errno);
}

} // namespace

std::chrono::nanoseconds character_time(const TtySettings& settings)
{
    const int bits = 1 + settings.data_bits + (settings.parity == 'N' ? 0 : 1) + settings.stop_bits;
    return std::chrono::nanoseconds{bits * std::int64_t{1'000'000'000} / settings.baud};
}

bool is_pty(int fd)
{
    struct stat info {};
    if (::fstat(fd, &info) < 0) return false;
    const unsigned device = major(info.st_rdev);
    return device >= UNIX98_PTY_SLAVE_MAJOR && device < UNIX98_PTY_SLAVE_MAJOR + UNIX98_PTY_MAJOR_COUNT;
}

std::string judge_rate(std::uint32_t asked, std::uint32_t took)
{
    const std::uint32_t off = asked > took ? asked - took : took - asked;
    if (std::uint64_t{off} * 100 <= asked) return {};
    return "this UART cannot do " + std::to_string(asked) + " bit/s (it took " + std::to_string(took) +
           "): choose a rate that it can do, or another adapter";
}

bool flush_input(int fd)
{
    return ::ioctl(fd, TCFLSH, TCIFLUSH) == 0;
}

void flush_output(int fd)
{
    ::ioctl(fd, TCFLSH, TCOFLUSH);
}

std::string apply(int fd, const TtySettings& settings, bool pty)
{
    // Old output first: setting would wait until the driver had sent it, for ever if the other end holds it
    // up.
    static_cast<void>(::ioctl(fd, TCFLSH, TCIOFLUSH));

    termios2 wanted{};
    if (settings.parity != 'N') wanted.c_iflag |= INPCK;
    if (settings.mark_errors)
        wanted.c_iflag |= INPCK | PARMRK; // breaks are marked too: neither IGNBRK nor BRKINT
    wanted.c_cflag = BOTHER | CREAD | CLOCAL | format_of(settings);
    wanted.c_ispeed = wanted.c_ospeed = settings.baud;
    // Reading never waits (O_NONBLOCK); VMIN 1 only lets it tell "nothing there" (EAGAIN) from a hang-up (0).
    wanted.c_cc[VMIN] = 1;
    wanted.c_cc[VTIME] = 0;
    if (::ioctl(fd, TCSETS2, &wanted) < 0)
        return "the serial port refuses its settings (" + last_error_text() +
               "): check that there is a UART behind it";

    termios2 got{};
    if (::ioctl(fd, TCGETS2, &got) < 0)
        return "the serial port does not tell its settings (" + last_error_text() +
               "): check that there is a UART behind it";
    // c_ospeed counts: the CBAUD bits read back differ by driver.
    if (std::string trouble = judge_rate(settings.baud, got.c_ospeed); !trouble.empty()) return trouble;
    if (!pty && (got.c_cflag & kFormat) != (wanted.c_cflag & kFormat))
        return "this UART cannot do " + text(wanted.c_cflag) + " (it took " + text(got.c_cflag) +
               "): use another adapter";

    if (!pty) ask_for_low_latency(fd);
    static_cast<void>(flush_input(fd)); // what came while the old settings were in force is noise
    return {};
}

} // namespace dpslave::io
