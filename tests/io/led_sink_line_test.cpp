// SPDX-License-Identifier: Apache-2.0
/// Lamps on lines of a GPIO chip.
#include "gpio_folder.hpp"

#include "dpslave/io/led_sink.hpp"

#include <gmock/gmock.h>

namespace dpslave::io {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class LampOnALine : public GpioFolder {
protected:
    std::string sink(unsigned line) const
    {
        return "line:" + chip.path().string() + ":" + std::to_string(line);
    }

    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
};

TEST_F(LampOnALine, IsDarkAtFirstThenFollowsAndIsDarkAfterwards)
{
    chip.leave(4, true);
    {
        auto lamp = open_led_sink(sink(4), folder);
        ASSERT_TRUE(lamp) << lamp.error();
        EXPECT_FALSE(chip.high(4));
        EXPECT_EQ(chip.consumer(4), "dpslaved lamp");
        (*lamp)->set(true);
        EXPECT_TRUE(chip.high(4));
        (*lamp)->set(false);
        EXPECT_FALSE(chip.high(4));
        (*lamp)->set(true);
    }
    EXPECT_FALSE(chip.high(4));
    EXPECT_FALSE(chip.is_taken(4));
}

TEST_F(LampOnALine, ThatIsInUseIsRefusedWithTheNameOfItsUser)
{
    chip.occupy(4, "gpio-leds");

    const auto lamp = open_led_sink(sink(4), folder);

    ASSERT_FALSE(lamp);
    EXPECT_THAT(lamp.error(), AllOf(HasSubstr("LED " + sink(4)), HasSubstr("in use by \"gpio-leds\"")));
}

TEST_F(LampOnALine, OfAChipThatWasPulledSaysSoAndIsThereWhenItIsOpenedAgain)
{
    auto lamp = open_led_sink(sink(4), folder);
    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_TRUE((*lamp)->set(true));
    chip.remove();
    EXPECT_FALSE((*lamp)->set(false));
    chip.come_back();

    lamp->reset();
    lamp = open_led_sink(sink(4), folder);

    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_TRUE((*lamp)->set(true));
    EXPECT_TRUE(chip.high(4));
}

TEST_F(LampOnALine, IsKnownBeforeItIsOpened)
{
    const auto line = line_of_led_sink(sink(4));

    ASSERT_TRUE(line);
    EXPECT_EQ(line->chip, chip.path().string());
    EXPECT_EQ(line->line, 4U);
    EXPECT_FALSE(judge_led_sink(sink(4)));
    for (const char* other : {"gpio:4", "led:red", "line:pl061"})
        EXPECT_FALSE(line_of_led_sink(other)) << other;
    EXPECT_EQ(chip.edges(4), 0);
}

TEST_F(LampOnALine, ThatIsNoneIsRefusedWithASentence)
{
    for (const char* wrong : {"line:", "line:pl061", "line:pl061:", "line::4", "line:pl061:red",
                              "line:pl061:-1", "line:pl061:12345678901"}) {
        const auto lamp = open_led_sink(wrong, folder);
        ASSERT_FALSE(lamp) << wrong;
        EXPECT_THAT(lamp.error(), AllOf(HasSubstr(wrong), HasSubstr("write \"line:CHIP:LINE\""))) << wrong;
    }
    EXPECT_EQ(chip.edges(4), 0);
}

} // namespace
} // namespace dpslave::io
