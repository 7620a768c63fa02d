// SPDX-License-Identifier: Apache-2.0
// EI-ASCII reference, sections 1 to 4.
#include "dpsim/drive/ei_ascii.hpp"
#include "octets.hpp"

#include <gtest/gtest.h>

namespace dpslave::sim {
namespace {

SimTag number(unsigned decimals, std::int32_t min = -32768, std::int32_t max = 32767)
{
    return {.number = 55, .name = "a number", .decimals = decimals, .min = min, .max = max};
}
SimTag of(TagKind kind, std::int32_t max)
{
    return {.number = 55, .name = "another", .type = kind, .max = max};
}

TEST(EiAscii, MakesTheWorkedReplies)
{
    EXPECT_EQ(reply_frame("PV", "16.4"), wire("02 50 56 31 36 2E 34 03 18"));
    EXPECT_EQ(reply_frame("II", ">2650"), wire("02 49 49 3E 32 36 35 30 03 3C"));
    EXPECT_EQ(reply_frame("ox", ">1B0B"), wire("02 6F 78 3E 31 42 30 42 03 2B"));
    EXPECT_EQ(reply_frame("EE", ">00C0"), wire("02 45 45 3E 30 30 43 30 03 4E"));
    EXPECT_EQ(reply_frame("EE", ">01C7"), wire("02 45 45 3E 30 31 43 37 03 48"));
    EXPECT_EQ(reply_frame("EE", ">08C8"), wire("02 45 45 3E 30 38 43 38 03 4E"));
}

TEST(EiAscii, ChecksTheWorkedSelectsWhateverTheCheckLooksLike)
{
    EXPECT_EQ(block_check(wire("53 4C 32 32 2E 30 03")), 0x02);    // SL22.0: the check is STX
    EXPECT_EQ(block_check(wire("37 6A 3E 30 34 37 46 03")), 0x15); // 7j>047F: the check is NAK
    EXPECT_EQ(block_check(wire("39 6F 33 30 2E 03")), 0x78);
    EXPECT_EQ(block_check(wire("6F 77 3E 30 32 30 33 03")), 0x24);
}

TEST(EiAscii, NamesTagsByTheRuleOfThe590)
{
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 0), "a0");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 12), "ac");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 55), "bj");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 56), "bk");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 130), "dm");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 198), "fi");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 288), "i0");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 536), "ow");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 537), "ox");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 559), "pj");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 935), "zz");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 936), "aA");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 937), "aB");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 961), "aZ");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 962), "bA");
}

TEST(EiAscii, ReachesParameterNumbersAsTags1000To1127)
{
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 1039), "27");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 1015), "0F");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 1127), "7F");
    EXPECT_EQ(mnemonic_of(Rule::dc_590plus, 1128), "hK");
}

TEST(Mnemonics, OfAcDrivesHaveARuleOfTheirOwn)
{
    EXPECT_EQ(model_of("605"), Model::ac);
    EXPECT_EQ(model_of("584sv"), Model::ac);
    EXPECT_EQ(model_of("690plus"), Model::ac);
    EXPECT_EQ(mnemonic_of(Rule::ac, 0), "00");
    EXPECT_EQ(mnemonic_of(Rule::ac, 35), "0z");
    EXPECT_EQ(mnemonic_of(Rule::ac, 36), "10");
    EXPECT_EQ(mnemonic_of(Rule::ac, 255), "73");
    EXPECT_EQ(mnemonic_of(Rule::ac, 269), "7h");
    EXPECT_EQ(mnemonic_of(Rule::ac, 271), "7j");
    EXPECT_EQ(mnemonic_of(Rule::ac, 272), "7k");
    EXPECT_EQ(mnemonic_of(Rule::ac, 348), "9o");
    EXPECT_EQ(mnemonic_of(Rule::ac, 1000), "rs") << "no PNO there";
    EXPECT_EQ(mnemonic_of(Rule::ac, 1295), "zz");
    EXPECT_EQ(mnemonic_of(Rule::ac, 1296), "aA");
    EXPECT_EQ(mnemonic_of(Rule::ac, 1297), "bA") << "the letter that runs fast comes first";
    EXPECT_EQ(mnemonic_of(Rule::ac, 1321), "zA");
    EXPECT_EQ(mnemonic_of(Rule::ac, 1322), "aB");
    EXPECT_EQ(mnemonic_of(Rule::ac, 1972), "");
}

TEST(Mnemonics, OfParameterNumbersAreTheirHexadecimalForm)
{
    EXPECT_EQ(mnemonic_of(Rule::pno, 39), "27");
    EXPECT_EQ(mnemonic_of(Rule::pno, 15), "0F");
    EXPECT_EQ(mnemonic_of(Rule::pno, 127), "7F");
    EXPECT_EQ(mnemonic_of(Rule::pno, 128), "") << "there is no PNO 128";
    EXPECT_EQ(mnemonic_of(Rule::pno, 288), "");
    EXPECT_EQ(mnemonic_of(Rule::pno, 1000), "00");
    EXPECT_EQ(mnemonic_of(Rule::pno, 1128), "");
}

TEST(Mnemonics, ThatAreChosenCountWhateverTheTableSays)
{
    const SimTag plain{.number = 55}, named{.number = 56, .mnemonic = "xy"};
    EXPECT_EQ(Naming{Model::dc590}.name(plain), "bj");
    EXPECT_EQ(Naming{Model::dc590}.name(named), "xy");
    EXPECT_EQ(Naming{Rule::ac}.name(named), "1k");
    const Naming rows{*parse_tags("tag,mnemonic\n55,Q1\n", "rows.csv")};
    EXPECT_EQ(rows.name(plain), "Q1");
    EXPECT_EQ(rows.name(named), "") << "these rows have no tag 56";
}

TEST(EiAscii, SendsNumbersWithoutNeedlessZerosButWithThePoint)
{
    EXPECT_EQ(drive_text(Model::dc590, number(2), {3000}), "30.");
    EXPECT_EQ(drive_text(Model::dc590, number(2), {-30000}), "-300.");
    EXPECT_EQ(drive_text(Model::dc590, number(2), {-5}), "-0.05");
    EXPECT_EQ(drive_text(Model::dc590, number(2), {1250}), "12.5");
    EXPECT_EQ(drive_text(Model::dc590, number(0), {700}), "700.");
    EXPECT_EQ(drive_text(Model::dc590, number(4), {0}), "0.");
}

TEST(EiAscii, SendsEnumerationsInTheFormOfTheModel)
{
    EXPECT_EQ(drive_text(Model::dc590, of(TagKind::enumeration, 255), {3}), ">03");
    EXPECT_EQ(drive_text(Model::dc620, of(TagKind::enumeration, 255), {3}), ">03");
    EXPECT_EQ(drive_text(Model::ac584s, of(TagKind::enumeration, 255), {3}), "3.");
}

TEST(EiAscii, SendsWordsWithFourDigitsAndBooleansWithTwo)
{
    EXPECT_EQ(drive_text(Model::dc590, of(TagKind::word, 0xFFFF), {0x0203}), ">0203");
    EXPECT_EQ(drive_text(Model::dc590, of(TagKind::boolean, 1), {1}), ">01");
}

TEST(EiAscii, TakesNumbersOnlyWithAPoint)
{
    EXPECT_EQ(drive_value(Model::dc590, number(2), "12.5")->counts, 1250);
    EXPECT_EQ(drive_value(Model::dc590, number(2), "-0.05")->counts, -5);
    EXPECT_EQ(drive_value(Model::dc590, number(2), "012.500")->counts, 1250);
    EXPECT_EQ(drive_value(Model::dc590, number(0), "7.")->counts, 7);
    for (const char* const wrong :
         {"12", "12.505", "1.2.3", "", ".", "-", "123456.", "1e3.", ">0001", "12.5 "})
        EXPECT_EQ(drive_value(Model::dc590, number(2), wrong).error(), Ee::invalid_data) << wrong;
}

TEST(EiAscii, KeepsTheLimitsOfTheTable)
{
    EXPECT_EQ(drive_value(Model::dc590, number(2, -10500, 10500), "105.")->counts, 10500);
    EXPECT_EQ(drive_value(Model::dc590, number(2, -10500, 10500), "105.01").error(), Ee::out_of_range);
    EXPECT_EQ(drive_value(Model::dc590, number(0, 0, 65535), "65535.")->counts, 65535);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::boolean, 1), ">02").error(), Ee::out_of_range);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::enumeration, 3), ">04").error(), Ee::out_of_range);
}

TEST(EiAscii, TakesShortHexadecimalWords)
{
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::word, 0xFFFF), ">0")->counts, 0);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::word, 0xFFFF), ">20B")->counts, 0x20B);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::word, 0xFFFF), ">").error(), Ee::invalid_data);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::word, 0xFFFF), ">12345").error(), Ee::invalid_data);
}

TEST(EiAscii, TakesADecimalEnumerationOnlyWhereTheModelMayHaveOne)
{
    EXPECT_EQ(drive_value(Model::ac584s, of(TagKind::enumeration, 3), "2.")->counts, 2);
    EXPECT_EQ(drive_value(Model::ac584s, of(TagKind::enumeration, 3), ">02")->counts, 2);
    EXPECT_EQ(drive_value(Model::dc590, of(TagKind::enumeration, 3), "2.").error(), Ee::invalid_data);
}

} // namespace
} // namespace dpslave::sim
