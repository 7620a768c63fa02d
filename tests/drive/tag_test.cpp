// SPDX-License-Identifier: Apache-2.0
#include "dpslave/drive/tag.hpp"

#include <gtest/gtest.h>

#include <set>

namespace dpslave::drive {
namespace {

std::string by_rule(int number, MnemonicRule rule)
{
    const auto mnemonic = mnemonic_by_rule(static_cast<std::uint16_t>(number), rule);
    return mnemonic ? std::string{(*mnemonic)[0], (*mnemonic)[1]} : std::string{"none"};
}

Tag number_tag(unsigned decimals)
{
    Tag tag;
    tag.type = TagType::number;
    tag.decimals = static_cast<std::uint8_t>(decimals);
    return tag;
}

Tag typed(TagType type)
{
    Tag tag;
    tag.type = type;
    return tag;
}

TEST(Mnemonic, OfAnAcDriveIsTheTagInBase36AndThenTwoLetters)
{
    const std::pair<int, const char*> examples[] = {
        {0, "00"},    {9, "09"},    {10, "0a"},   {35, "0z"},   {36, "10"},   {255, "73"},
        {258, "76"},  {259, "77"},  {269, "7h"},  {270, "7i"},  {271, "7j"},  {272, "7k"},
        {273, "7l"},  {300, "8c"},  {348, "9o"},  {359, "9z"},  {360, "a0"},  {1158, "w6"},
        {1295, "zz"}, {1296, "aA"}, {1297, "bA"}, {1321, "zA"}, {1322, "aB"},
    };
    for (const auto& [tag, mnemonic] : examples) EXPECT_EQ(by_rule(tag, MnemonicRule::ac), mnemonic) << tag;
}

TEST(Mnemonic, OfA590PlusBeginsWithALetterSoThatItNeverMeetsAPno)
{
    const std::pair<int, const char*> examples[] = {
        {0, "a0"},   {12, "ac"},  {17, "ah"},  {55, "bj"},  {56, "bk"},  {130, "dm"},
        {198, "fi"}, {288, "i0"}, {536, "ow"}, {537, "ox"}, {559, "pj"}, {935, "zz"},
        {936, "aA"}, {937, "aB"}, {961, "aZ"}, {962, "bA"},
    };
    for (const auto& [tag, mnemonic] : examples)
        EXPECT_EQ(by_rule(tag, MnemonicRule::dc_590plus), mnemonic) << tag;
}

TEST(Mnemonic, OfPnoIsItsHexadecimalNumberUnderTags1000To1127)
{
    EXPECT_EQ(by_rule(1000, MnemonicRule::dc_590plus), "00"); // by the plain formula it would be cM
    EXPECT_EQ(by_rule(1039, MnemonicRule::dc_590plus), "27");
    EXPECT_EQ(by_rule(1015, MnemonicRule::dc_590plus), "0F");
    EXPECT_EQ(by_rule(1011, MnemonicRule::dc_590plus), "0B");
    EXPECT_EQ(by_rule(1127, MnemonicRule::dc_590plus), "7F");
    EXPECT_EQ(by_rule(999, MnemonicRule::dc_590plus), "cL");
    EXPECT_EQ(by_rule(1128, MnemonicRule::dc_590plus), "hK");
    EXPECT_EQ(by_rule(1000, MnemonicRule::ac), "rs");
}

TEST(Mnemonic, OfEveryTagIsItsOwn)
{
    for (const MnemonicRule rule : {MnemonicRule::ac, MnemonicRule::dc_590plus}) {
        std::set<std::string> seen;
        int tag = 0;
        for (; by_rule(tag, rule) != "none"; ++tag)
            EXPECT_TRUE(seen.insert(by_rule(tag, rule)).second) << tag;
        EXPECT_EQ(tag, rule == MnemonicRule::ac ? 1972 : 1612);
        EXPECT_EQ(by_rule(65535, rule), "none");
    }
}

TEST(Mnemonic, OfAParameterNumberIsItsHexadecimalForm)
{
    EXPECT_EQ(by_rule(39, MnemonicRule::pno), "27");
    EXPECT_EQ(by_rule(1015, MnemonicRule::pno), "0F");
    EXPECT_EQ(by_rule(127, MnemonicRule::pno), "7F");
    for (const int tag : {128, 288, 999, 1128, 65535}) EXPECT_EQ(by_rule(tag, MnemonicRule::pno), "none");
}

TEST(MnemonicRules, AreFoundByTheNamesThatTheyAreGivenBack)
{
    for (const char* const name : {"590plus", "ac", "pno", "none"})
        EXPECT_EQ(text(mnemonic_rule_of(name).value()), name);
    EXPECT_EQ(mnemonic_rule_of("590"), std::nullopt);
}

TEST(Mnemonic, OfTheTableGoesBeforeTheRule)
{
    Tag tag = number_tag(0);
    tag.number = 271;
    EXPECT_EQ(mnemonic_of(tag, MnemonicRule::none), std::nullopt);
    EXPECT_EQ(mnemonic_of(tag, MnemonicRule::ac), (std::array{'7', 'j'}));
    tag.mnemonic = "!2";
    EXPECT_EQ(mnemonic_of(tag, MnemonicRule::ac), (std::array{'!', '2'}));
    EXPECT_EQ(mnemonic_of(tag, MnemonicRule::none), (std::array{'!', '2'}));
}

TEST(Displayed, PutsThePointWhereTheTableHasIt)
{
    EXPECT_EQ(displayed(number_tag(2), 0x7530), "300.00");
    EXPECT_EQ(displayed(number_tag(2), 0x8AD0), "-300.00");
    EXPECT_EQ(displayed(number_tag(2), 0x8000), "-327.68");
    EXPECT_EQ(displayed(number_tag(4), 0xFFFF), "-0.0001");
    EXPECT_EQ(displayed(number_tag(1), 0x270F), "999.9");
    EXPECT_EQ(displayed(number_tag(0), 12), "12");
    Tag wide = number_tag(1);
    wide.is_unsigned = true;
    EXPECT_EQ(displayed(wide, 0xFFFF), "6553.5");
}

TEST(Displayed, NamesValuesAndBits)
{
    Tag mode = typed(TagType::enumeration);
    mode.labels = {{false, 0, "Stopped"}, {false, 1, "Running"}};
    EXPECT_EQ(displayed(mode, 1), "1 (Running)");
    EXPECT_EQ(displayed(mode, 7), "7");
    Tag status = typed(TagType::word);
    status.labels = {{true, 0, "ready"}, {true, 2, "running"}, {true, 15, "top"}};
    EXPECT_EQ(displayed(status, 0x0105), ">0105 (ready, running)");
    EXPECT_EQ(displayed(status, 0x8000), ">8000 (top)");
    EXPECT_EQ(displayed(typed(TagType::word), 0x1A2B), ">1A2B");
    EXPECT_EQ(displayed(typed(TagType::boolean), 1), "1");
}

TEST(ParseValue, ReadsWhatIsDisplayed)
{
    for (unsigned decimals = 0; decimals <= 4; ++decimals)
        for (unsigned word = 0; word <= 0xFFFF; word += 257) {
            const Tag tag = number_tag(decimals);
            const auto parsed = parse_value(tag, displayed(tag, static_cast<std::uint16_t>(word)));
            ASSERT_EQ(parsed.error, AccessError::none);
            ASSERT_EQ(parsed.word, word);
        }
}

TEST(ParseValue, ScalesByTheTablesDecimals)
{
    EXPECT_EQ(parse_value(number_tag(2), "300").word, 0x7530);
    EXPECT_EQ(parse_value(number_tag(2), "-300.0").word, 0x8AD0);
    EXPECT_EQ(parse_value(number_tag(2), " 12.34 ").word, 0x04D2);
    EXPECT_EQ(parse_value(number_tag(2), ".5").word, 50);
    EXPECT_EQ(parse_value(number_tag(1), "12.50").word, 125) << "a zero that says nothing does no harm";
    EXPECT_EQ(parse_value(number_tag(1), ">7530").word, 0x7530);
    EXPECT_EQ(parse_value(number_tag(1), "0xFFFF").word, 0xFFFF);
}

TEST(ParseValue, RefusesWhatTheTagCannotHold)
{
    EXPECT_EQ(parse_value(number_tag(2), "327.68").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(number_tag(2), "-327.69").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(number_tag(0), "99999999999999999999").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(number_tag(1), "12.55").error, AccessError::value_not_encoded);
    for (const char* text : {"", "-", ".", "12a", "1.2.3", "--1", ">", ">G", "0x", "1 2"})
        EXPECT_EQ(parse_value(number_tag(1), text).error, AccessError::value_not_encoded) << text;
    EXPECT_EQ(parse_value(number_tag(0), ">10000").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(typed(TagType::boolean), "2").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(typed(TagType::enumeration), "256").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(typed(TagType::string), "abc").error, AccessError::unsupported_type);
}

TEST(ParseValue, KeepsTheLimitsOfTheTable)
{
    Tag tag = number_tag(1);
    tag.min = -100;
    tag.max = 1000;
    EXPECT_EQ(parse_value(tag, "100.0").error, AccessError::none);
    EXPECT_EQ(parse_value(tag, "100.1").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(tag, "-10.1").error, AccessError::out_of_range);
    EXPECT_EQ(parse_value(tag, ">FFFF").word, 0xFFFF) << "-0.1 as bits is within the limits";
    Tag wide = number_tag(0);
    wide.is_unsigned = true;
    wide.min = 0;
    wide.max = 65535;
    EXPECT_EQ(parse_value(wide, "65535").word, 0xFFFF);
    EXPECT_EQ(parse_value(wide, "-1").error, AccessError::out_of_range);
}

TEST(ParseValue, OfAWordIsNotGuessed)
{
    const Tag word = typed(TagType::word);
    EXPECT_EQ(parse_value(word, ">047F").word, 0x047F);
    EXPECT_EQ(parse_value(word, "0x47f").word, 0x047F);
    EXPECT_EQ(parse_value(word, "1").word, 1);
    EXPECT_EQ(parse_value(word, "0203").error, AccessError::value_not_encoded);
}

TEST(ParseValue, TakesALabelInAnyCase)
{
    Tag mode = typed(TagType::enumeration);
    mode.labels = {{false, 3, "Coast Stop"}, {true, 5, "bit"}};
    EXPECT_EQ(parse_value(mode, "coast stop").word, 3);
    EXPECT_EQ(parse_value(mode, "bit").error, AccessError::value_not_encoded);
}

TEST(TagTable, FindsByNumberAndByPartOfANameOrAlias)
{
    Tag speed = number_tag(2), stop = typed(TagType::word), ramp = number_tag(1);
    speed.number = 288;
    speed.name = "SPEED DEMAND";
    stop.number = 55;
    stop.name = "Coast Stop";
    ramp.number = 56;
    ramp.name = "Ramp";
    ramp.aliases = {"speed ramp"};
    const TagTable table{{speed, stop, ramp}};
    ASSERT_NE(table.find(56), nullptr);
    EXPECT_EQ(table.find(56)->name, "Ramp");
    EXPECT_EQ(table.find(57), nullptr);
    EXPECT_EQ(table.all().front().number, 55);
    const auto found = table.search("Speed");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0]->number, 56);
    EXPECT_EQ(found[1]->number, 288);
    EXPECT_TRUE(table.search("torque").empty());
}

TEST(TagTable, KeepsTheOrderOfItsRowsBesideThatOfTheNumbers)
{
    Tag first = number_tag(0), second = number_tag(0), third = number_tag(0);
    first.number = 288;
    second.number = 55;
    third.number = 56;
    first.position = 0;
    second.position = 1;
    third.position = 2;
    const TagTable table{{third, second, first}};
    const auto rows = table.in_table_order();
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0]->number, 288);
    EXPECT_EQ(rows[1]->number, 55);
    EXPECT_EQ(rows[2]->number, 56);
    EXPECT_EQ(table.all().front().number, 55);
}

TEST(TagInCounts, IsShownAndReadInCounts)
{
    Tag tag = number_tag(0);
    tag.is_real = true;
    std::vector<Tag> rows{tag, number_tag(0), number_tag(1), tag, tag};
    rows[2].is_real = true;
    rows[3].follows_display = true;
    rows[4].modbus_register = 0x8006;
    mark_counts(rows);

    EXPECT_EQ(displayed(rows[0], 50), "50 counts");
    EXPECT_EQ(displayed(rows[1], 50), "50") << "INT is a whole number";
    EXPECT_EQ(displayed(rows[2], 50), "5.0");
    EXPECT_EQ(displayed(rows[3], 50), "50") << "as the display has it";
    EXPECT_EQ(displayed(rows[4], 50), "50") << "the IEEE area has the value itself";
    EXPECT_EQ(parse_value(rows[0], "-50").word, 0xFFCE);
    EXPECT_EQ(parse_value(rows[0], "50 counts").word, 50);
    EXPECT_EQ(parse_value(rows[1], "50 counts").error, AccessError::value_not_encoded);
}

TEST(TagType, IsTheWordOfTheColumnAndDistinguishesRealFromInt)
{
    Tag tag = number_tag(1);
    EXPECT_EQ(type_name(tag), "INT");
    tag.is_real = true;
    EXPECT_EQ(type_name(tag), "REAL");
    EXPECT_EQ(type_name(typed(TagType::word)), "WORD");
}

} // namespace
} // namespace dpslave::drive
