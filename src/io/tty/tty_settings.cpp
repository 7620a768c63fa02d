// SPDX-License-Identifier: Apache-2.0
#include "tty_settings.hpp"

#include "dpslave/io/uart_kind.hpp"

#include <asm/termbits.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

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

/// Drivers that gather octets (FTDI: 16 ms) hand them on at once. A failure is ignored: most drivers do not
/// know it.
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

std::string not_readable()
{
    return "the settings of the serial port cannot be read (" + last_error_text() +
           "): check that there is a UART behind it";
}

/// Reads back the rate that the driver has set. c_ospeed counts: the CBAUD bits read back differ by driver.
std::string read_back(int fd, std::uint32_t asked, Uart& uart, termios2& got)
{
    if (::ioctl(fd, TCGETS2, &got) < 0) return not_readable();
    refresh(uart, fd);
    return judge_rate(uart, asked, got.c_ospeed);
}

} // namespace

std::chrono::nanoseconds character_time(const TtySettings& settings)
{
    const int bits = 1 + settings.data_bits + (settings.parity == 'N' ? 0 : 1) + settings.stop_bits;
    return std::chrono::nanoseconds{bits * std::int64_t{1'000'000'000} / settings.baud};
}

bool flush_input(int fd)
{
    return ::ioctl(fd, TCFLSH, TCIFLUSH) == 0;
}

void flush_output(int fd)
{
    ::ioctl(fd, TCFLSH, TCOFLUSH);
}

bool has_unsent(int fd)
{
    int octets = 0;
    return ::ioctl(fd, TIOCOUTQ, &octets) == 0 && octets > 0;
}

std::optional<bool> transmitter_empty(int fd)
{
    unsigned status = 0;
    if (::ioctl(fd, TIOCSERGETLSR, &status) < 0) return std::nullopt;
    return (status & TIOCSER_TEMT) != 0;
}

std::string apply(int fd, const TtySettings& settings, Uart& uart)
{
    // Old output first: setting would wait until the driver had sent it, for ever if the other end holds it
    // up.
    static_cast<void>(::ioctl(fd, TCFLSH, TCIOFLUSH));

    termios2 wanted{};
    if (settings.parity != 'N') wanted.c_iflag |= INPCK;
    if (settings.mark_errors)
        wanted.c_iflag |= INPCK | PARMRK; // breaks are marked too: neither IGNBRK nor BRKINT
    wanted.c_cflag = BOTHER | CREAD | CLOCAL | format_of(settings);
    if (settings.drop_rts_at_close) wanted.c_cflag |= HUPCL;
    wanted.c_ispeed = wanted.c_ospeed = settings.baud;
    wanted.c_cc[VMIN] = 0; // with VTIME 0: read() returns at once, whatever the flags of the descriptor say
    wanted.c_cc[VTIME] = 0;
    if (::ioctl(fd, TCSETS2, &wanted) < 0)
        return "the serial port refuses its settings (" + last_error_text() +
               "): check that there is a UART behind it";

    termios2 got{};
    if (std::string trouble = read_back(fd, settings.baud, uart, got); !trouble.empty()) return trouble;
    if (!uart.pty && (got.c_cflag & kFormat) != (wanted.c_cflag & kFormat))
        return "this UART cannot do " + text(wanted.c_cflag) + " (it took " + text(got.c_cflag) +
               "): use another adapter";
    if (settings.parity != 'N' && uart_kind(uart.driver) == UartKind::mini)
        return "this UART has no parity (the mini UART of a Raspberry Pi): use its other UART, as ttyAMA0";

    if (!uart.pty) ask_for_low_latency(fd);
    static_cast<void>(flush_input(fd)); // what came while the old settings were in force is noise
    return {};
}

std::string change_rate(int fd, std::uint32_t baud, Uart& uart)
{
    flush_output(fd); // else the change waits until it has gone
    termios2 wanted{};
    if (::ioctl(fd, TCGETS2, &wanted) < 0) return not_readable();
    wanted.c_cflag &= ~tcflag_t{CBAUD | (CBAUD << IBSHIFT)};
    wanted.c_cflag |= BOTHER;
    wanted.c_ispeed = wanted.c_ospeed = baud;
    if (::ioctl(fd, TCSETSF2, &wanted) < 0)
        return "the serial port refuses " + std::to_string(baud) + " bit/s (" + last_error_text() +
               "): check that it is still there";
    return read_back(fd, baud, uart, wanted);
}

} // namespace dpslave::io
