// SPDX-License-Identifier: Apache-2.0
/// Who switches the transceiver, and that it is never left switched on.
#include "gpio_folder.hpp"
#include "io/gpio/driver_enable_port.hpp"
#include "pty.hpp"

#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/tty.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <optional>
#include <thread>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr Instant kNow{100s};
constexpr unsigned kLine = 5;

class ByGpio : public GpioFolder {
protected:
    DriverEnableSettings settings(bool active_low = false)
    {
        return {.direction = Direction::gpio,
                .gpio_chip = chip.path(),
                .gpio_line = kLine,
                .active_low = active_low};
    }
    DriverEnable opened(bool active_low = false)
    {
        auto made = DriverEnable::open(settings(active_low));
        if (!made) throw std::runtime_error{made.error()};
        return std::move(*made);
    }
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
};

TEST_F(ByGpio, TheLineIsHighWhileSendingAndAtNoOtherTime)
{
    chip.leave(kLine, true);
    {
        DriverEnable driver = opened();
        EXPECT_TRUE(driver.by_hand());
        EXPECT_FALSE(chip.high(kLine)) << "at start";
        EXPECT_FALSE(driver.active_since());
        EXPECT_FALSE(driver.set(true, kNow));
        EXPECT_TRUE(chip.high(kLine));
        EXPECT_EQ(driver.active_since(), kNow);
        EXPECT_FALSE(driver.set(false, kNow + 1ms));
        EXPECT_FALSE(chip.high(kLine));
        EXPECT_FALSE(driver.active_since());
        EXPECT_FALSE(driver.set(true, kNow + 2ms));
    }
    EXPECT_FALSE(chip.high(kLine)) << "at the end";
    EXPECT_FALSE(chip.is_taken(kLine));
}

TEST_F(ByGpio, ActiveLowIsTheOtherWayRound)
{
    chip.leave(kLine, true);
    {
        DriverEnable driver = opened(true);
        EXPECT_TRUE(chip.high(kLine));
        EXPECT_EQ(chip.falls(kLine), 0);
        EXPECT_FALSE(driver.set(true, kNow));
        EXPECT_FALSE(chip.high(kLine));
    }
    EXPECT_TRUE(chip.high(kLine));
}

TEST_F(ByGpio, EachEdgeIsOneOrderToTheChip)
{
    DriverEnable driver = opened();
    const unsigned before = chip.edges(kLine);

    for (int reply = 0; reply < 10; ++reply) {
        EXPECT_FALSE(driver.set(true, kNow));
        EXPECT_FALSE(driver.set(false, kNow));
    }

    EXPECT_EQ(chip.edges(kLine) - before, 20);
    EXPECT_EQ(chip.requests(kLine), 1);
}

TEST_F(ByGpio, ThePortThatGoesTakesTheLineDown)
{
    const Pty cable;
    const auto tty = Tty::open(cable.path(), {.baud = 9600});
    ASSERT_TRUE(tty) << tty.error();
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.attach(*tty));
    EXPECT_FALSE(driver.set(true, kNow));

    driver.detach();

    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(driver.active_since());
    EXPECT_TRUE(driver.works());
}

TEST_F(ByGpio, WithoutChipThereIsASentenceAtOnce)
{
    chip.remove();

    const auto driver = DriverEnable::open(settings());

    ASSERT_FALSE(driver);
    EXPECT_THAT(driver.error(), AllOf(StartsWith("driver enable: "), HasSubstr("is not there")));
}

TEST_F(ByGpio, NothingIsSentFromTheMomentTheChipIsPulledUntilItIsBack)
{
    DriverEnable driver = opened();
    chip.remove();

    EXPECT_EQ(driver.set(true, kNow), std::errc::no_such_device);
    EXPECT_FALSE(driver.works());
    EXPECT_TRUE(driver.set(true, kNow)) << "and it stays so";
    EXPECT_FALSE(driver.ready(kNow));

    chip.come_back();
    EXPECT_FALSE(driver.ready(kNow + 499ms)) << "not before its time";
    EXPECT_TRUE(driver.set(true, kNow + 499ms));
    EXPECT_EQ(driver.next_try(), kNow + 500ms);
    EXPECT_TRUE(driver.ready(kNow + 500ms));
    EXPECT_TRUE(driver.works());
    EXPECT_EQ(driver.next_try(), kNever);
    EXPECT_FALSE(driver.set(true, kNow + 501ms));
    EXPECT_TRUE(chip.high(kLine));
}

TEST_F(ByGpio, AChipPulledWhileSendingIsNotedByTheEdgeThatFailsAndTheLineIsLowWhenItIsBack)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.set(true, kNow));
    chip.remove();

    EXPECT_EQ(driver.set(false, kNow + 1ms), std::errc::no_such_device);
    EXPECT_FALSE(driver.works());
    EXPECT_TRUE(driver.active_since()) << "the level is not known";

    chip.come_back();
    chip.leave(kLine, true);
    EXPECT_TRUE(driver.ready(kNow + 2ms)) << "the first try is at once";
    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(driver.active_since());
}

TEST_F(ByGpio, IsTriedAgainAfterHalfASecondThenOneTwoFourAndFour)
{
    DriverEnable driver = opened();
    chip.remove();
    EXPECT_TRUE(driver.set(true, kNow));

    Instant at = kNow;
    for (const auto wait : {500ms, 1000ms, 2000ms, 4000ms, 4000ms}) {
        EXPECT_EQ(driver.next_try(), at);
        EXPECT_FALSE(driver.ready(at));
        at += wait;
    }
    chip.come_back();
    EXPECT_FALSE(driver.ready(at - 1ns));
    EXPECT_TRUE(driver.ready(at));
}

TEST_F(ByGpio, TheGuardDropsALineThatHasBeenActiveForLongerThanTheLimit)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.drop_if_stuck(kNow, 10ms)) << "it is not active";
    EXPECT_FALSE(driver.set(true, kNow));

    EXPECT_FALSE(driver.drop_if_stuck(kNow + 10ms, 10ms));
    EXPECT_TRUE(chip.high(kLine));
    EXPECT_TRUE(driver.drop_if_stuck(kNow + 11ms, 10ms));
    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(driver.active_since());
    EXPECT_FALSE(driver.drop_if_stuck(kNow + 20ms, 10ms)) << "once";
    EXPECT_FALSE(driver.set(false, kNow + 21ms)) << "the thread that was late may say it again";
    EXPECT_FALSE(driver.set(true, kNow + 22ms));
    EXPECT_TRUE(chip.high(kLine));
}

TEST_F(ByGpio, TheLimitBeginsAnewWithEachReply)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.set(true, kNow));
    EXPECT_FALSE(driver.set(true, kNow + 8ms)) << "a second reply before the first one was over";

    EXPECT_FALSE(driver.drop_if_stuck(kNow + 15ms, 10ms));
    EXPECT_EQ(driver.active_since(), kNow + 8ms);
}

TEST_F(ByGpio, TheGuardThatMeetsAChipThatIsGoneTriesOnAndClaimsNothing)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.set(true, kNow));
    chip.remove();

    EXPECT_FALSE(driver.drop_if_stuck(kNow + 11ms, 10ms));
    EXPECT_EQ(driver.active_since(), kNow);
}

TEST_F(ByGpio, TheGuardOfAnotherThreadNeverLeavesTheLineHigh)
{
    DriverEnable driver = opened();
    std::atomic<bool> stop{false};
    std::thread guard{[&] {
        while (!stop) driver.drop_if_stuck(kNow + 1s, 1ns); // finds every reply stuck
    }};
    unsigned refused = 0;
    for (int reply = 0; reply < 20'000; ++reply) {
        const auto error = driver.set(true, kNow);
        if (error) {
            EXPECT_EQ(error, std::errc::resource_unavailable_try_again);
            EXPECT_TRUE(driver.works());
            ++refused;
        }
        EXPECT_FALSE(driver.set(false, kNow));
        EXPECT_FALSE(chip.high(kLine));
    }
    stop = true;
    guard.join();

    EXPECT_FALSE(driver.set(false, kNow));
    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(driver.active_since());
    EXPECT_GT(chip.rises(kLine), 0);
    RecordProperty("refused", static_cast<int>(refused));
}

TEST_F(ByGpio, TheSelfCheckMeasuresAnEdgeWithoutTouchingTheBus)
{
    DriverEnable driver = opened();

    ASSERT_EQ(driver.self_check(), std::nullopt);
    const std::string found = driver.in_words();

    EXPECT_THAT(found, AllOf(HasSubstr("line 5"), HasSubstr(chip.path().string()),
                             HasSubstr("high while sending"), HasSubstr("an edge takes")));
    EXPECT_GT(driver.edge_time(), 0ns);
    EXPECT_GT(chip.edges(kLine), 3);
    EXPECT_EQ(chip.rises(kLine), 0);
}

TEST_F(ByGpio, TheSelfCheckOfALineThatCannotBeSwitchedFails)
{
    DriverEnable driver = opened();
    chip.remove();

    const auto trouble = driver.self_check();

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, AllOf(HasSubstr("line 5"), HasSubstr(chip.path().string()),
                                HasSubstr("cannot be switched"), HasSubstr("another line")));
}

TEST_F(ByGpio, AnEdgeOfMoreThanTwoBitTimesIsDoubted)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.doubt(Baud::k1500)) << "not measured, nothing to say";
    ASSERT_EQ(driver.self_check(), std::nullopt);
    const auto edge = driver.edge_time();

    for (const Baud baud : kBauds) {
        const auto doubt = driver.doubt(baud);
        EXPECT_EQ(doubt.has_value(), edge > duration_of(2_tbit, baud)) << text(baud);
        if (doubt) {
            EXPECT_THAT(*doubt, AllOf(HasSubstr("bit times"), HasSubstr("kernel")));
        }
    }
}

TEST_F(ByGpio, ReleaseDropsWhatADeadProgramLeftAndLetsGoOfIt)
{
    chip.leave(kLine, true);

    EXPECT_FALSE(DriverEnable::release(settings(), "/dev/null"));

    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(chip.is_taken(kLine));
}

TEST_F(ByGpio, ReleaseLeavesTheLineOfALivingProgramAlone)
{
    DriverEnable driver = opened();
    EXPECT_FALSE(driver.set(true, kNow));

    const auto trouble = DriverEnable::release(settings(), "/dev/null");

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, HasSubstr("in use by \"dpslaved driver enable\""));
    EXPECT_TRUE(chip.high(kLine));
}

/// A pty has no UART: none of what belongs to one.
class OnAPty : public testing::Test {
protected:
    std::optional<std::string> attach(Direction direction)
    {
        auto driver = DriverEnable::open({.direction = direction});
        EXPECT_TRUE(driver);
        return driver->attach(*tty);
    }
    Pty cable;
    Result<Tty, std::string> tty = Tty::open(cable.path(), {.baud = 9600});
};

TEST_F(OnAPty, KernelAndRtsAreRefusedWithWhatThePortCanDo)
{
    for (const Direction direction : {Direction::kernel, Direction::rts}) {
        const auto trouble = attach(direction);
        ASSERT_TRUE(trouble);
        EXPECT_THAT(
            *trouble,
            AllOf(HasSubstr(cable.path() + " cannot do direction = \"" + std::string{text(direction)}),
                  HasSubstr("can do: direction = \"gpio\""), HasSubstr("\"none\""),
                  Not(HasSubstr("can do: direction = \"rts")), Not(HasSubstr("can do: direction = \"kern"))));
    }
    EXPECT_THAT(*attach(Direction::kernel), HasSubstr("TIOCSRS485"));
    EXPECT_THAT(*attach(Direction::rts), HasSubstr("no RTS"));
}

TEST_F(OnAPty, NoneIsFineAndSwitchesNothing)
{
    auto driver = DriverEnable::open({.direction = Direction::none});
    ASSERT_TRUE(driver);

    EXPECT_FALSE(driver->attach(*tty));
    EXPECT_FALSE(driver->by_hand());
    EXPECT_FALSE(driver->set(true, kNow));
    EXPECT_FALSE(driver->active_since());
    EXPECT_TRUE(driver->ready(kNow));
    ASSERT_EQ(driver->self_check(), std::nullopt);
    EXPECT_THAT(driver->in_words(), HasSubstr("switches by itself"));
    EXPECT_FALSE(driver->doubt(Baud::k1500));
}

TEST_F(OnAPty, RtsWithoutAPortIsAnErrorOfTheEdge)
{
    auto driver = DriverEnable::open({.direction = Direction::rts});
    ASSERT_TRUE(driver);

    EXPECT_TRUE(driver->by_hand());
    EXPECT_EQ(driver->set(true, kNow), std::errc::no_such_device);
    EXPECT_FALSE(driver->ready(kNow));
}

TEST(Release, OfADriverEnableThatNeedsNoReleaseTouchesNothing)
{
    for (const Direction direction : {Direction::none, Direction::kernel, Direction::rts})
        EXPECT_FALSE(DriverEnable::release({.direction = direction}, "/dev/not-there"));
}

TEST(Release, OfAnRtsThatIsLowWhileSendingNeedsThePort)
{
    const auto trouble =
        DriverEnable::release({.direction = Direction::rts, .active_low = true}, "/dev/not-there");

    ASSERT_TRUE(trouble);
    EXPECT_THAT(*trouble, AllOf(HasSubstr("/dev/not-there"), HasSubstr("`port`")));
}

TEST(Rs485, IsAskedForWithRtsWhileSendingAndWithoutDelays)
{
    const serial_rs485 wanted = rs485_wanted({.direction = Direction::kernel});

    EXPECT_EQ(wanted.flags, SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND);
    EXPECT_EQ(wanted.delay_rts_before_send, 0);
    EXPECT_EQ(wanted.delay_rts_after_send, 0);
    EXPECT_EQ(rs485_wanted({.active_low = true}).flags, SER_RS485_ENABLED | SER_RS485_RTS_AFTER_SEND);
    EXPECT_EQ(rs485_wanted({.receive_own = true}).flags,
              SER_RS485_ENABLED | SER_RS485_RTS_ON_SEND | SER_RS485_RX_DURING_TX);
}

TEST(Rs485, ThatWasTakenAsAskedIsFine)
{
    const serial_rs485 wanted = rs485_wanted({});

    EXPECT_THAT(judge_rs485(wanted, wanted), IsEmpty());
    EXPECT_THAT(remarks_on_rs485(wanted, wanted), IsEmpty());
}

TEST(Rs485, ThatReadsBackAsOffOrTheOtherWayRoundIsRefused)
{
    const serial_rs485 wanted = rs485_wanted({});

    EXPECT_THAT(judge_rs485(wanted, {}), HasSubstr("does not switch"));
    EXPECT_THAT(judge_rs485(wanted, rs485_wanted({.active_low = true})), HasSubstr("gpio_active_low = true"));
    EXPECT_THAT(judge_rs485(rs485_wanted({.active_low = true}), wanted),
                HasSubstr("gpio_active_low = false"));
}

TEST(Rs485, ThatDiffersInDelaysOrEchoIsRemarkedOn)
{
    const serial_rs485 wanted = rs485_wanted({});
    serial_rs485 slow = wanted;
    slow.delay_rts_after_send = 1;

    EXPECT_THAT(remarks_on_rs485(wanted, slow), HasSubstr("1 ms after"));
    EXPECT_THAT(judge_rs485(wanted, slow), IsEmpty());
    const serial_rs485 hears = rs485_wanted({.receive_own = true});
    EXPECT_THAT(remarks_on_rs485(wanted, hears), HasSubstr("echo = \"auto\""));
    EXPECT_THAT(remarks_on_rs485(hears, wanted), HasSubstr("echo = \"off\""));
}

TEST(Directions, HaveTheNamesOfTheConfiguration)
{
    EXPECT_EQ(text(Direction::none), "none");
    EXPECT_EQ(text(Direction::gpio), "gpio");
    EXPECT_EQ(text(Direction::kernel), "kernel");
    EXPECT_EQ(text(Direction::rts), "rts");
}

} // namespace
} // namespace dpslave::io
