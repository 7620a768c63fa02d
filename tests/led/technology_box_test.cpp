// SPDX-License-Identifier: Apache-2.0
/// The lamps of a technology box, row by row of HA463561U002 (B-030 to B-035).
#include "watch.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dpslave::led {
namespace {

using namespace std::chrono_literals;

// In two seconds: two flashes of 10, 50 and 90 %.
constexpr Seen kShort{2, 200};
constexpr Seen kHalf{2, 1000};
constexpr Seen kLong{2, 1800};

struct Lamps {
    Seen network, module, health, run;
};

Lamps lamps_of(const Condition& condition)
{
    const std::vector<Lamp> shown = lamps(Language::technology_box, condition);
    if (shown.size() != 4 || shown[0].name != "network" || shown[1].name != "module" ||
        shown[2].name != "health" || shown[3].name != "run") {
        ADD_FAILURE() << "not the four lamps of the box";
        return {};
    }
    return {watch(shown[0].pattern, 12'345ms), watch(shown[1].pattern, 12'345ms),
            watch(shown[2].pattern, 12'345ms), watch(shown[3].pattern, 12'345ms)};
}

Condition with(NetworkState network, OptionFault fault = OptionFault::none)
{
    return {.running = true, .fault = fault, .network = network};
}

struct NetworkRow {
    const char* name;
    NetworkState state;
    Seen network;
    const char* says;
};

class NetworkLed : public testing::TestWithParam<NetworkRow> {};

TEST_P(NetworkLed, ShowsTheRowOfTheManualWhileModuleIsOn)
{
    const Condition condition = with(GetParam().state);

    EXPECT_EQ(lamps_of(condition).network, GetParam().network);
    EXPECT_EQ(lamps_of(condition).module, kSteady);
    EXPECT_TRUE(says(Language::technology_box, condition, GetParam().says))
        << meaning(Language::technology_box, condition);
}

INSTANTIATE_TEST_SUITE_P(
    B030, NetworkLed,
    testing::Values(NetworkRow{"Disabled", NetworkState::disabled, kDark, "disabled"},
                    NetworkRow{"BaudSearch", NetworkState::baud_search, kDark, "baud search"},
                    NetworkRow{"WaitParameterisation", NetworkState::wait_param, kShort, "parameterisation"},
                    NetworkRow{"WaitConfiguration", NetworkState::wait_config, kHalf, "configuration"},
                    NetworkRow{"DataExchangeWithError", NetworkState::data_ex_error, kLong, "with error"},
                    NetworkRow{"DataExchange", NetworkState::data_exchange, kSteady,
                               "data exchange with the master"}),
    [](const auto& row) { return std::string{row.param.name}; });

struct ModuleRow {
    const char* name;
    OptionFault fault;
    Seen module;
    const char* says;
};

class ModuleLed : public testing::TestWithParam<ModuleRow> {};

TEST_P(ModuleLed, ShowsTheRowOfTheManual)
{
    const Condition condition = with(NetworkState::disabled, GetParam().fault);

    EXPECT_EQ(lamps_of(condition).module, GetParam().module);
    EXPECT_TRUE(says(Language::technology_box, condition, GetParam().says))
        << meaning(Language::technology_box, condition);
}

TEST_P(ModuleLed, KeepsNetworkOffWhateverItsStateWhileItIsNotSteadilyOn)
{
    for (std::uint8_t number = 0; number < 6; ++number) {
        const auto state = static_cast<NetworkState>(number);
        const Seen network = lamps_of(with(state, GetParam().fault)).network;
        const Seen alone = lamps_of(with(state)).network;
        EXPECT_EQ(network, GetParam().module == kSteady ? alone : kDark) << text(state);
    }
}

INSTANTIATE_TEST_SUITE_P(
    B031, ModuleLed,
    testing::Values(ModuleRow{"Hardware", OptionFault::hardware, kDark, "hardware fault, external"},
                    ModuleRow{"SelfTest", OptionFault::self_test, kShort, "hardware fault, internal"},
                    ModuleRow{"TypeMismatch", OptionFault::type_mismatch, kHalf, "wrong type or disabled"},
                    ModuleRow{"Parameter", OptionFault::parameter, kLong, "out of range"},
                    ModuleRow{"None", OptionFault::none, kSteady, "disabled"}, // then NETWORK has the word
                    ModuleRow{"MissingHasNoPatternOfItsOwn", OptionFault::missing, kDark,
                              "no option fitted"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(HealthAndRunLeds, MirrorTheDriveWhateverTheBusAndTheBoxSay)
{
    for (const OptionFault fault : {OptionFault::none, OptionFault::type_mismatch, OptionFault::hardware})
        for (const bool health : {false, true})
            for (const bool run : {false, true}) {
                Condition condition = with(NetworkState::wait_param, fault);
                condition.health = health;
                condition.run = run;
                EXPECT_EQ(lamps_of(condition).health, health ? kSteady : kDark);
                EXPECT_EQ(lamps_of(condition).run, run ? kSteady : kDark);
            }
}

TEST(HealthAndRunLeds, AreOffWhileTheDriveIsSilent)
{
    Condition condition = with(NetworkState::data_ex_error);
    condition.health = condition.run = true;
    condition.drive_answers = false;

    EXPECT_EQ(lamps_of(condition).health, kDark);
    EXPECT_EQ(lamps_of(condition).run, kDark);
    EXPECT_EQ(lamps_of(condition).network, kLong);
}

TEST(TechnologyBoxLeds, AreAllDarkWithoutPower)
{
    Condition condition = with(NetworkState::data_exchange);
    condition.health = condition.run = true;
    condition.running = false;

    const Lamps shown = lamps_of(condition);

    for (const Seen& seen : {shown.network, shown.module, shown.health, shown.run}) EXPECT_EQ(seen, kDark);
    EXPECT_TRUE(says(Language::technology_box, condition, "no power"));
}

TEST(TechnologyBoxLeds, FlashWithAPeriodOfOneSecondThatBeginsLit)
{
    const auto network = lamps(Language::technology_box, with(NetworkState::wait_param))[0].pattern;

    EXPECT_TRUE(lit(network, at(7s)));
    EXPECT_TRUE(lit(network, at(7s + 99ms)));
    EXPECT_FALSE(lit(network, at(7s + 100ms)));
    EXPECT_FALSE(lit(network, at(7s + 999ms)));
    EXPECT_EQ(next_change(network, at(7s + 100ms)), at(8s));
}

TEST(TechnologyBoxLeds, AreCalledAsTheManualCallsThem)
{
    const auto network = [](NetworkState state) {
        return words(Language::technology_box, lamps(Language::technology_box, with(state))[0].pattern);
    };

    EXPECT_EQ(network(NetworkState::baud_search), "off");
    EXPECT_EQ(network(NetworkState::wait_param), "short flash (10 % of 1 s)");
    EXPECT_EQ(network(NetworkState::wait_config), "flash (50 % of 1 s)");
    EXPECT_EQ(network(NetworkState::data_ex_error), "long flash (90 % of 1 s)");
    EXPECT_EQ(network(NetworkState::data_exchange), "on");
}

TEST(TechnologyBoxLeds, OnIsGoodOffIsBad)
{
    const Lamps good = lamps_of({.running = true,
                                 .data_exchange = true,
                                 .fault = OptionFault::none,
                                 .network = NetworkState::data_exchange,
                                 .health = true,
                                 .run = true});

    for (const Seen& seen : {good.network, good.module, good.health, good.run}) EXPECT_EQ(seen, kSteady);
}

} // namespace
} // namespace dpslave::led
