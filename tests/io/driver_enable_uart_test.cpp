// SPDX-License-Identifier: Apache-2.0
/// Direction "kernel" and "rts" on a UART: what is asked of its driver, and that what it made of it is read
/// back.
#include "fake_uart.hpp"
#include "pty.hpp"

#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/tty.hpp"

#include <asm/termbits.h>
#include <gmock/gmock.h>
#include <sys/ioctl.h>

#include <stdexcept>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr Instant kNow{100s};

class OnAUart : public testing::Test {
protected:
    DriverEnable opened(Direction direction, bool active_low = false)
    {
        auto made = DriverEnable::open({.direction = direction, .active_low = active_low});
        if (!made) throw std::runtime_error{made.error()};
        return std::move(*made);
    }
    static bool lets_rts_go_on_close(int fd)
    {
        termios2 settings{};
        EXPECT_EQ(::ioctl(fd, TCGETS2, &settings), 0);
        return (settings.c_cflag & HUPCL) != 0;
    }
    bool lets_rts_go_on_close() const { return lets_rts_go_on_close(tty->fd()); }

    Pty cable;
    Result<Tty, std::string> tty = Tty::open(cable.path(), {.baud = 9600});
    FakeUart uart;
};

TEST_F(OnAUart, RtsIsAssertedWhileSendingAndAtNoOtherTime)
{
    {
        DriverEnable driver = opened(Direction::rts);
        EXPECT_FALSE(driver.attach(*tty));
        EXPECT_FALSE(uart.rts) << "although the kernel asserted it when the port was opened";
        EXPECT_TRUE(driver.by_hand());

        EXPECT_FALSE(driver.set(true, kNow));
        EXPECT_TRUE(uart.rts);
        EXPECT_FALSE(driver.set(false, kNow));
        EXPECT_FALSE(uart.rts);
        EXPECT_THAT(uart.edges, ElementsAre(false, true, false));
        EXPECT_FALSE(driver.set(true, kNow));
    }
    EXPECT_FALSE(uart.rts) << "at the end";
}

TEST_F(OnAUart, RtsOfACrashedProgramIsLetGoByTheKernelAsItClosesThePort)
{
    DriverEnable driver = opened(Direction::rts);
    EXPECT_FALSE(driver.attach(*tty));

    EXPECT_TRUE(lets_rts_go_on_close());
}

TEST_F(OnAUart, RtsThatIsLowWhileSendingIsKeptByTheKernelAsItClosesThePort)
{
    uart.rts = false;
    DriverEnable driver = opened(Direction::rts, true);
    EXPECT_FALSE(driver.attach(*tty));

    EXPECT_TRUE(uart.rts);
    EXPECT_FALSE(lets_rts_go_on_close());
    EXPECT_FALSE(driver.set(true, kNow));
    EXPECT_FALSE(uart.rts);
}

TEST_F(OnAUart, RtsOfALivingProgramIsNotReleased)
{
    uart.rts = false;

    const auto trouble =
        DriverEnable::release({.direction = Direction::rts, .active_low = true}, cable.path());

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, AllOf(HasSubstr(cable.path()), HasSubstr("fuser")));
    EXPECT_FALSE(uart.rts);
}

TEST_F(OnAUart, RtsThatIsLowWhileSendingIsReleasedAfterACrash)
{
    uart.rts = false;
    const Fd other{
        ::open(cable.path().c_str(), O_RDWR | O_NOCTTY)}; // a pty forgets its settings with its last user
    tty = Failure{std::string{"crashed"}};

    EXPECT_FALSE(DriverEnable::release({.direction = Direction::rts, .active_low = true}, cable.path()));

    EXPECT_TRUE(uart.rts);
    EXPECT_FALSE(lets_rts_go_on_close(other.get())) << "or closing it would undo it";
}

TEST_F(OnAUart, RtsThatDoesNotFollowIsRefused)
{
    uart.rts_is_stuck = true;
    DriverEnable driver = opened(Direction::rts);

    const auto trouble = driver.attach(*tty);

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble,
                AllOf(HasSubstr("RTS does not follow"), HasSubstr("it can do: direction = \"gpio\"")));
}

TEST_F(OnAUart, RtsGoesWithItsPortAndComesBackWithIt)
{
    DriverEnable driver = opened(Direction::rts);
    EXPECT_FALSE(driver.attach(*tty));
    EXPECT_FALSE(driver.set(true, kNow));
    uart.gone = true;

    driver.detach();

    EXPECT_FALSE(driver.works());
    EXPECT_FALSE(driver.active_since());
    EXPECT_TRUE(driver.set(true, kNow + 1ms));
    uart.gone = false;
    EXPECT_FALSE(driver.attach(*tty));
    EXPECT_TRUE(driver.works());
    EXPECT_FALSE(driver.set(true, kNow + 2ms));
    EXPECT_TRUE(uart.rts);
}

TEST_F(OnAUart, TheGuardDropsRtsToo)
{
    DriverEnable driver = opened(Direction::rts);
    EXPECT_FALSE(driver.attach(*tty));
    EXPECT_FALSE(driver.set(true, kNow));

    EXPECT_TRUE(driver.drop_if_stuck(kNow + 2ms, 1ms));
    EXPECT_FALSE(uart.rts);
}

TEST_F(OnAUart, RtsThatAnotherProgramHasRaisedByOpeningThePortIsReleasedAndNeverThatOfAReply)
{
    DriverEnable driver = opened(Direction::rts);
    EXPECT_FALSE(driver.attach(*tty));
    EXPECT_FALSE(driver.release_if_raised());

    uart.rts = true;
    EXPECT_TRUE(driver.release_if_raised());
    EXPECT_FALSE(uart.rts);
    EXPECT_FALSE(driver.release_if_raised());

    EXPECT_FALSE(driver.set(true, kNow));
    EXPECT_FALSE(driver.release_if_raised());
    EXPECT_TRUE(uart.rts);
    EXPECT_FALSE(driver.set(false, kNow));
}

TEST_F(OnAUart, TheSelfCheckOfRtsReportsWhatItDisturbsAndWhatWouldBeBetter)
{
    uart.takes_rs485 = true;
    DriverEnable driver = opened(Direction::rts);
    EXPECT_FALSE(driver.attach(*tty));

    ASSERT_EQ(driver.self_check(), std::nullopt);
    EXPECT_THAT(driver.in_words(),
                AllOf(HasSubstr("RTS, asserted while sending"), HasSubstr("an edge takes at least"),
                      HasSubstr("disturbs"), HasSubstr("direction = \"kernel\"")));
    EXPECT_THAT(uart.edges, Not(testing::Contains(true)));
}

TEST_F(OnAUart, TheDriverOfTheUartSwitchesWithRtsOnSendAndNoDelays)
{
    uart.takes_rs485 = true;
    DriverEnable driver = opened(Direction::kernel);

    EXPECT_FALSE(driver.attach(*tty));

    EXPECT_EQ(uart.rs485.flags, SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND);
    EXPECT_EQ(uart.rs485.delay_rts_before_send, 0);
    EXPECT_EQ(uart.rs485.delay_rts_after_send, 0);
    EXPECT_FALSE(driver.by_hand());
    EXPECT_FALSE(driver.set(true, kNow));
    EXPECT_THAT(uart.edges, ElementsAre()) << "only the kernel switches RTS";
    ASSERT_EQ(driver.self_check(), std::nullopt);
    EXPECT_THAT(driver.in_words(),
                AllOf(HasSubstr("TIOCSRS485, read back"), HasSubstr("asserted while sending")));
}

TEST_F(OnAUart, AnotherProgramThatChangesTheModeIsNamedAndTheModeIsSetAgain)
{
    uart.takes_rs485 = true;
    for (const auto direction : {Direction::kernel, Direction::none}) {
        DriverEnable driver = opened(direction);
        ASSERT_FALSE(driver.attach(*tty));
        EXPECT_FALSE(tty->changed_settings()) << "what the driver enable has set is wanted";
        const auto wanted = uart.rs485.flags;

        uart.rs485.flags ^= SER_RS485_ENABLED;
        const auto changed = tty->changed_settings();
        ASSERT_TRUE(changed);
        EXPECT_TRUE(changed->harms_octets);
        EXPECT_STREQ(changed->words.data(), direction == Direction::kernel
                                                ? "the RS-485 mode of the UART is off"
                                                : "the RS-485 mode of the UART is on");
        EXPECT_FALSE(tty->set_again(*changed));
        EXPECT_EQ(uart.rs485.flags, wanted);
        EXPECT_FALSE(tty->changed_settings());
        driver.detach();
    }
}

TEST_F(OnAUart, AnotherDelayOfTheModeIsAChangeToo)
{
    uart.takes_rs485 = true;
    DriverEnable driver = opened(Direction::kernel);
    ASSERT_FALSE(driver.attach(*tty));
    uart.rs485.delay_rts_after_send = 5;
    ASSERT_TRUE(tty->changed_settings());
    EXPECT_STREQ(tty->changed_settings()->words.data(), "the RS-485 mode of the UART is another one");
}

TEST_F(OnAUart, TheDriverOfTheUartGoesOnSwitchingWhenWeHaveEnded)
{
    uart.takes_rs485 = true;
    {
        DriverEnable driver = opened(Direction::kernel, true);
        EXPECT_FALSE(driver.attach(*tty));
        driver.detach();
    }
    EXPECT_EQ(uart.rs485.flags, SER_RS485_ENABLED | SER_RS485_RTS_AFTER_SEND);
}

TEST_F(OnAUart, AnEightTwoFiveZeroAnswersTheQuestionButIsRefusedAndRtsIsNamed)
{
    DriverEnable driver = opened(Direction::kernel);

    const auto trouble = driver.attach(*tty);

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, AllOf(HasSubstr("direction = \"kernel\""), HasSubstr("does not switch: TIOCSRS485"),
                                HasSubstr("it can do: direction = \"rts\", direction = \"gpio\"")));
}

TEST_F(OnAUart, ADriverThatClearsWhatItCannotDoIsFoundOutByReadingBack)
{
    uart.takes_rs485 = true;
    uart.supported = SER_RS485_RTS_ON_SEND | SER_RS485_RTS_AFTER_SEND;
    DriverEnable driver = opened(Direction::kernel);

    const auto trouble = driver.attach(*tty);

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, HasSubstr("read back after TIOCSRS485, it does not switch at all"));
}

TEST_F(OnAUart, ToFindOutWhetherTheDriverCouldSwitchChangesNothing)
{
    uart.takes_rs485 = true;
    uart.rs485.flags = SER_RS485_RTS_AFTER_SEND;
    DriverEnable driver = opened(Direction::none);
    EXPECT_FALSE(driver.attach(*tty));

    ASSERT_EQ(driver.self_check(), std::nullopt);
    EXPECT_THAT(driver.in_words(), HasSubstr("could also do: direction = \"kernel\", direction = \"rts\""));

    EXPECT_EQ(uart.rs485.flags, SER_RS485_RTS_AFTER_SEND);
    EXPECT_THAT(uart.edges, ElementsAre());
}

TEST_F(OnAUart, TheModeThatAnotherProgramLeftIsEndedUnlessTheKernelIsToSwitch)
{
    uart.takes_rs485 = true;
    for (const Direction direction : {Direction::none, Direction::rts}) {
        uart.rs485.flags = SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND;
        DriverEnable driver = opened(direction);

        EXPECT_EQ(driver.attach(*tty), std::nullopt);

        EXPECT_EQ(uart.rs485.flags & SER_RS485_ENABLED, 0U) << text(direction);
    }
    uart.rs485.flags = SER_RS485_ENABLED | SER_RS485_RTS_AFTER_SEND;
    DriverEnable driver = opened(Direction::kernel);
    EXPECT_EQ(driver.attach(*tty), std::nullopt);
    EXPECT_EQ(uart.rs485.flags, SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND) << "set anew";
}

TEST_F(OnAUart, AModeThatTheDriverKeepsIsSaid)
{
    uart.rs485.flags = SER_RS485_ENABLED; // and it takes no order
    DriverEnable driver = opened(Direction::none);

    const auto trouble = driver.attach(*tty);

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, AllOf(HasSubstr("stays in the RS-485 mode"), HasSubstr("direction = \"kernel\"")));
}

} // namespace
} // namespace dpslave::io
