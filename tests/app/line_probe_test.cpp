// SPDX-License-Identifier: Apache-2.0
// The search of `dpctl doctor --probe`. Its plan and its judgement: tests/drive/search.
#include "app/line/line_probe.hpp"
#include "app/links/probe_report.hpp"

#include <gmock/gmock.h>

namespace dpslave::app {
namespace {

using drive::MnemonicRule;
using drive::Sight;
using testing::ElementsAre;

config::LineConfig line(std::string_view protocol, std::uint32_t baud)
{
    config::LineConfig config;
    config.protocol = protocol;
    config.baud = baud;
    if (protocol == config::kModbusRtu) config.format = {8, 'N', 1};
    return config;
}

config::StationConfig station(std::vector<drive::Tag> rows)
{
    config::StationConfig config;
    config.unit = {.group = 0, .unit = 5};
    config.tags = std::make_shared<drive::TagTable>(std::move(rows));
    return config;
}

TEST(LineProbe, BeginsWithTheSettingsOfTheLineAndTheUnitOfTheStation)
{
    for (const std::string_view protocol : {config::kEiAscii, config::kModbusRtu}) {
        const auto first = probe_search(line(protocol, 19200), station({}), {}).next();

        ASSERT_TRUE(first);
        EXPECT_EQ(drive::name(first->setting.protocol), protocol);
        EXPECT_EQ(first->setting.baud, 19200U);
        EXPECT_EQ(first->unit, (drive::UnitAddress{.group = 0, .unit = 5}));
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

TEST(LineProbe, TakesAFewMinutesAtMost)
{
    for (const std::string_view protocol : {config::kEiAscii, config::kModbusRtu})
        EXPECT_LE(probe_search(line(protocol, 9600), station({}), {}).longest(), std::chrono::minutes{4});
}

TEST(LineProbe, ReportsUnderWhichRuleTheTagsOfTheStationAnswer)
{
    drive::LineSearch search = probe_search(line(config::kEiAscii, 9600),
                                            station({drive::unlisted_tag(55), drive::unlisted_tag(56)}), {});
    // The drive follows the rule of the AC drives: 55 is 1j, 56 is 1k.
    while (const auto question = search.next()) {
        const std::string mnemonic{question->look.mnemonic.begin(), question->look.mnemonic.end()};
        const bool is_this = question->unit.unit == 5 && question->unit.group == 0;
        if (is_this && (mnemonic == "II" || mnemonic == "1j" || mnemonic == "1k"))
            search.take({Sight::Kind::value, ">2650"});
        else
            search.take({is_this ? Sight::Kind::denied : Sight::Kind::silence, {}});
    }
    ProbeReport report;
    put_found(search, report);

    ASSERT_EQ(report.count, 1U);
    const drive::FoundUnit found = found_of(report.answers[0]);
    EXPECT_EQ(found.identity, ">2650");
    EXPECT_EQ(found.version, std::nullopt);
    EXPECT_THAT(drive::best_rules(found.rules), ElementsAre(MnemonicRule::ac));
    ASSERT_EQ(found.rules.size(), 3U);
    EXPECT_THAT(found.rules[0].denied, ElementsAre(55, 56));
    EXPECT_THAT(found.rules[1].answering, ElementsAre(55, 56));
}

} // namespace
} // namespace dpslave::app
