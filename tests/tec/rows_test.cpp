// SPDX-License-Identifier: Apache-2.0
/// Tests how the function block looks in both views (B-040 to B-042, B-048, B-050, B-051).
#include "dpslave/tec/option_block.hpp"

#include <gtest/gtest.h>

namespace dpslave::tec {
namespace {

std::array<Row, 10> rows_of(const Settings& settings)
{
    return rows(settings, OptionFault::none, NetworkState::data_exchange, 0);
}

TEST(TecRows, AreThoseOfTheManualInItsOrder)
{
    const char* const names[] = {"TYPE",          "ADDRESS",       "EXT DIAGNOSTIC", "INT DIAG SELECT",
                                 "RIDE THROUGH",  "UNUSED 1",      "FAULT",          "VERSION",
                                 "NETWORK STATE", "INT DIAGNOSTIC"};
    const auto shown = rows_of({});

    for (std::size_t i = 0; i < shown.size(); ++i) {
        EXPECT_EQ(shown[i].name, names[i]);
        EXPECT_EQ(shown[i].is_input, i < 6) << names[i];
    }
}

TEST(TecRows, HaveGenericNamesInTheViewOfThePcTool)
{
    const char* const names[] = {"TYPE",    "INPUT 1", "INPUT 2", "INPUT 3",  "INPUT 4",
                                 "INPUT 5", "FAULT",   "VERSION", "OUTPUT 1", "OUTPUT 2"};
    const auto shown = rows_of({});

    for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i].generic_name, names[i]);
}

TEST(TecRows, ShowTheValuesAsTheOperatorStationDoes)
{
    const auto shown = rows({.type = 2,
                             .address = 17,
                             .ext_diagnostic = 0x6AB5,
                             .int_diag_select = 101,
                             .ride_through = -1,
                             .unused_1 = 0x000F},
                            OptionFault::none, NetworkState::wait_config, 0x0023);

    const char* const texts[] = {"PROFIBUS DP", "17",   ">6AB5", "101",         "-1 s",
                                 ">000F",       "NONE", ">0300", "WAIT CONFIG", ">0023"};
    const std::int32_t values[] = {2, 17, 0x6AB5, 101, -1, 0x000F, 0, 0x0300, 2, 0x0023};
    for (std::size_t i = 0; i < shown.size(); ++i) {
        EXPECT_EQ(shown[i].shown, texts[i]);
        EXPECT_EQ(shown[i].value, values[i]) << texts[i];
    }
}

TEST(TecRows, ShowWhatIsOutOfRangeAsTheNumberThatItIs)
{
    const auto shown = rows_of({.type = 10,
                                .address = 126,
                                .ext_diagnostic = -1,
                                .int_diag_select = 30000,
                                .ride_through = 61,
                                .unused_1 = -32768});

    const char* const texts[] = {"10", "126", "-1", "30000", "61 s", "-32768"};
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(shown[i].shown, texts[i]);
}

TEST(TecRows, NameEveryTypeFaultAndNetworkStateByItsNumber)
{
    const char* const types[] = {"NONE",    "RS485",    "PROFIBUS DP", "LINK",        "DEVICENET",
                                 "CANOPEN", "LONWORKS", "CONTROLNET",  "MODBUS PLUS", "ETHERNET"};
    for (std::int32_t type = 0; type < 10; ++type) {
        EXPECT_EQ(rows_of({.type = type})[0].shown, types[type]);
        const std::string listed = std::to_string(type) + " " + types[type];
        EXPECT_NE(rows_of({})[0].range.find(listed), std::string_view::npos) << listed;
    }
    for (std::uint8_t number = 0; number < 6; ++number) {
        const auto shown = rows({}, static_cast<OptionFault>(number), static_cast<NetworkState>(number), 0);
        EXPECT_EQ(shown[6].value, number);
        EXPECT_EQ(shown[6].shown, text(static_cast<OptionFault>(number)));
        EXPECT_NE(shown[6].range.find(std::to_string(number) + " " + shown[6].shown), std::string_view::npos);
        EXPECT_EQ(shown[8].value, number);
        EXPECT_EQ(shown[8].shown, text(static_cast<NetworkState>(number)));
        EXPECT_NE(shown[8].range.find(std::to_string(number) + " " + shown[8].shown), std::string_view::npos);
    }
}

TEST(TecRows, VersionIsZeroWithoutAnOption)
{
    const auto shown = rows({}, OptionFault::missing, NetworkState::disabled, 0);

    EXPECT_EQ(shown[7].value, 0);
    EXPECT_EQ(shown[7].shown, ">0000");
}

TEST(TecRows, SayTheRangesOfTheManual)
{
    const auto shown = rows_of({});

    EXPECT_EQ(shown[1].range, "0 to 125");
    EXPECT_EQ(shown[2].range, "0000 to FFFF");
    EXPECT_EQ(shown[3].range, "0 to 29999");
    EXPECT_EQ(shown[4].range, "-1 to 60 s");
    EXPECT_EQ(shown[5].range, "0000 to FFFF");
    EXPECT_EQ(shown[7].range, "0000 to FFFF");
    EXPECT_EQ(shown[9].range, "0000 to FFFF");
}

TEST(TecRows, AreCalledByBothOfTheirNamesAsTheyAreTypedInAShell)
{
    const auto all = rows_of({});

    for (const char* name : {"RIDE THROUGH", "ride_through", " Ride-Through ", "input 4"})
        EXPECT_TRUE(is_called(all[4], name)) << name;
    for (const char* name : {"RIDETHROUGH", "INPUT 5", "", "RIDE THROUGH 1"})
        EXPECT_FALSE(is_called(all[4], name)) << name;
    EXPECT_TRUE(is_called(all[9], "output_2"));
}

TEST(TecRows, WhatARowShowsCanBeSetAgain)
{
    const Settings settings{.type = 8,
                            .address = 17,
                            .ext_diagnostic = 0xB56A,
                            .int_diag_select = 29999,
                            .ride_through = 0,
                            .unused_1 = 1};
    Settings again;
    for (const Row& row : rows_of(settings)) {
        if (!row.is_input || row.name == "RIDE THROUGH") continue; // shown with its unit
        EXPECT_EQ(set(again, row.name, row.shown), SetResult::done) << row.shown;
        EXPECT_EQ(set(again, row.generic_name, row.shown), SetResult::done) << row.shown;
    }

    EXPECT_EQ(again, settings);
}

} // namespace
} // namespace dpslave::tec
