// SPDX-License-Identifier: Apache-2.0
// The search for drives on a line of which nothing is known: the plan, its length, and what is made of the
// answers.
#include "dpslave/drive/line_search.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <set>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using Kind = Sight::Kind;

constexpr LineProtocol kEi = LineProtocol::ei_ascii;
constexpr LineProtocol kModbus = LineProtocol::modbus_rtu;
constexpr LineSetting kUsual{kEi, 9600, {7, 'E', 1}};
constexpr UnitAddress k00{0, 0}, k01{0, 1}, k05{0, 5};

bool has(const std::vector<UnitAddress>& units, UnitAddress unit)
{
    return std::find(units.begin(), units.end(), unit) != units.end();
}

RuleTrial no_tags()
{
    return {{}, known_rules()};
}

/// What a line answers to each question; each one that was asked.
struct Line {
    std::function<Sight(const SearchQuestion&)> answer = [](const SearchQuestion&) { return Sight{}; };
    std::vector<SearchQuestion> asked;

    void carry_out(LineSearch& search)
    {
        while (const auto question = search.next()) {
            asked.push_back(*question);
            search.take(answer(*question));
        }
    }
    std::vector<std::string> mnemonics_asked() const
    {
        std::vector<std::string> all;
        for (const SearchQuestion& one : asked)
            all.emplace_back(one.look.mnemonic.begin(), one.look.mnemonic.end());
        return all;
    }
};

std::string mnemonic(const SearchQuestion& question)
{
    return {question.look.mnemonic.begin(), question.look.mnemonic.end()};
}

std::vector<SearchTry> only(std::vector<UnitAddress> units, LineSetting setting = kUsual)
{
    return {{setting, std::move(units), {}}};
}

// ---- the plan

TEST(SearchPlan, AsksTheFirstUnitsAtEverySettingBeforeAnyOther)
{
    const auto plan = search_plan({});
    std::set<std::pair<LineProtocol, std::pair<std::uint32_t, std::string>>> seen;
    std::size_t i = 0;
    for (; i < plan.size() && plan[i].units.size() <= 2; ++i)
        EXPECT_TRUE(
            seen.insert({plan[i].setting.protocol, {plan[i].setting.baud, text(plan[i].setting.format)}})
                .second);

    EXPECT_EQ(plan[0].setting, kUsual);
    EXPECT_THAT(plan[0].units, ElementsAre(k00, k01));
    EXPECT_EQ(seen.size(), 48U) << "eight rates, three formats, two protocols";
    EXPECT_TRUE(has(plan[i].units, {7, 15}));
    EXPECT_FALSE(has(plan[i].units, k00)) << "it was asked before";
}

TEST(SearchPlan, IsNarrowedByEachOption)
{
    SearchScope scope;
    scope.protocols = {kEi, kModbus};
    scope.bauds = {19200};
    scope.formats = {{7, 'E', 1}, {8, 'N', 1}};
    scope.units = {{kEi, {k05}}, {kModbus, {k05}}};

    const auto plan = search_plan(scope);

    ASSERT_EQ(plan.size(), 3U) << "Modbus has no 7E1";
    for (const SearchTry& one : plan) {
        EXPECT_EQ(one.setting.baud, 19200U);
        EXPECT_THAT(one.units, ElementsAre(k05));
        EXPECT_THAT(one.rest, IsEmpty());
    }
}

TEST(SearchPlan, OfModbusWithSevenBitsIsEmpty)
{
    SearchScope scope;
    scope.protocols = {kModbus};
    scope.formats = {{7, 'E', 1}};

    EXPECT_THAT(search_plan(scope), IsEmpty());
}

TEST(SearchPlan, NearALineBeginsWithItsOwnSettingAndNeverAsksTheDrivesOfOthers)
{
    const LineSetting own{kEi, 19200, {7, 'E', 1}};
    const auto plan = search_near(own, {2, 3}, {k01});

    EXPECT_EQ(plan[0].setting, own);
    EXPECT_EQ(plan[0].units.front(), (UnitAddress{2, 3}));
    EXPECT_TRUE(has(plan[0].units, {7, 15}));
    EXPECT_FALSE(has(plan[0].units, k01));
    EXPECT_EQ(plan.size(), 24U);
    EXPECT_THAT(plan[1].units, ElementsAre(UnitAddress{2, 3}, k00));
}

// ---- its length

TEST(LineSearch, OnASilentLineAsksEachUnitOnceAndLessThanItSaid)
{
    LineSearch search{search_plan({}), RuleTrial{usual_trial_tags(), known_rules()}, 200ms};
    Line line;
    line.carry_out(search);

    std::set<std::string> questions;
    for (const SearchQuestion& one : line.asked)
        EXPECT_TRUE(questions
                        .insert(std::string{name(one.setting.protocol)} + std::to_string(one.setting.baud) +
                                text(one.setting.format) + unit_text(one.setting.protocol, one.unit))
                        .second);
    EXPECT_EQ(search.asked(), line.asked.size());
    EXPECT_LT(search.asked(), search.most());
    EXPECT_GT(search.longest(), line.asked.size() * 200ms);
    EXPECT_THAT(search.found(), IsEmpty());
}

TEST(LineSearch, NeverAsksMoreThanItSaidWhateverAnswers)
{
    const RuleTrial trial{usual_trial_tags(), known_rules()};
    for (const Kind always : {Kind::value, Kind::denied, Kind::damaged}) {
        LineSearch search{search_plan({}), trial, 200ms};
        Line line;
        line.answer = [&](const SearchQuestion&) { return Sight{always, ">0590"}; };
        line.carry_out(search);
        EXPECT_LE(search.asked(), search.most());
        EXPECT_EQ(search.is_full(), always != Kind::damaged);
    }
}

TEST(LineSearch, CountsTheTagsOfEachRuleAndTheSecondQuestionsAtASlowRate)
{
    LineSearch bare{only({k00}), no_tags(), 100ms, {.units = 0, .trials = 0}};
    LineSearch slow{only({k00}, {kEi, 300, {7, 'E', 1}}), no_tags(), 100ms, {.units = 0, .trials = 0}};
    LineSearch tags{only({k00}),
                    RuleTrial{{unlisted_tag(55), unlisted_tag(56)}, known_rules()},
                    100ms,
                    {.units = 1, .trials = 1}};

    EXPECT_EQ(bare.most(), 1U);
    EXPECT_EQ(bare.longest(), 1s);
    EXPECT_EQ(slow.longest(), 2s) << "40 characters of 11 bits are 1467 ms";
    EXPECT_EQ(tags.most(), 1U + 6U + 6U) << "three rules, two tags";
}

// ---- who answers

TEST(LineSearch, CountsAUnitOnlyWhenTwoQuestionsAreAnswered)
{
    LineSearch search{only({k00, k01}), no_tags(), 200ms};
    Line line;
    bool first = true;
    line.answer = [&](const SearchQuestion& one) {
        if (one.unit == k00) return Sight{std::exchange(first, false) ? Kind::value : Kind::silence, ">2650"};
        return Sight{Kind::value, mnemonic(one) == "V0" ? ">0304" : ">2650"};
    };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 1U);
    EXPECT_EQ(search.found()[0].unit, k01);
    EXPECT_EQ(search.found()[0].identity, ">2650");
    EXPECT_EQ(search.found()[0].version, ">0304");
    EXPECT_EQ(search.unsure(), 1U);
    EXPECT_THAT(line.mnemonics_asked(), ElementsAre("II", "II", "II", "II", "V0"));
}

TEST(LineSearch, AsksADriveThatRefusesIIForEE)
{
    LineSearch search{only({k00}), no_tags(), 200ms};
    Line line;
    line.answer = [](const SearchQuestion& one) {
        return mnemonic(one) == "EE" ? Sight{Kind::value, ">01C7"} : Sight{Kind::denied, {}};
    };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 1U);
    EXPECT_EQ(search.found()[0].identity, std::nullopt);
    EXPECT_EQ(search.found()[0].version, std::nullopt);
    EXPECT_THAT(line.mnemonics_asked(), ElementsAre("II", "EE", "EE", "V0"));
}

TEST(LineSearch, FindsAnInstrumentThatHasNothingButItsValue)
{
    LineSearch search{only({k00}), no_tags(), 200ms};
    Line line;
    line.answer = [](const SearchQuestion& one) {
        return mnemonic(one) == "PV" ? Sight{Kind::value, "16.4"} : Sight{Kind::denied, {}};
    };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 1U);
    EXPECT_EQ(search.found()[0].identity, std::nullopt) << "a value is no identity";
    EXPECT_THAT(line.mnemonics_asked(), ElementsAre("II", "EE", "V0", "0F", "PV", "PV", "V0"));
    EXPECT_LE(search.asked(), search.most());
}

TEST(LineSearch, HoldsALoneEotForNoDrive)
{
    LineSearch search{only({k00}), no_tags(), 200ms};
    Line line;
    line.answer = [](const SearchQuestion&) { return Sight{Kind::denied, {}}; };
    line.carry_out(search);

    EXPECT_THAT(search.found(), IsEmpty());
    EXPECT_EQ(search.unsure(), 1U);
}

TEST(LineSearch, LooksForMoreUnitsWhereOneAnswersAndThenAtNoOtherSetting)
{
    LineSearch search{search_plan({}), no_tags(), 200ms};
    Line line;
    const LineSetting real{kEi, 19200, {7, 'E', 1}};
    line.answer = [&](const SearchQuestion& one) {
        const bool is_there = one.setting == real && (one.unit == k01 || one.unit == UnitAddress{3, 4});
        return is_there ? Sight{Kind::value, ">0590"} : Sight{};
    };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 2U);
    EXPECT_EQ(search.found()[0].setting, real);
    EXPECT_EQ(search.found()[1].unit, (UnitAddress{3, 4}));
    EXPECT_EQ(line.asked.back().setting, real);
}

TEST(LineSearch, FindsAUnitThatIsNoneOfTheFirst)
{
    LineSearch search{search_plan({}), no_tags(), 200ms};
    Line line;
    line.answer = [&](const SearchQuestion& one) {
        const bool is_there = one.setting == LineSetting{kModbus, 38400, {8, 'O', 1}} && one.unit.unit == 17;
        return is_there ? Sight{Kind::denied, "exception 2"} : Sight{};
    };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 1U) << "an exception names its unit";
    EXPECT_EQ(search.found()[0].identity, std::nullopt);
}

TEST(LineSearch, ReadsTheIdentityOfModbusWhereTheManualsHaveIt)
{
    struct Case {
        std::uint16_t at;
        const char* word;
        std::uint16_t version;
        std::optional<std::string> identity;
    };
    for (const Case& one : {Case{122, ">2480", 107, ">2480"}, Case{9901, ">2650", 9902, ">2650"},
                            Case{122, ">1234", 107, std::nullopt}}) {
        LineSearch search{only({{0, 1}}, {kModbus, 9600, {8, 'N', 1}}), no_tags(), 200ms};
        Line line;
        line.answer = [&](const SearchQuestion& question) {
            if (question.look.reg == one.at) return Sight{Kind::value, one.word};
            if (question.look.reg == one.version) return Sight{Kind::value, ">0304"};
            return Sight{Kind::denied, "exception 2"};
        };
        line.carry_out(search);
        ASSERT_EQ(search.found().size(), 1U);
        EXPECT_EQ(search.found()[0].identity, one.identity);
        EXPECT_EQ(search.found()[0].version.has_value(), one.identity.has_value())
            << "where the version of an unknown device is, nobody knows";
    }
}

TEST(LineSearch, AsksTheFirstUnitsOnlyForTags)
{
    LineSearch search{only({k00, k01}),
                      RuleTrial{{unlisted_tag(55)}, {MnemonicRule::ac}},
                      200ms,
                      {.units = 16, .trials = 1}};
    Line line;
    line.answer = [](const SearchQuestion&) { return Sight{Kind::value, "1."}; };
    line.carry_out(search);

    ASSERT_EQ(search.found().size(), 2U);
    EXPECT_TRUE(search.found()[0].tags_asked);
    EXPECT_THAT(search.found()[0].rules[0].answering, ElementsAre(55));
    EXPECT_FALSE(search.found()[1].tags_asked);
}

TEST(LineSearch, ThatIsEndedEarlySaysWhichTagsWereNotAsked)
{
    LineSearch search{only({k00}), RuleTrial{{unlisted_tag(55), unlisted_tag(56)}, {MnemonicRule::ac}},
                      200ms};
    for (int i = 0; i < 4; ++i) search.take({Kind::value, "1."}); // II twice, V0, the first tag

    ASSERT_EQ(search.found().size(), 1U);
    EXPECT_THAT(search.found()[0].rules[0].answering, ElementsAre(55));
    EXPECT_THAT(search.found()[0].rules[0].unasked, ElementsAre(56));
}

TEST(Identity, IsNamedAsTheManualsHaveItAndNeverGuessed)
{
    EXPECT_EQ(identity_words(">2650"), "650V, frames C to F");
    EXPECT_EQ(identity_words(">2480"), "2400 series, 1/8 DIN, PID or on/off");
    EXPECT_EQ(identity_words(">2242"), "2200 series, 1/4 DIN, valve positioner");
    for (const char* unknown : {">0590", ">2580", ">2490", ">2481", "2480", "", ">24800"})
        EXPECT_EQ(identity_words(unknown), "") << unknown;
}

TEST(LineSetting, IsReadAndWrittenAsInTheConfiguration)
{
    EXPECT_EQ(text(*format_of("8O2")), "8O2");
    for (const char* wrong : {"", "7E", "9N1", "7X1", "7E3", "7E1 "}) EXPECT_FALSE(format_of(wrong)) << wrong;
    EXPECT_EQ(unit_text(kEi, *unit_of(kEi, "1a")), "1A");
    EXPECT_EQ(unit_text(kModbus, *unit_of(kModbus, "247")), "247");
    for (const char* wrong : {"", "0", "000", "1G", "0x"}) EXPECT_FALSE(unit_of(kEi, wrong)) << wrong;
    for (const char* wrong : {"", "0", "248", "1A", "0x1", "-1"})
        EXPECT_FALSE(unit_of(kModbus, wrong)) << wrong;
}

} // namespace
} // namespace dpslave::drive
