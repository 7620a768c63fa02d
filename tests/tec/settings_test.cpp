// SPDX-License-Identifier: Apache-2.0
/// Tests what can be set in the TEC OPTION function block, and what FAULT makes of it (B-040, B-042 to
/// B-049).
#include "dpslave/tec/option_block.hpp"

#include <gmock/gmock.h>

#include <string>

namespace dpslave::tec {
namespace {

using namespace std::chrono_literals;

constexpr Hardware kSound{};

TEST(TecFault, IsNoneWithTheStartValues)
{
    EXPECT_EQ(fault({}, kSound), OptionFault::none);
}

TEST(TecFault, IsTypeMismatchWithEveryOtherTypeOfTheList)
{
    for (std::int32_t type = 0; type <= 9; ++type)
        EXPECT_EQ(fault({.type = type}, kSound), type == 2 ? OptionFault::none : OptionFault::type_mismatch)
            << type;
}

struct Limits {
    const char* name;
    std::int32_t Settings::*input;
    std::int32_t low;
    std::int32_t high;
};

class TecLimits : public testing::TestWithParam<Limits> {};

TEST_P(TecLimits, AreThoseOfTheOperatorStationAndBeyondThemFaultIsParameter)
{
    const Limits& limits = GetParam();
    Settings settings;
    for (const std::int32_t inside : {limits.low, limits.high}) {
        settings.*limits.input = inside;
        EXPECT_NE(fault(settings, kSound), OptionFault::parameter) << inside;
    }
    for (const std::int32_t outside : {limits.low - 1, limits.high + 1, -32768, 65536}) {
        settings.*limits.input = outside;
        EXPECT_EQ(fault(settings, kSound), OptionFault::parameter) << outside;
    }
}

INSTANTIATE_TEST_SUITE_P(B049, TecLimits,
                         testing::Values(Limits{"Type", &Settings::type, 0, 9},
                                         Limits{"Address", &Settings::address, 0, 125},
                                         Limits{"ExtDiagnostic", &Settings::ext_diagnostic, 0, 0xFFFF},
                                         Limits{"IntDiagSelect", &Settings::int_diag_select, 0, 29999},
                                         Limits{"RideThrough", &Settings::ride_through, -1, 60},
                                         Limits{"Unused1", &Settings::unused_1, 0, 0xFFFF}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST(TecFault, HardwareGoesBeforeSelfTestBeforeParameterBeforeTypeMismatch)
{
    Settings settings{.type = 3, .address = 126};
    EXPECT_EQ(fault(settings, {.self_test_passed = false, .bus_works = false}), OptionFault::hardware);
    EXPECT_EQ(fault(settings, {.self_test_passed = false, .bus_works = true}), OptionFault::self_test);
    EXPECT_EQ(fault(settings, kSound), OptionFault::parameter);
    settings.address = 125;
    EXPECT_EQ(fault(settings, kSound), OptionFault::type_mismatch);
}

TEST(TecFault, BaudSearchIsNoFault)
{
    EXPECT_EQ(fault({}, {.self_test_passed = true, .bus_works = true, .baud_search = true}),
              OptionFault::none);
}

TEST(TecFault, OfParameterCanSayWhichInputsItIsAbout)
{
    EXPECT_THAT(inputs_out_of_range({}), testing::IsEmpty());
    EXPECT_THAT(inputs_out_of_range({.type = 9}), testing::IsEmpty()) << "another type, but one of the list";
    EXPECT_THAT(inputs_out_of_range({.ride_through = 61}), testing::ElementsAre("RIDE THROUGH"));
    EXPECT_THAT(inputs_out_of_range({.type = -1,
                                     .address = 126,
                                     .ext_diagnostic = -1,
                                     .int_diag_select = 30000,
                                     .ride_through = -2,
                                     .unused_1 = -1}),
                testing::ElementsAre("TYPE", "ADDRESS", "EXT DIAGNOSTIC", "INT DIAG SELECT", "RIDE THROUGH",
                                     "UNUSED 1"));
}

TEST(TecRideThrough, IsInSecondsAndMinusOneMeansNever)
{
    EXPECT_EQ(zero_after({.ride_through = 0}), std::chrono::nanoseconds{0});
    EXPECT_EQ(zero_after({.ride_through = 1}), std::chrono::nanoseconds{1s});
    EXPECT_EQ(zero_after({.ride_through = 60}), std::chrono::nanoseconds{60s});
    EXPECT_EQ(zero_after({.ride_through = -1}), std::nullopt);
}

TEST(TecRideThrough, OutOfRangeIsAtOnceTheSafeSide)
{
    for (const std::int32_t seconds : {-32768, -2, 61, 32767, 65535})
        EXPECT_EQ(zero_after({.ride_through = seconds}), std::chrono::nanoseconds{0}) << seconds;
}

TEST(TecSet, TakesEveryInputByItsName)
{
    Settings settings;

    EXPECT_EQ(set(settings, "TYPE", "3"), SetResult::done);
    EXPECT_EQ(set(settings, "ADDRESS", "17"), SetResult::done);
    EXPECT_EQ(set(settings, "EXT DIAGNOSTIC", ">6AB5"), SetResult::done);
    EXPECT_EQ(set(settings, "INT DIAG SELECT", "101"), SetResult::done);
    EXPECT_EQ(set(settings, "RIDE THROUGH", "-1"), SetResult::done);
    EXPECT_EQ(set(settings, "UNUSED 1", "9"), SetResult::done);

    EXPECT_EQ(settings, (Settings{.type = 3,
                                  .address = 17,
                                  .ext_diagnostic = 0x6AB5,
                                  .int_diag_select = 101,
                                  .ride_through = -1,
                                  .unused_1 = 9}));
}

TEST(TecSet, TakesEveryInputByItsGenericName)
{
    Settings settings;

    for (int i = 1; i <= 5; ++i)
        EXPECT_EQ(set(settings, "INPUT " + std::to_string(i), std::to_string(10 + i)), SetResult::done) << i;

    EXPECT_EQ(settings, (Settings{.type = 2,
                                  .address = 11,
                                  .ext_diagnostic = 12,
                                  .int_diag_select = 13,
                                  .ride_through = 14,
                                  .unused_1 = 15}));
}

TEST(TecSet, TakesNamesAsTheyAreTypedInAShell)
{
    for (const char* name :
         {"ride_through", "Ride Through", "RIDE-THROUGH", "input 4", "Input_4", " ride through "}) {
        Settings settings;
        EXPECT_EQ(set(settings, name, "5"), SetResult::done) << name;
        EXPECT_EQ(settings.ride_through, 5) << name;
    }
}

TEST(TecSet, TakesNumbersInDecimalAndInBothFormsOfHexadecimal)
{
    struct Typed {
        const char* text;
        std::int32_t value;
    };
    for (const Typed& typed :
         {Typed{"26", 26}, Typed{">1A", 26}, Typed{"0x1A", 26}, Typed{"0X1a", 26}, Typed{"007", 7},
          Typed{" 5 ", 5}, Typed{"-32768", -32768}, Typed{"65535", 65535}, Typed{">FFFF", 65535}}) {
        Settings settings;
        EXPECT_EQ(set(settings, "ext diagnostic", typed.text), SetResult::done) << typed.text;
        EXPECT_EQ(settings.ext_diagnostic, typed.value) << typed.text;
    }
}

TEST(TecSet, TakesTypeByItsNameAndByItsNumber)
{
    const char* const printed[] = {"NONE",    "RS485",    "PROFIBUS DP", "LINK",        "DEVICENET",
                                   "CANOPEN", "LONWORKS", "CONTROLNET",  "MODBUS PLUS", "ETHERNET"};
    for (std::int32_t number = 0; number < 10; ++number) {
        Settings settings{.type = 99};
        EXPECT_EQ(set(settings, "type", printed[number]), SetResult::done) << printed[number];
        EXPECT_EQ(settings.type, number);
        settings.type = 99;
        EXPECT_EQ(set(settings, "TYPE", std::to_string(number)), SetResult::done);
        EXPECT_EQ(settings.type, number);
    }
    Settings settings;
    EXPECT_EQ(set(settings, "type", "modbus_plus"), SetResult::done);
    EXPECT_EQ(settings.type, 8);
}

TEST(TecSet, AValueThatNoOperatorStationTakesIsTakenAndMakesAFault)
{
    Settings settings;

    EXPECT_EQ(set(settings, "ADDRESS", "126"), SetResult::done);
    EXPECT_EQ(fault(settings, kSound), OptionFault::parameter);
    EXPECT_EQ(set(settings, "ADDRESS", "5"), SetResult::done);
    EXPECT_EQ(fault(settings, kSound), OptionFault::none);
    EXPECT_EQ(set(settings, "EXT DIAGNOSTIC", "-1"), SetResult::done);
    EXPECT_EQ(fault(settings, kSound), OptionFault::parameter);
}

TEST(TecSet, RefusesWhatIsNoInputOrNoNumberOf16BitsAndChangesNothing)
{
    Settings settings;
    for (const char* name : {"FAULT", "version", "NETWORK_STATE", "INT DIAGNOSTIC", "OUTPUT 1", "output-2"})
        EXPECT_EQ(set(settings, name, "1"), SetResult::is_output) << name;
    for (const char* name : {"OUTPUT 3", "INPUT 0", "INPUT 6", "UNUSED", "", "RIDE THROUGHX"})
        EXPECT_EQ(set(settings, name, "1"), SetResult::no_such_input) << name;
    for (const char* value : {"", " ", "-", ">", "0x", "1A", "6AB5", "1.5", "1 2", "+5", "65536", "-32769",
                              ">10000", ">-1", "0x-1", "99999999999999999999", "PROFIBUS DP", "five"})
        EXPECT_EQ(set(settings, "EXT DIAGNOSTIC", value), SetResult::no_such_value) << value;
    EXPECT_EQ(set(settings, "TYPE", "PROFINET"), SetResult::no_such_value);

    EXPECT_EQ(settings, Settings{});
}

} // namespace
} // namespace dpslave::tec
