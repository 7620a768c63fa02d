// SPDX-License-Identifier: Apache-2.0
// Tests what a port was set to before a command used it.
#include "pty.hpp"

#include "dpslave/io/port_settings.hpp"
#include "dpslave/io/tty.hpp"

#include <gtest/gtest.h>
#include <sys/file.h>
#include <termios.h>

namespace dpslave::io {
namespace {

termios settings_of(const Fd& port)
{
    termios now{};
    EXPECT_EQ(::tcgetattr(port.get(), &now), 0);
    return now;
}

TEST(PortSettings, ArePutBackAtTheEnd)
{
    const Pty cable;
    const Fd port{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    termios before = settings_of(port);
    before.c_lflag |= ICANON | ECHO;
    before.c_cc[VMIN] = 7;
    ASSERT_EQ(::cfsetspeed(&before, B57600), 0);
    ASSERT_EQ(::tcsetattr(port.get(), TCSANOW, &before), 0);
    {
        const auto saved = PortSettings::save(cable.path());
        ASSERT_TRUE(saved);
        const auto tty = Tty::open(cable.path(), {.baud = 9'600});
        ASSERT_TRUE(tty);
        EXPECT_EQ(settings_of(port).c_lflag & ICANON, 0U);
    }

    const termios after = settings_of(port);
    EXPECT_EQ(after.c_iflag, before.c_iflag);
    EXPECT_EQ(after.c_oflag, before.c_oflag);
    EXPECT_EQ(after.c_cflag, before.c_cflag);
    EXPECT_EQ(after.c_lflag, before.c_lflag);
    EXPECT_EQ(after.c_cc[VMIN], 7);
    EXPECT_EQ(::cfgetospeed(&after), static_cast<speed_t>(B57600));
}

TEST(PortSettings, OfAPortThatAnotherProgramHasAreLeftAlone)
{
    const Pty cable;
    const Fd port{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    ASSERT_EQ(::flock(port.get(), LOCK_EX | LOCK_NB), 0);

    EXPECT_EQ(PortSettings::save(cable.path()).error(), std::errc::device_or_resource_busy);
}

TEST(PortSettings, OfWhatIsNoPortAreAnError)
{
    EXPECT_EQ(PortSettings::save("/nonexistent/tty").error(), std::errc::no_such_file_or_directory);
    EXPECT_EQ(PortSettings::save("/dev/null").error(), std::errc::inappropriate_io_control_operation);
}

} // namespace
} // namespace dpslave::io
