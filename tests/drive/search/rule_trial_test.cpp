// SPDX-License-Identifier: Apache-2.0
// Under which rule of the mnemonics how many tags answer.
#include "dpslave/drive/rule_trial.hpp"

#include <gmock/gmock.h>

namespace dpslave::drive {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = Sight::Kind;

constexpr LineProtocol kByEi = LineProtocol::ei_ascii;
constexpr LineProtocol kByModbus = LineProtocol::modbus_rtu;

/// The mnemonics of EI-ASCII reference, section 3, written by hand.
std::map<Look, Kind> answers(const std::vector<std::pair<std::string, Kind>>& all)
{
    std::map<Look, Kind> sights;
    for (const auto& [mnemonic, kind] : all) sights[{{mnemonic[0], mnemonic[1]}, 0}] = kind;
    return sights;
}

std::vector<std::string> asked(const RuleTrial& trial)
{
    std::vector<std::string> all;
    for (const Look& one : trial.questions(kByEi)) all.emplace_back(one.mnemonic.begin(), one.mnemonic.end());
    return all;
}

Tag named(std::uint16_t number, const std::string& mnemonic)
{
    Tag tag = unlisted_tag(number);
    tag.mnemonic = mnemonic;
    return tag;
}

TEST(RuleTrial, AsksEachMnemonicOfEachRuleOnce)
{
    // 590plus: 55 = bj, 415 = lj; ac: 55 = 1j, 415 = bj; pno: 55 = 37, 415 has none.
    const RuleTrial trial{{unlisted_tag(55), unlisted_tag(415)}, known_rules()};

    EXPECT_THAT(asked(trial), ElementsAre("1j", "37", "bj", "lj"));
}

TEST(RuleTrial, TalliesATagUnderEachRule)
{
    const RuleTrial trial{{unlisted_tag(55), unlisted_tag(415)}, known_rules()};
    const auto tallies = trial.tally(
        kByEi,
        answers({{"37", Kind::value}, {"1j", Kind::denied}, {"bj", Kind::silence}, {"lj", Kind::damaged}}));

    ASSERT_EQ(tallies.size(), 3U) << "no tag has a mnemonic of its own: rule none says nothing";
    EXPECT_EQ(tallies[0].rule, MnemonicRule::dc_590plus);
    EXPECT_THAT(tallies[0].silent, ElementsAre(55, 415));
    EXPECT_THAT(tallies[1].denied, ElementsAre(55));
    EXPECT_THAT(tallies[1].silent, ElementsAre(415));
    EXPECT_THAT(tallies[2].answering, ElementsAre(55));
    EXPECT_EQ(tallies[2].nameless, 1U);
    EXPECT_THAT(best_rules(tallies), ElementsAre(MnemonicRule::pno));
}

TEST(RuleTrial, KeepsTheMnemonicsOfTheTableApartFromTheRules)
{
    const RuleTrial trial{{named(55, "SP"), unlisted_tag(56)}, known_rules()};
    const auto tallies = trial.tally(kByEi, answers({{"SP", Kind::value}, {"bk", Kind::value}}));

    ASSERT_EQ(tallies.size(), 4U);
    EXPECT_EQ(tallies[3].rule, MnemonicRule::none);
    EXPECT_THAT(tallies[3].answering, ElementsAre(55));
    EXPECT_THAT(best_rules(tallies), ElementsAre(MnemonicRule::dc_590plus, MnemonicRule::none));
}

TEST(RuleTrial, SaysThatNothingFitsWhereNoTagAnswers)
{
    const RuleTrial trial{{unlisted_tag(55)}, known_rules()};

    EXPECT_THAT(best_rules(trial.tally(kByEi, answers({{"bj", Kind::denied}}))), IsEmpty());
}

TEST(RuleTrial, AsksRegistersOnModbusAndNoString)
{
    Tag moved = unlisted_tag(2), text = unlisted_tag(3);
    moved.modbus_register = 300;
    text.type = TagType::string;
    const RuleTrial trial{{unlisted_tag(1), moved, text}, known_rules()};

    EXPECT_THAT(trial.questions(kByModbus), ElementsAre(Look{{}, 1}, Look{{}, 300}));
    const auto tallies = trial.tally(kByModbus, {{{{}, 1}, Kind::value}, {{{}, 300}, Kind::denied}});
    ASSERT_EQ(tallies.size(), 1U);
    EXPECT_THAT(tallies[0].answering, ElementsAre(1));
    EXPECT_THAT(tallies[0].denied, ElementsAre(2));
}

/// A drive with tags 0 to 400 and, of a 590+ and a 590, the PNO 0 to 127, that answers to nothing else.
class UsualTags : public testing::Test {
protected:
    std::vector<MnemonicRule> best_for(const std::function<bool(const std::string&)>& has)
    {
        const RuleTrial trial{usual_trial_tags(), known_rules()};
        std::map<Look, Kind> sights;
        for (const Look& one : trial.questions(kByEi))
            sights[one] = has({one.mnemonic.begin(), one.mnemonic.end()}) ? Kind::value : Kind::denied;
        return best_rules(trial.tally(kByEi, sights));
    }
    static bool is_pno(const std::string& name)
    {
        return name[0] >= '0' && name[0] <= '7' &&
               std::string{"0123456789ABCDEF"}.find(name[1]) != std::string::npos;
    }
    static bool is_letter(char c) { return c >= 'a' && c <= 'z'; }
    static bool is_small(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }
};

TEST_F(UsualTags, TellTheRulesApart)
{
    // By the table of EI-ASCII reference, section 3: AC drives 0 = 00 to 359 = 9z; 590+ 0 = a0 to 359 = jz.
    EXPECT_THAT(best_for([](auto& name) { return name[0] <= '9' && is_small(name[1]); }),
                ElementsAre(MnemonicRule::ac));
    EXPECT_THAT(best_for([](auto& name) {
                    return is_pno(name) || (is_letter(name[0]) && name[0] <= 'j' && is_small(name[1]));
                }),
                ElementsAre(MnemonicRule::dc_590plus));
    EXPECT_THAT(best_for([](auto& name) { return is_pno(name); }), ElementsAre(MnemonicRule::pno));
}

TEST(SampleOfATable, TakesRowsFromItsBeginToItsEnd)
{
    std::vector<Tag> rows;
    for (std::uint16_t i = 1; i <= 10; ++i) rows.push_back(unlisted_tag(i));
    const TagTable table{rows};

    std::vector<int> numbers;
    for (const Tag& tag : sample_of(table, 5)) numbers.push_back(tag.number);
    EXPECT_THAT(numbers, ElementsAre(1, 3, 5, 7, 9));
    EXPECT_EQ(sample_of(table, 24).size(), 10U);
    EXPECT_THAT(sample_of(TagTable{}, 5), IsEmpty());
}

} // namespace
} // namespace dpslave::drive
