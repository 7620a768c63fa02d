// SPDX-License-Identifier: Apache-2.0
#include "driver_enable_port.hpp"

#include <asm/ioctls.h>
#include <asm/termbits.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>

namespace dpslave::io {
namespace {

constexpr __u32 kLevels = SER_RS485_RTS_ON_SEND | SER_RS485_RTS_AFTER_SEND;

} // namespace

std::string_view text(Direction direction) noexcept
{
    switch (direction) {
        case Direction::none: return "none";
        case Direction::gpio: return "gpio";
        case Direction::kernel: return "kernel";
        case Direction::rts: return "rts";
    }
    return "?";
}

serial_rs485 rs485_wanted(const DriverEnableSettings& settings)
{
    serial_rs485 wanted{}; // delays 0: their unit is the millisecond, longer than a master waits
    wanted.flags = SER_RS485_ENABLED;
    wanted.flags |= settings.active_low ? SER_RS485_RTS_AFTER_SEND : SER_RS485_RTS_ON_SEND;
    if (settings.receive_own) wanted.flags |= SER_RS485_RX_DURING_TX;
    return wanted;
}

std::string judge_rs485(const serial_rs485& wanted, const serial_rs485& took)
{
    if ((took.flags & SER_RS485_ENABLED) == 0) return "it does not switch at all";
    if ((took.flags & kLevels) != (wanted.flags & kLevels))
        return (wanted.flags & SER_RS485_RTS_ON_SEND) != 0
                   ? "it cannot assert RTS while sending, only the other way round (gpio_active_low = true)"
                   : "it cannot release RTS while sending, only the other way round (gpio_active_low = false)";
    return {};
}

std::string remarks_on_rs485(const serial_rs485& wanted, const serial_rs485& took)
{
    std::string remarks;
    const __u32 before = took.delay_rts_before_send, after = took.delay_rts_after_send;
    if (before != 0 || after != 0)
        remarks +=
            "; the driver insists on delays of " + std::to_string(before) + " ms before and " +
            std::to_string(after) +
            " ms after sending, during which no other station is heard: look for a setting in the device tree (rs485-rts-delay)";
    const bool asked = (wanted.flags & SER_RS485_RX_DURING_TX) != 0;
    const bool hears = (took.flags & SER_RS485_RX_DURING_TX) != 0;
    if (hears && !asked)
        remarks += "; the receiver stays on while sending, although it should not: set echo = \"auto\"";
    if (asked && !hears)
        remarks += "; the receiver is off while sending, although the echo was asked for: set echo = \"off\"";
    return remarks;
}

int set_rs485(int fd, const serial_rs485& wanted, serial_rs485& took)
{
    serial_rs485 asked = wanted; // the driver writes into it
    if (::ioctl(fd, TIOCSRS485, &asked) < 0) return errno;
    return ::ioctl(fd, TIOCGRS485, &took) < 0 ? errno : 0;
}

bool can_rs485(int fd)
{
    serial_rs485 present{};
    return ::ioctl(fd, TIOCGRS485, &present) == 0 && ::ioctl(fd, TIOCSRS485, &present) == 0;
}

std::optional<std::string> end_rs485(int fd)
{
    serial_rs485 present{};
    if (::ioctl(fd, TIOCGRS485, &present) < 0 || (present.flags & SER_RS485_ENABLED) == 0)
        return std::nullopt;
    const int error = set_rs485(fd, serial_rs485{}, present);
    if (error == 0 && (present.flags & SER_RS485_ENABLED) == 0) return std::nullopt;
    return name_of_port(fd) + " stays in the RS-485 mode that another program or the device tree has set (" +
           std::system_category().message(error == 0 ? EBUSY : error) +
           "): switch that mode off there, or use direction = \"kernel\"";
}

int set_rts(int fd, bool asserted) noexcept
{
    const int line = TIOCM_RTS;
    return ::ioctl(fd, asserted ? TIOCMBIS : TIOCMBIC, &line) < 0 ? errno : 0;
}

std::optional<bool> rts(int fd)
{
    int lines = 0;
    if (::ioctl(fd, TIOCMGET, &lines) < 0) return std::nullopt;
    return (lines & TIOCM_RTS) != 0;
}

int drop_rts_on_close(int fd, bool drop)
{
    termios2 settings{};
    if (::ioctl(fd, TCGETS2, &settings) < 0) return errno;
    settings.c_cflag = drop ? settings.c_cflag | HUPCL : settings.c_cflag & ~static_cast<tcflag_t>(HUPCL);
    return ::ioctl(fd, TCSETS2, &settings) < 0 ? errno : 0;
}

std::string name_of_port(int fd)
{
    char name[256] = {};
    return ::ttyname_r(fd, name, sizeof name) == 0 ? name : "the port";
}

std::string other_ways(int fd, Direction but)
{
    std::string ways;
    if (but != Direction::kernel && can_rs485(fd)) ways += "direction = \"kernel\", ";
    if (but != Direction::rts && rts(fd)) ways += "direction = \"rts\", ";
    if (but != Direction::gpio) ways += "direction = \"gpio\" with a line of a GPIO chip, ";
    if (but != Direction::none) ways += "direction = \"none\" with a transceiver that switches by itself, ";
    ways.resize(ways.size() - 2);
    return ways;
}

std::string cannot(int fd, Direction direction, const std::string& why)
{
    return name_of_port(fd) + " cannot do direction = \"" + std::string{text(direction)} + "\" (" + why +
           "); it can do: " + other_ways(fd, direction);
}

std::string cannot_switch(const DriverEnableSettings& settings, const std::error_code& error)
{
    const std::string how = error.message();
    if (settings.direction != Direction::gpio)
        return "driver enable: RTS cannot be switched (" + how + "): choose another way, `direction`";
    return "driver enable: line " + std::to_string(settings.gpio_line) + " of GPIO chip " +
           settings.gpio_chip + " cannot be switched (" + how +
           "): look at the chip and its bus, or choose another line";
}

std::string microseconds(std::chrono::nanoseconds time)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.1f us",
                  std::chrono::duration<double, std::micro>{time}.count());
    return text.data();
}

} // namespace dpslave::io
