// SPDX-License-Identifier: Apache-2.0
#include "app/drive/line_probe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dpslave::app {
namespace {

using drive::UnitAddress;

config::LineConfig line(std::string_view protocol, std::uint32_t baud)
{
    config::LineConfig config;
    config.protocol = protocol;
    config.baud = baud;
    if (protocol == config::kModbusRtu) config.format = {8, 'N', 1};
    return config;
}

bool asks(const ProbeTry& one, UnitAddress unit)
{
    return std::find(one.units.begin(), one.units.end(), unit) != one.units.end();
}

TEST(LineProbe, AsksEveryUsualUnitAtTheLinesOwnSettingsFirst)
{
    const auto plan = probe_plan(line(config::kEiAscii, 19200), {.group = 2, .unit = 3});

    EXPECT_EQ(plan[0].baud, 19200U);
    EXPECT_EQ(plan[0].format, (config::LineFormat{7, 'E', 1}));
    EXPECT_EQ(plan[0].units.front(), (UnitAddress{.group = 2, .unit = 3}));
    EXPECT_TRUE(asks(plan[0], {.group = 0, .unit = 0}));
    EXPECT_TRUE(asks(plan[0], {.group = 7, .unit = 15}));
}

TEST(LineProbe, AsksEachOtherPairOfRateAndFormatOnceWithThisUnitAndTheFirst)
{
    for (const std::string_view protocol : {config::kEiAscii, config::kModbusRtu}) {
        const auto plan = probe_plan(line(protocol, 9600), {.group = 0, .unit = 5});
        std::set<std::pair<std::uint32_t, char>> seen;
        for (const ProbeTry& one : plan) {
            const char format = static_cast<char>(one.format.data_bits * 16 + one.format.parity % 16);
            EXPECT_TRUE(seen.emplace(one.baud, format).second) << protocol << one.baud;
            EXPECT_TRUE(asks(one, {.group = 0, .unit = 5}));
        }
        EXPECT_GE(plan.size(), 24U);
        EXPECT_EQ(plan[1].units.size(), 2U);
    }
}

TEST(LineProbe, WaitsNoLongerForAnAnswerThanTheLineAndNeverForLong)
{
    config::LineConfig config = line(config::kModbusRtu, 9600);
    config.timeout = std::chrono::milliseconds{600};
    EXPECT_EQ(probe_timeout(config), std::chrono::milliseconds{300});
    config.timeout = std::chrono::milliseconds{20};
    EXPECT_EQ(probe_timeout(config), std::chrono::milliseconds{100});
}

TEST(LineProbe, SaysHowLongItTakesAtMost)
{
    config::LineConfig config = line(config::kModbusRtu, 9600);
    config.timeout = std::chrono::milliseconds{200};
    const std::vector<ProbeTry> plan{
        {9600, config.format, {{.group = 0, .unit = 1}, {.group = 0, .unit = 2}}},
        {1200, config.format, {{.group = 0, .unit = 1}}}};
    const ProbeLength length = length_of(plan, config);
    EXPECT_EQ(length.questions, 3U);
    EXPECT_GE(length.longest, std::chrono::seconds{1}) << "3 times 200 ms, and characters at 1200 bit/s";
    EXPECT_LE(length.longest, std::chrono::seconds{2});
    EXPECT_LE(length_of(probe_plan(config, {.group = 0, .unit = 5}), config).longest,
              std::chrono::seconds{60});
}

TEST(LineProbe, NamesAUnitAsTheConfigurationDoes)
{
    EXPECT_EQ(unit_text(line(config::kEiAscii, 9600), {.group = 1, .unit = 10}), "1A");
    EXPECT_EQ(unit_text(line(config::kModbusRtu, 9600), {.group = 0, .unit = 10}), "10");
}

} // namespace
} // namespace dpslave::app
