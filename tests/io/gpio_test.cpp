// SPDX-License-Identifier: Apache-2.0
/// A line of a GPIO chip, by the real code over a stand-in of libgpiod whose chips are files.
#include "gpio_folder.hpp"
#include "io/gpio/gpio_chips.hpp"

#include "dpslave/io/gpio.hpp"

#include <gmock/gmock.h>

namespace dpslave::io {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

class Gpio : public GpioFolder {
protected:
    Result<GpioLine, std::string> take(unsigned line, bool active_low = false)
    {
        return GpioLine::request({.chip = chip.path(),
                                  .line = line,
                                  .active_low = active_low,
                                  .consumer = "the test",
                                  .devices = folder});
    }
    std::string refused(const GpioRequest& request)
    {
        const auto line = GpioLine::request(request);
        EXPECT_FALSE(line);
        return line ? std::string{} : line.error();
    }
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061", 8};
};

TEST_F(Gpio, ALineThatIsTakenIsInactiveAtOnce)
{
    chip.leave(3, true);

    auto line = take(3);

    ASSERT_TRUE(line) << line.error();
    EXPECT_FALSE(chip.high(3));
    EXPECT_EQ(chip.falls(3), 1);
    EXPECT_EQ(chip.rises(3), 0) << "and was never made active";
    EXPECT_EQ(chip.consumer(3), "the test");
}

TEST_F(Gpio, ALineFollows)
{
    auto line = take(3);
    ASSERT_TRUE(line) << line.error();

    EXPECT_FALSE(line->set(true));
    EXPECT_TRUE(chip.high(3));
    EXPECT_FALSE(line->set(false));
    EXPECT_FALSE(chip.high(3));
    EXPECT_EQ(chip.requests(3), 1) << "it is asked for once, not with each edge";
    for (const unsigned other : {0U, 1U, 2U, 4U, 5U, 6U, 7U}) EXPECT_EQ(chip.edges(other), 0) << other;
}

TEST_F(Gpio, ALineThatIsActiveLowIsHighWhileItIsInactive)
{
    auto line = take(3, true);
    ASSERT_TRUE(line) << line.error();

    EXPECT_TRUE(chip.high(3));
    EXPECT_EQ(chip.falls(3), 0) << "and was never made active";
    EXPECT_FALSE(line->set(true));
    EXPECT_FALSE(chip.high(3));
    EXPECT_FALSE(line->set(false));
    EXPECT_TRUE(chip.high(3));
}

TEST_F(Gpio, ALineIsInactiveAndFreeAfterwards)
{
    {
        auto line = take(3);
        ASSERT_TRUE(line) << line.error();
        EXPECT_FALSE(line->set(true));
        EXPECT_TRUE(chip.is_taken(3));
    }

    EXPECT_FALSE(chip.high(3));
    EXPECT_FALSE(chip.is_taken(3));
    EXPECT_TRUE(take(3));
}

TEST_F(Gpio, ALineKeepsWhatItIsWhenItsOwnerIsMoved)
{
    auto line = take(3);
    ASSERT_TRUE(line) << line.error();
    EXPECT_FALSE(line->set(true));

    GpioLine moved = std::move(*line);

    EXPECT_TRUE(chip.high(3));
    EXPECT_FALSE(moved.set(false));
    EXPECT_FALSE(chip.high(3));
}

TEST_F(Gpio, ALineInUseIsRefusedWithTheNameOfItsUser)
{
    chip.occupy(3, "gpio-leds");

    const std::string why = refused({.chip = chip.path(), .line = 3, .consumer = "the test"});

    EXPECT_THAT(why, AllOf(HasSubstr("line 3"), HasSubstr(chip.path().string()),
                           HasSubstr("in use by \"gpio-leds\""), HasSubstr("gpioinfo")));
    EXPECT_EQ(chip.edges(3), 0);
}

TEST_F(Gpio, ALineThatTheChipDoesNotHaveIsRefusedWithTheirNumber)
{
    EXPECT_THAT(refused({.chip = chip.path(), .line = 8, .consumer = "the test"}),
                AllOf(HasSubstr("line 8"), HasSubstr("8 lines, from 0 to 7"), HasSubstr("gpioinfo")));
}

TEST_F(Gpio, AChipThatIsNotThereIsRefused)
{
    EXPECT_THAT(refused({.chip = folder / "gpiochip9", .consumer = "the test"}),
                AllOf(HasSubstr("gpiochip9 is not there"), HasSubstr("gpiodetect")));
}

TEST_F(Gpio, SomethingElseThanAChipIsRefused)
{
    EXPECT_THAT(refused({.chip = "/dev/null", .consumer = "the test"}), HasSubstr("is no GPIO chip"));
}

TEST_F(Gpio, AUserWithoutRightsGetsTheNameOfTheGroup)
{
    const GpioRequest request{.chip = "/dev/gpiochip0", .line = 17};

    for (const int error : {EACCES, EPERM})
        EXPECT_THAT(why_no_chip(request, error),
                    AllOf(HasSubstr("may not open"), HasSubstr("group dpslaved"), HasSubstr("DeviceAllow")));
}

TEST_F(Gpio, AChipIsFoundByItsLabelOrItsName)
{
    const stand_in::ChipFile other{folder / "gpiochip1", "mcp23017"};
    for (const char* const name : {"pl061", "gpiochip0"}) {
        auto line = GpioLine::request({.chip = name, .line = 3, .consumer = "the test", .devices = folder});
        ASSERT_TRUE(line) << line.error();
        EXPECT_FALSE(line->set(true));
        EXPECT_TRUE(chip.high(3)) << name;
    }
    EXPECT_EQ(other.edges(3), 0);
}

TEST_F(Gpio, ALabelIsFoundBehindAChipThatCannotBeOpened)
{
    std::filesystem::rename(chip.path(), folder / "gpiochip1");
    std::filesystem::create_symlink(folder / "gone", folder / "gpiochip0");

    EXPECT_TRUE(GpioLine::request({.chip = "pl061", .line = 3, .consumer = "the test", .devices = folder}));
}

TEST_F(Gpio, ALabelOfNoChipIsRefused)
{
    EXPECT_THAT(refused({.chip = "pl0611", .consumer = "the test", .devices = folder}),
                AllOf(HasSubstr("pl0611 is not there"), HasSubstr("name or label"), HasSubstr("gpiodetect")));
}

TEST_F(Gpio, ALabelOfTwoChipsIsRefusedForTheWrongPinWouldMove)
{
    const stand_in::ChipFile twin{folder / "gpiochip1", "pl061"};

    EXPECT_THAT(refused({.chip = "pl061", .line = 3, .consumer = "the test", .devices = folder}),
                AllOf(HasSubstr("gpiochip0"), HasSubstr("gpiochip1"), HasSubstr("give the path")));
    EXPECT_EQ(chip.edges(3), 0);
    EXPECT_EQ(twin.edges(3), 0);
}

TEST_F(Gpio, ChipsAreLookedAtByTheirNumber)
{
    const stand_in::ChipFile tenth{folder / "gpiochip10"};
    const stand_in::ChipFile second{folder / "gpiochip2"};

    EXPECT_THAT(gpio_chips(folder),
                ElementsAre(EndsWith("gpiochip0"), EndsWith("gpiochip2"), EndsWith("gpiochip10")));
    EXPECT_THAT(gpio_chips(folder / "nothing"), testing::IsEmpty());
}

TEST_F(Gpio, AChipThatIsPulledIsAnErrorOfTheEdgeAlsoWhenAnotherOneTakesItsPlace)
{
    auto line = take(3);
    ASSERT_TRUE(line) << line.error();
    chip.remove();

    EXPECT_EQ(line->set(true), std::errc::no_such_device);
    chip.come_back();
    EXPECT_EQ(line->set(true), std::errc::no_such_device);
    EXPECT_FALSE(chip.high(3));
}

} // namespace
} // namespace dpslave::io
