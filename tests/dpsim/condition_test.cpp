// SPDX-License-Identifier: Apache-2.0
// Tests what a script can ask for, and where the process words lie (HA389815 chapter 6).
#include "dpsim/common/values.hpp"
#include "dpsim/master/condition.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

MasterSettings option_board()
{
    MasterSettings s;
    s.cfg = wire("73 50 60 50");
    return s;
}

TEST(Conditions, AreReadWithAndWithoutBlanks)
{
    for (const char* const text : {"in 1 = 1250", "in1=1250", "in1 = 1250"}) {
        const auto c = parse_condition(words_of(text));
        ASSERT_TRUE(c) << c.error();
        EXPECT_EQ(c->subject, Condition::Subject::input);
        EXPECT_EQ(c->index, 1U);
        EXPECT_EQ(c->value, 1250);
    }
    EXPECT_EQ(parse_condition(words_of("in 2 >= -5"))->relation, ">=");
    EXPECT_TRUE(parse_condition(words_of("state not data-exchange"))->negated);
    EXPECT_EQ(parse_condition(words_of("diag 00 0C"))->octets, wire("00 0C"));
    EXPECT_EQ(parse_condition(words_of("diag not cfg-fault"))->name, "cfg-fault");
}

TEST(Conditions, ThatMakeNoSenseAreExplained)
{
    EXPECT_THAT(parse_condition({}).error(), HasSubstr("missing"));
    EXPECT_THAT(parse_condition(words_of("in 0 = 5")).error(), HasSubstr("in 1 = 1250"));
    EXPECT_THAT(parse_condition(words_of("in 1 ~ 5")).error(), HasSubstr("in 1 = 1250"));
    EXPECT_THAT(parse_condition(words_of("state happy")).error(), HasSubstr("no state 'happy'"));
    EXPECT_THAT(parse_condition(words_of("weather fine")).error(), HasSubstr("no condition"));
    EXPECT_THAT(parse_condition(words_of("diag sunshine")).error(), HasSubstr("neither"));
}

TEST(Conditions, LookAtTheBitsOfAMask)
{
    for (const char* const text : {"in 2 & 0x1000 = 0", "in2&0x1000=0"}) {
        const auto c = parse_condition(words_of(text));
        ASSERT_TRUE(c) << c.error();
        EXPECT_EQ(c->index, 2U);
        EXPECT_EQ(c->mask, 0x1000);
        EXPECT_EQ(c->value, 0);
    }
    const auto demand = parse_condition(words_of("demand reg 4 & 0x1008 != 0"));
    ASSERT_TRUE(demand) << demand.error();
    EXPECT_EQ(demand->subject, Condition::Subject::demand_register);
    EXPECT_EQ(demand->index, 4U);
    EXPECT_EQ(demand->mask, 0x1008);
    EXPECT_EQ(demand->relation, "!=");
    EXPECT_THAT(parse_condition(words_of("in 1 & = 0")).error(), HasSubstr("& 0x1000"));
    EXPECT_THAT(parse_condition(words_of("in 1 & 0 = 0")).error(), HasSubstr("& 0x1000"));
}

TEST(Conditions, AskForWholeRegistersOfDemandData)
{
    EXPECT_EQ(parse_condition(words_of("demand reg 1 = 4366"))->value, 4366);
    for (const char* const wrong : {"demand reg 0 = 1", "demand reg 5 = 1", "demand reg 1",
                                    "demand reg 1 ~ 5", "demand reg 1 = x", "demand reject", "demand"})
        EXPECT_THAT(parse_condition(words_of(wrong)).error(), HasSubstr("demand reg 1 = 4366")) << wrong;
}

TEST(Conditions, AskForTheExtendedPartOfTheDiagnosisAsAWhole)
{
    const auto c = parse_condition(words_of("diag ext 03 40 30"));
    ASSERT_TRUE(c) << c.error();
    EXPECT_EQ(c->subject, Condition::Subject::extended_diagnosis);
    EXPECT_EQ(c->octets, wire("03 40 30"));
    EXPECT_FALSE(parse_condition(words_of("diag ext")));
}

TEST(Process, WordsLieBehindDemandData)
{
    Master master{option_board()};
    set_demand_outputs(master, {0x2038, 0, 0, 1000});
    set_output_word(master, 1, 0x8AD0);
    EXPECT_EQ(hex(master.outputs()), "20 38 00 00 00 00 03 E8 8A D0");
    EXPECT_EQ(input_words(master), 2U);
    EXPECT_EQ(output_words(master), 1U);
    EXPECT_FALSE(set_output_word(master, 2, 0));
}

TEST(Process, WordsOfBothDirectionsAreOneIdentifier)
{
    MasterSettings s;
    s.cfg = wire("70 60 50 70");
    Master master{s};
    EXPECT_EQ(input_words(master), 3U);
    EXPECT_EQ(output_words(master), 3U);
    EXPECT_TRUE(set_output_word(master, 3, 0x1234));
    EXPECT_EQ(hex(master.outputs()), "00 00 00 00 12 34");
}

TEST(Values, AreReadAsPeopleWriteThem)
{
    EXPECT_EQ(read_number("-300"), -300);
    EXPECT_EQ(read_number("0x04E2"), 1250);
    EXPECT_EQ(read_number("12a"), std::nullopt);
    EXPECT_EQ(*octets_of("6805 05,68"), wire("68 05 05 68"));
    EXPECT_FALSE(octets_of("680"));
    EXPECT_FALSE(octets_of("zz"));
    EXPECT_EQ(words_of("  out 1 = 5 # five"), (std::vector<std::string>{"out", "1", "=", "5"}));
    EXPECT_EQ(show_word(0x8AD0), "-30000 (0x8AD0)");
}

} // namespace
} // namespace dpslave::sim
