// SPDX-License-Identifier: Apache-2.0
/// Lamps in a folder that looks like sysfs.
#include "support/folder.hpp"

#include "dpslave/io/led_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr Instant kAtFirst{1h};

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
    (*lamp)->set(true, kAtFirst);
    EXPECT_EQ(get("class/gpio/gpio23/value"), "1");
    (*lamp)->set(false, kAtFirst);
    EXPECT_EQ(get("class/gpio/gpio23/value"), "0");
}

TEST_F(LedSinks, APinIsDarkAfterwards)
{
    has_pin("23");
    {
        auto lamp = open_led_sink("gpio:23", sysfs);
        ASSERT_TRUE(lamp) << lamp.error();
        (*lamp)->set(true, kAtFirst);
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
    (*lamp)->set(true, kAtFirst);
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
    (*lamp)->set(true, kAtFirst);
    EXPECT_EQ(get("class/leds/dpslaved-green/brightness"), "15");
    (*lamp)->set(false, kAtFirst);
    EXPECT_EQ(get("class/leds/dpslaved-green/brightness"), "0");
}

TEST_F(LedSinks, ALampOfTheLedClassIsDarkAfterwards)
{
    has_lamp("red", "255");
    {
        auto lamp = open_led_sink("led:red", sysfs);
        ASSERT_TRUE(lamp) << lamp.error();
        (*lamp)->set(true, kAtFirst);
    }

    EXPECT_EQ(get("class/leds/red/brightness"), "0");
}

TEST_F(LedSinks, AKernelWithoutTriggersIsFine)
{
    has_lamp("red", "1");
    fs::remove(sysfs / "class/leds/red/trigger");

    EXPECT_TRUE(open_led_sink("led:red", sysfs));
}

TEST_F(LedSinks, OnlyAChangeIsWritten)
{
    has_lamp("red", "1");
    auto lamp = open_led_sink("led:red", sysfs);
    ASSERT_TRUE(lamp) << lamp.error();
    (*lamp)->set(true, kAtFirst);
    put("class/leds/red/brightness", "untouched");

    (*lamp)->set(true, kAtFirst);

    EXPECT_EQ(get("class/leds/red/brightness"), "untouched");
}

TEST_F(LedSinks, ALampThatWasGoneShinesAgainWithTheNextChange)
{
    has_lamp("red", "1");
    auto lamp = open_led_sink("led:red", sysfs);
    ASSERT_TRUE(lamp) << lamp.error();
    (*lamp)->set(true, kAtFirst);
    fs::remove_all(sysfs / "class/leds/red");
    (*lamp)->set(false, kAtFirst);
    has_lamp("red", "1");

    (*lamp)->set(true, kAtFirst);

    EXPECT_EQ(get("class/leds/red/brightness"), "1");
}

TEST_F(LedSinks, ALampThatWasGoneShinesAgainAfterASecondWithoutAChange)
{
    has_lamp("red", "1");
    auto lamp = open_led_sink("led:red", sysfs);
    ASSERT_TRUE(lamp) << lamp.error();
    fs::remove_all(sysfs / "class/leds/red");
    (*lamp)->set(true, kAtFirst);
    has_lamp("red", "1");

    (*lamp)->set(true, kAtFirst + 999ms);
    EXPECT_EQ(get("class/leds/red/brightness"), "3") << "not tried yet";
    (*lamp)->set(true, kAtFirst + 1s);
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

/// Counts how often it is written.
class CountedLamp final : public LedSink {
public:
    int tries = 0;
    bool works = true;

private:
    bool write(bool) override
    {
        ++tries;
        return works;
    }
};

/// The main loop: a round each 5 ms, for `length`.
void rounds(LedSink& lamp, bool lit, Instant from, std::chrono::milliseconds length)
{
    for (auto passed = 0ms; passed < length; passed += 5ms) lamp.set(lit, from + passed);
}

TEST(LampThatCannotBeWritten, IsTriedOnceASecondHoweverOftenTheMainLoopComes)
{
    CountedLamp lamp;
    lamp.works = false;

    rounds(lamp, true, kAtFirst, 3s);

    EXPECT_EQ(lamp.tries, 3);
}

TEST(LampThatCannotBeWritten, IsTriedWithEachChangeAtOnce)
{
    CountedLamp lamp;
    lamp.works = false;

    rounds(lamp, true, kAtFirst, 500ms);
    rounds(lamp, false, kAtFirst + 500ms, 500ms);
    rounds(lamp, true, kAtFirst + 1s, 500ms);

    EXPECT_EQ(lamp.tries, 3);
}

TEST(LampThatCannotBeWritten, IsLeftAloneOnceItWorksAgain)
{
    CountedLamp lamp;
    lamp.works = false;
    rounds(lamp, true, kAtFirst, 1s);
    lamp.works = true;

    rounds(lamp, true, kAtFirst + 1s, 5s);

    EXPECT_EQ(lamp.tries, 2);
}

TEST(LampThatCanBeWritten, IsWrittenOnceForEachChange)
{
    CountedLamp lamp;

    rounds(lamp, false, kAtFirst, 2s); // dark it was
    rounds(lamp, true, kAtFirst + 2s, 5s);
    rounds(lamp, false, kAtFirst + 7s, 5s);

    EXPECT_EQ(lamp.tries, 2);
}

} // namespace
} // namespace dpslave::io
