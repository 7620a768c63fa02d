// SPDX-License-Identifier: Apache-2.0
/// Lamps in a folder that looks like sysfs.
#include "support/folder.hpp"

#include "dpslave/io/led_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class LedSinks : public testing::Test {
protected:
    void put(const fs::path& file, const std::string& text)
    {
        fs::create_directories((sysfs / file).parent_path());
        std::ofstream{sysfs / file} << text << '\n';
    }
    std::string get(const fs::path& file)
    {
        std::string line;
        std::getline(std::ifstream{sysfs / file}, line);
        return line;
    }
    void has_pin(const std::string& number)
    {
        put("class/gpio/export", "");
        put("class/gpio/gpio" + number + "/direction", "in");
        put("class/gpio/gpio" + number + "/value", "1");
    }
    void has_chip(const std::string& label, const std::string& base, const std::string& pins)
    {
        const fs::path chip = "class/gpio/gpiochip" + base;
        put(chip / "label", label);
        put(chip / "base", base);
        put(chip / "ngpio", pins);
    }
    void has_lamp(const std::string& name, const std::string& max)
    {
        put("class/leds/" + name + "/trigger", "heartbeat");
        put("class/leds/" + name + "/max_brightness", max);
        put("class/leds/" + name + "/brightness", "3");
    }

    dpslave::test::Folder kept;
    fs::path sysfs = kept.path();
};

TEST_F(LedSinks, APinBecomesADarkOutputThenFollows)
{
    has_pin("23");

    auto lamp = open_led_sink("gpio:23", sysfs);

    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_EQ(get("class/gpio/gpio23/direction"), "low") << "an output that was never high";
    EXPECT_EQ(get("class/gpio/gpio23/value"), "0");
    (*lamp)->set(true);
    EXPECT_EQ(get("class/gpio/gpio23/value"), "1");
    (*lamp)->set(false);
    EXPECT_EQ(get("class/gpio/gpio23/value"), "0");
}

TEST_F(LedSinks, APinIsDarkAfterwards)
{
    has_pin("23");
    {
        auto lamp = open_led_sink("gpio:23", sysfs);
        ASSERT_TRUE(lamp) << lamp.error();
        (*lamp)->set(true);
    }

    EXPECT_EQ(get("class/gpio/gpio23/value"), "0");
}

TEST_F(LedSinks, APinIsFoundByTheLabelOfItsChipWhateverNumberItHasSinceTheLastBoot)
{
    has_chip("gpio-mockup", "496", "8");
    has_chip("pl061", "504", "8");
    has_pin("511");

    auto lamp = open_led_sink("gpio:pl061:7", sysfs);

    ASSERT_TRUE(lamp) << lamp.error();
    (*lamp)->set(true);
    EXPECT_EQ(get("class/gpio/gpio511/value"), "1");
}

TEST_F(LedSinks, APinThatIsNotExportedIsAskedFor)
{
    put("class/gpio/export",
        ""); // a file exports nothing: the sentence is the end of it, but the request is seen

    const auto lamp = open_led_sink("gpio:17", sysfs);

    EXPECT_EQ(get("class/gpio/export"), "17");
    ASSERT_FALSE(lamp);
    EXPECT_THAT(lamp.error(), AllOf(HasSubstr("gpio:17"), HasSubstr("gpio17/direction"), HasSubstr("check")));
}

TEST_F(LedSinks, APinThatIsExportedIsNotAskedForAgain)
{
    has_pin("23");

    const auto lamp = open_led_sink("gpio:23", sysfs);

    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_EQ(get("class/gpio/export"), "");
}

TEST_F(LedSinks, AMachineWithoutSysfsGpioIsReported)
{
    const auto lamp = open_led_sink("gpio:23", sysfs);

    ASSERT_FALSE(lamp);
    EXPECT_THAT(lamp.error(), AllOf(HasSubstr("LED gpio:23"), HasSubstr("class/gpio/export"),
                                    HasSubstr("check that the pin")));
}

TEST_F(LedSinks, ALampOfTheLedClassShinesAsBrightAsItCan)
{
    has_lamp("dpslaved-green", "15");

    auto lamp = open_led_sink("led:dpslaved-green", sysfs);

    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_EQ(get("class/leds/dpslaved-green/trigger"), "none");
    EXPECT_EQ(get("class/leds/dpslaved-green/brightness"), "0");
    (*lamp)->set(true);
    EXPECT_EQ(get("class/leds/dpslaved-green/brightness"), "15");
    (*lamp)->set(false);
    EXPECT_EQ(get("class/leds/dpslaved-green/brightness"), "0");
}

TEST_F(LedSinks, ALampOfTheLedClassIsDarkAfterwards)
{
    has_lamp("red", "255");
    {
        auto lamp = open_led_sink("led:red", sysfs);
        ASSERT_TRUE(lamp) << lamp.error();
        (*lamp)->set(true);
    }

    EXPECT_EQ(get("class/leds/red/brightness"), "0");
}

TEST_F(LedSinks, AKernelWithoutTriggersIsFine)
{
    has_lamp("red", "1");
    fs::remove(sysfs / "class/leds/red/trigger");

    EXPECT_TRUE(open_led_sink("led:red", sysfs));
}

TEST_F(LedSinks, ALampThatHasGoneSaysSoAndIsThereWhenItIsOpenedAgain)
{
    has_lamp("red", "1");
    auto lamp = open_led_sink("led:red", sysfs);
    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_TRUE((*lamp)->set(true));
    fs::remove_all(sysfs / "class/leds/red");
    EXPECT_FALSE((*lamp)->set(false));
    has_lamp("red", "1");

    lamp->reset();
    lamp = open_led_sink("led:red", sysfs);

    ASSERT_TRUE(lamp) << lamp.error();
    EXPECT_TRUE((*lamp)->set(true));
    EXPECT_EQ(get("class/leds/red/brightness"), "1");
}

TEST_F(LedSinks, AnUnknownLampOrKindIsRefusedWithASentence)
{
    has_chip("pl061", "504", "8");
    for (const char* sink : {"led:nobody", "led:", "led:..", "led:../../etc", "gpio:", "gpio:red", "gpio:-1",
                             "gpio:12345678901", "lamp", "", "gpio:pl061:8", "gpio:pl06:1", "gpio:pl061:"}) {
        const auto lamp = open_led_sink(sink, sysfs);
        ASSERT_FALSE(lamp) << sink;
        EXPECT_THAT(lamp.error(),
                    AllOf(HasSubstr(sink), testing::AnyOf(HasSubstr("check"), HasSubstr("write"))))
            << sink;
    }
}

} // namespace
} // namespace dpslave::io
