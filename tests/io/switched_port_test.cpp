// SPDX-License-Identifier: Apache-2.0
/// A port of a drive line with the line of a GPIO chip that switches its transceiver: all or nothing.
#include "gpio_folder.hpp"
#include "pty.hpp"

#include "dpslave/io/switched_port.hpp"

#include <gmock/gmock.h>

#include <array>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr unsigned kDriverLine = 5;
constexpr std::array<std::uint8_t, 1> kOctet{0x05};

class PortByGpio : public GpioFolder {
protected:
    Result<SwitchedPort, std::string> open(const std::string& path)
    {
        return SwitchedPort::open(
            path, {.baud = 300, .data_bits = 7},
            {.driver = {.direction = Direction::gpio, .gpio_chip = chip.path(), .gpio_line = kDriverLine},
             .priority = 0,
             .counts = &counts});
    }
    stand_in::ChipFile chip{folder / "gpiochip0", "pl061"};
    TransceiverCounts counts;
    Pty cable;
};

TEST_F(PortByGpio, SwitchesTheLineOnceForEachRequest)
{
    auto port = open(cable.path());
    ASSERT_TRUE(port) << port.error();
    EXPECT_FALSE(chip.high(kDriverLine));

    EXPECT_EQ(port->write(kOctet), std::error_code{});

    EXPECT_FALSE(chip.high(kDriverLine));
    EXPECT_EQ(chip.rises(kDriverLine), 1U);
    EXPECT_EQ(counts.late, 0U);
}

TEST_F(PortByGpio, CountsAReleaseThatComesLaterThanACharacter)
{
    auto port = open(cable.path());
    ASSERT_TRUE(port) << port.error();
    chip.takes(40ms); // a character takes 33.3 ms

    EXPECT_EQ(port->write(kOctet), std::error_code{});

    EXPECT_EQ(port->late_after(), 33'333'333ns);
    EXPECT_EQ(counts.late, 1U);
    EXPECT_EQ(counts.requests, 1U);
}

TEST_F(PortByGpio, IsNotOpenedWithoutItsLine)
{
    chip.occupy(kDriverLine, "gpio-leds");
    const auto without_line = open(cable.path());
    ASSERT_FALSE(without_line);
    EXPECT_THAT(without_line.error(), HasSubstr("driver enable: "));
    EXPECT_THAT(without_line.error(), HasSubstr("gpio-leds"));
}

TEST_F(PortByGpio, KeepsNoLineWithoutItsPort)
{
    const auto without_port = open(folder / "not-there");

    ASSERT_FALSE(without_port);
    EXPECT_THAT(without_port.error(), HasSubstr("is not there"));
    EXPECT_FALSE(chip.is_taken(kDriverLine)) << "another program may have it meanwhile";
}

TEST_F(PortByGpio, WhoseChipIsPulledIsClosedUntilTheChipIsBack)
{
    auto port = open(cable.path());
    ASSERT_TRUE(port) << port.error();
    chip.remove();

    EXPECT_TRUE(port->write(kOctet));
    EXPECT_FALSE(port->is_open());
    EXPECT_FALSE(port->ready(Instant{} + 1000h)) << "the port is there, the chip is not";

    chip.come_back();
    EXPECT_TRUE(port->ready(Instant{} + 2000h));
    EXPECT_EQ(port->write(kOctet), std::error_code{});
    EXPECT_EQ(chip.rises(kDriverLine), 1U);
}

} // namespace
} // namespace dpslave::io
