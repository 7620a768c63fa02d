// SPDX-License-Identifier: Apache-2.0
/// Who switches the transceiver of a two-wire drive line: the keys of [bus], in [[line]].
#include "config_bench.hpp"

namespace dpslave {
namespace {

using config::Config;
using test::ConfigFile;
using test::kGood;
using test::short_forms;
using test::with;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// kGood with these lines behind the protocol of its drive line.
std::string line_with(const std::string& keys)
{
    return with(kGood, "protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\n" + keys);
}

const std::string kLine17 = "direction = \"gpio\"\ngpio_chip = \"/dev/gpiochip0\"\ngpio_line = 17";

/// A second drive line that switches by line 17.
std::string with_second_line(const std::string& text)
{
    return with(text, "[[station]]",
                "[[line]]\nname = \"p4\"\nport = \"/dev/null-p4\"\nprotocol = \"modbus-rtu\"\n" + kLine17 +
                    "\n[[station]]");
}

class TwoWireLine : public ConfigFile {};

TEST_F(TwoWireLine, switches_by_itself_unless_the_file_says_otherwise)
{
    const Config config = good(kGood);

    EXPECT_EQ(config.lines[0].driver_enable, io::DriverEnableSettings{});
    EXPECT_EQ(config.lines[0].driver_enable.direction, io::Direction::none);
    EXPECT_THAT(config.warnings, IsEmpty());
}

TEST_F(TwoWireLine, has_the_four_ways_of_the_bus)
{
    for (const auto& [name, direction] :
         {std::pair{"none", io::Direction::none}, std::pair{"kernel", io::Direction::kernel},
          std::pair{"rts", io::Direction::rts}}) {
        const Config config = good(line_with("direction = \"" + std::string{name} + '"'));
        EXPECT_EQ(config.lines[0].driver_enable, (io::DriverEnableSettings{.direction = direction}));
        EXPECT_EQ(config.bus.driver_enable.direction, io::Direction::none) << "that of the bus is its own";
        EXPECT_THAT(config.warnings, IsEmpty());
    }
    const Config config = good(line_with(kLine17 + "\ngpio_active_low = true"));
    EXPECT_EQ(config.lines[0].driver_enable, (io::DriverEnableSettings{.direction = io::Direction::gpio,
                                                                       .gpio_chip = "/dev/gpiochip0",
                                                                       .gpio_line = 17,
                                                                       .active_low = true}));
    EXPECT_EQ(good(with_second_line(kGood)).lines[1].driver_enable.gpio_line, 17U) << "Modbus too";
}

TEST_F(TwoWireLine, needs_chip_and_line_with_gpio)
{
    EXPECT_THAT(short_forms(bad(line_with("direction = \"gpio\""))),
                ElementsAre(AllOf(HasSubstr("'gpio_chip' is missing in [[line]]"), HasSubstr("`gpioinfo`")),
                            HasSubstr("'gpio_line' is missing in [[line]]")));
    EXPECT_THAT(short_forms(bad(line_with("direction = \"auto\""))), ElementsAre(HasSubstr("'direction'")));
}

TEST_F(TwoWireLine, is_warned_of_keys_of_another_direction_also_where_it_names_none)
{
    const Config config = good(line_with("gpio_chip = \"/dev/gpiochip0\"\ngpio_line = 17"));

    EXPECT_THAT(short_forms(config.warnings),
                ElementsAre(AllOf(StartsWith("13:13: 'gpio_chip' means nothing with direction = \"none\"")),
                            StartsWith("14:13: 'gpio_line' means nothing")));
    EXPECT_EQ(config.lines[0].driver_enable, io::DriverEnableSettings{});
}

TEST_F(TwoWireLine, asks_the_kernel_for_an_echo_that_is_to_be_removed)
{
    const auto receives_own = [&](const std::string& direction, const std::string& echo) {
        return good(line_with("direction = \"" + direction + "\"\necho = \"" + echo + '"'))
            .lines[0]
            .driver_enable.receive_own;
    };
    EXPECT_TRUE(receives_own("kernel", "on"));
    EXPECT_FALSE(receives_own("kernel", "off"));
    EXPECT_FALSE(receives_own("rts", "on"));
}

TEST_F(TwoWireLine, never_shares_a_GPIO_line_with_the_bus_another_line_or_a_lamp)
{
    const std::string by_bus = with(kGood, "direction = \"none\"", kLine17);
    EXPECT_THAT(short_forms(bad(with_second_line(by_bus))),
                ElementsAre(AllOf(HasSubstr("line 17 of GPIO chip \"/dev/gpiochip0\" is already on line 6"),
                                  HasSubstr("a GPIO line of its own"))));

    EXPECT_THAT(short_forms(bad(with_second_line(line_with(kLine17)))),
                ElementsAre(HasSubstr("is already on line 15")));
    EXPECT_THAT(short_forms(bad(
                    with_second_line(line_with(with(kLine17, "/dev/gpiochip0", "/dev/../dev/gpiochip0"))))),
                ElementsAre(HasSubstr("is already on line 15")))
        << "by another name";
    EXPECT_EQ(good(with_second_line(line_with(with(kLine17, "17", "18")))).lines.size(), 2U);

    EXPECT_THAT(short_forms(bad(with(line_with(kLine17), "unit = \"00\"",
                                     "unit = \"00\"\n[station.leds]\nred = \"line:/dev/gpiochip0:17\""))),
                ElementsAre(HasSubstr("switches the transceiver of line \"p3\"")));
}

} // namespace
} // namespace dpslave
