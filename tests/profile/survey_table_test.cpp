// SPDX-License-Identifier: Apache-2.0
// From what a survey saw to a tag table: new rows, rows that wait, and rows that are confirmed.
#include "sightings.hpp"

#include "dpslave/profile/profile.hpp"
#include "dpslave/profile/survey.hpp"

#include <gmock/gmock.h>

namespace dpslave::profile {
namespace {

using test::denied;
using test::said;
using test::saw;
using test::silence;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

SurveyedTable merged(std::string_view table, const Survey& seen)
{
    auto result = merge_survey(table, "t.csv", seen);
    if (!result) {
        for (const input::Fault& fault : result.error()) ADD_FAILURE() << to_string(fault);
        return {};
    }
    // Whatever a survey writes, the daemon must be able to read.
    const auto tags = read_tags(result->text, "t.csv");
    if (!tags)
        for (const input::Fault& fault : tags.error()) ADD_FAILURE() << to_string(fault);
    return *std::move(result);
}

constexpr std::string_view kHeader =
    "tag,name,type,decimals,min,max,access,mnemonic,values,section,notes,confirmed,seen_min,seen_max\n";

std::string row_of(const Sighting& one)
{
    const SurveyedTable table = merged("", {{55, one}});
    EXPECT_THAT(table.text, StartsWith(std::string{kHeader}));
    return table.text.substr(std::min(kHeader.size(), table.text.size()));
}

TEST(SurveyTable, a_number_becomes_a_row_with_the_decimals_that_were_seen)
{
    EXPECT_EQ(row_of(saw({"12.34", "-0.5"}, "bj")), "55,,INT,2,,,,bj,,,,no,-0.5,12.34\n");
    EXPECT_EQ(row_of(saw({"30."}, "bj")), "55,,INT,0,,,,bj,,,,no,30,30\n");
}

TEST(SurveyTable, a_confirmed_row_gets_the_mnemonic_that_it_was_asked_by_where_that_is_wanted)
{
    const std::string_view table =
        "tag,type,decimals,mnemonic,confirmed\n"
        "55,INT,2,,yes\n56,INT,1,,yes\n57,INT,2,xy,yes\n58,INT,2,,yes\n59,INT,2,,yes\n";
    Sighting refused;
    refused.mnemonic = "3A";
    refused.add(test::denied("invalid tag"));
    const Survey seen{{55, saw({"12.5"}, "37")},
                      {56, saw({"0.25"}, "38")}, // against the row: the rule may be wrong
                      {57, saw({"1."}, "39")},
                      {58, refused},
                      {59, saw({"1."}, "xy")}};

    const auto filled = merge_survey(table, "t.csv", seen, MnemonicCells::fill);
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->text,
              "tag,type,decimals,mnemonic,confirmed\n"
              "55,INT,2,37,yes\n56,INT,1,,yes\n57,INT,2,xy,yes\n58,INT,2,,yes\n59,INT,2,,yes\n");
    EXPECT_THAT(filled->contradictions,
                testing::Contains(HasSubstr("its mnemonic by the rule is that of tag 57")));
    EXPECT_EQ(merged(table, seen).text, table) << "otherwise it stays as it is";
}

TEST(SurveyTable, a_number_above_32767_counts_is_unsigned)
{
    EXPECT_EQ(row_of(saw({"40000."})), "55,,INT,0,0,65535,,,,,,no,40000,40000\n");
    EXPECT_EQ(row_of(saw({"500.25"})), "55,,INT,2,0,655.35,,,,,,no,500.25,500.25\n");
}

TEST(SurveyTable, hexadecimal_answers_become_words_booleans_and_enumerations)
{
    EXPECT_EQ(row_of(saw({">1B0B"}, "ox")), "55,,WORD,,,,,ox,,,,no,>1B0B,>1B0B\n");
    EXPECT_EQ(row_of(saw({">0000"})), "55,,WORD,,,,,,,,,no,>0000,>0000\n")
        << "its form says it, not its value";
    EXPECT_EQ(row_of(saw({">00", ">01"})), "55,,BOOL,,,,,,,,,no,0,1\n");
    EXPECT_EQ(row_of(saw({">00", ">05"})), "55,,ENUM,,,,,,,,,no,0,5\n");
}

TEST(SurveyTable, a_text_becomes_a_string)
{
    EXPECT_EQ(row_of(saw({"DPSIM, 590"})), "55,,STRING,,,,,,,,,no,,\n");
}

TEST(SurveyTable, of_modbus_the_row_is_a_word_and_says_what_is_not_known)
{
    Sighting one;
    one.add(said(1234));

    EXPECT_EQ(
        row_of(one),
        "55,,WORD,,,,,,,,Modbus shows 16 bits only: type and decimals are in the manual,no,1234,1234\n");
}

TEST(SurveyTable, tags_without_a_mnemonic_are_parameters_of_their_own)
{
    const std::string before = std::string{kHeader} + "1,,WORD,,,,,,,,,no,1,1\n";
    Survey seen;
    for (const auto tag : std::initializer_list<std::uint16_t>{1, 2, 3})
        seen[tag].add(said(std::uint16_t{7}));

    EXPECT_THAT(merged(before, seen).added, ElementsAre(2, 3));
}

TEST(SurveyTable, what_was_denied_or_silent_gets_no_row)
{
    Survey seen;
    seen[55].add(denied("invalid tag"));
    seen[56].add(silence());

    const SurveyedTable table = merged("", seen);

    EXPECT_EQ(table.text, kHeader);
    EXPECT_THAT(table.added, IsEmpty());
    EXPECT_THAT(table.contradictions, IsEmpty());
}

TEST(SurveyTable, what_no_row_can_hold_is_reported)
{
    for (const auto& [answers, why] : std::initializer_list<std::pair<Sighting, const char*>>{
             {saw({"1.", ">1"}), "more than one form"},
             {saw({"0.12345"}), "4 decimals"},
             {saw({"70000."}), "16 bits"},
             {saw({"-1.", "40000."}), "16 bits"},
             {saw({"400.", "0.001"}), "16 bits"},
         }) {
        const SurveyedTable table = merged("", {{55, answers}});
        EXPECT_EQ(table.text, kHeader) << why;
        ASSERT_EQ(table.contradictions.size(), 1U) << why;
        EXPECT_THAT(table.contradictions[0], testing::AllOf(StartsWith("tag 55: "), HasSubstr(why)));
    }
}

TEST(SurveyTable, a_row_that_waits_gets_more_decimals_and_further_extremes_and_keeps_cells_written_by_hand)
{
    const std::string before =
        std::string{kHeader} +
        "55,SPEED FEEDBACK,INT,1,,,ro,bj,,DIAGNOSTICS,\"by page 12, to be checked\",no,0.5,12.5\n";

    const SurveyedTable table = merged(before, {{55, saw({"-3.25", "7."}, "bj")}});

    EXPECT_EQ(
        table.text,
        std::string{kHeader} +
            "55,SPEED FEEDBACK,INT,2,,,ro,bj,,DIAGNOSTICS,\"by page 12, to be checked\",no,-3.25,12.5\n");
    EXPECT_THAT(table.waiting, ElementsAre(55));
    EXPECT_THAT(table.added, IsEmpty());
}

TEST(SurveyTable, decimals_and_type_written_by_hand_into_a_waiting_row_are_only_raised_or_ruled_out)
{
    const std::string before =
        std::string{kHeader} + "55,,INT,3,,,,,,,,no,,\n56,,ENUM,,,,,,,,,no,,\n57,,BOOL,,,,,,,,,no,0,1\n";

    const SurveyedTable table = merged(before, {{55, saw({"0.5"})}, {56, saw({">01"})}, {57, saw({">02"})}});

    EXPECT_EQ(table.text, std::string{kHeader} + "55,,INT,3,,,,,,,,no,0.5,0.5\n56,,ENUM,,,,,,,,,no,1,1\n"
                                                 "57,,ENUM,,,,,,,,,no,2,2\n");
}

TEST(SurveyTable, a_confirmed_row_is_never_changed_only_contradicted)
{
    const std::string before = std::string{kHeader} + "55,SPEED,INT,1,-100.0,100.0,ro,,,,,yes,,\n"
                                                      "56 , \"RATIO\",INT,2,,,,,,,,,,\n"
                                                      "57,STATUS,WORD,,,,,,,,,yes,,\n"
                                                      "58,HEALTHY,BOOL,,,,,,,,,yes,,\n"
                                                      "59,GONE,INT,0,,,,,,,,yes,,\n"
                                                      "60,RESET,BOOL,,,,wo,,,,,yes,,\n";
    Survey seen{
        {55, saw({"12.34", "120.", "-101."})}, {56, saw({"1.5"})}, {57, saw({"12."})}, {58, saw({">02"})}};
    seen[59].add(denied("invalid tag"));
    seen[60].add(denied("unsupported type"));

    const SurveyedTable table = merged(before, seen);

    EXPECT_EQ(table.text, before);
    EXPECT_THAT(table.contradictions,
                ElementsAre("tag 55 (SPEED), line 2: its row says 1 decimal, the drive answers with 2",
                            "tag 57 (STATUS), line 4: its row says WORD, the drive answered \"12.\"",
                            "tag 58 (HEALTHY), line 5: its row says BOOL, the drive answered \">02\"",
                            "tag 59 (GONE), line 6: the drive denies it (invalid tag)"));
    EXPECT_THAT(table.waiting, IsEmpty());
}

TEST(SurveyTable, a_value_beyond_the_limits_of_a_confirmed_row_contradicts_it)
{
    const std::string before =
        std::string{kHeader} + "55,,INT,1,-100.0,100.0,,,,,,yes,,\n56,,INT,2,,,,,,,,yes,,\n";

    const SurveyedTable table = merged(before, {{55, saw({"-101.5", "100."})}, {56, saw({"400."})}});

    EXPECT_THAT(table.contradictions,
                ElementsAre("tag 55, line 2: the drive answered -101.5, its row allows -100.0 at least",
                            "tag 56, line 3: the drive answered 400, its row allows 327.67 at most"));
}

TEST(SurveyTable, a_number_row_without_decimals_is_reported_with_the_decimals_seen)
{
    const SurveyedTable table =
        merged("tag,name,type,decimals\n64,MOTOR CURRENT,REAL,\n", {{64, saw({"1.5"})}});

    EXPECT_THAT(table.contradictions,
                ElementsAre(HasSubstr("says no decimals, the drive answers with 1 at least")));
}

TEST(SurveyTable, new_rows_join_a_table_written_by_hand_whose_rows_stay_as_they_are)
{
    const std::string before = "name,tag,type,decimals,notes\n"
                               "\"SPEED, FEEDBACK\" ,55,INT,2,\"two\nlines\"\n"
                               "\n"
                               "Further name,55,,,\n";

    const SurveyedTable table = merged(before, {{7, saw({"1.5"}, "a7")}});

    EXPECT_EQ(table.text, "name,tag,type,decimals,notes,min,max,mnemonic,confirmed,seen_min,seen_max\n"
                          "\"SPEED, FEEDBACK\" ,55,INT,2,\"two\nlines\",,,,,,\n"
                          "Further name,55,,,,,,,,,\n"
                          ",7,INT,1,,,,a7,no,1.5,1.5\n");
    EXPECT_THAT(table.added, ElementsAre(7));
    EXPECT_THAT(table.waiting, ElementsAre(7));
}

TEST(SurveyTable, a_table_to_which_nothing_is_added_keeps_its_columns)
{
    const std::string before = "tag,type,decimals\r\n55,INT,2\r\n";
    EXPECT_EQ(merged(before, {{55, saw({"1.25"})}}).text, before);
}

TEST(SurveyTable, lines_of_blanks_between_the_rows_do_not_become_rows)
{
    const SurveyedTable table =
        merged("tag,type,decimals\n \t\n55,INT,2\n   \n\n56,INT,2  \n \n", {{7, saw({"1.5"}, "a7")}});

    EXPECT_EQ(table.text, "tag,type,decimals,min,max,mnemonic,notes,confirmed,seen_min,seen_max\n"
                          "55,INT,2,,,,,,,\n"
                          "56,INT,2  ,,,,,,,\n"
                          "7,INT,1,,,a7,,no,1.5,1.5\n");
}

TEST(SurveyTable, a_byte_order_mark_and_lines_that_end_as_a_spreadsheet_ends_them_stay)
{
    const std::string mark = "\xEF\xBB\xBF";
    const std::string header =
        "tag,name,type,decimals,min,max,mnemonic,notes,confirmed,seen_min,seen_max\r\n";
    const SurveyedTable joined =
        merged(mark + header + "55,Drehzahl \xC3\xBC,INT,2,,,,,yes,,\r\n", {{7, saw({"1.5"}, "a7")}});
    EXPECT_EQ(joined.text, mark + header +
                               "55,Drehzahl \xC3\xBC,INT,2,,,,,yes,,\r\n"
                               "7,,INT,1,,,a7,,no,1.5,1.5\r\n");
    EXPECT_FALSE(merge_survey(mark + joined.text, "t.csv", {})) << "a second mark is part of a name";
    const auto alone = merge_survey(mark, "t.csv", {});
    ASSERT_TRUE(alone) << "a file with nothing but the mark";
    EXPECT_EQ(alone->text, mark + std::string{kHeader});
}

TEST(SurveyTable, names_in_latin_1_stay_octet_by_octet)
{
    const std::string before = "tag,name,type,decimals,min,max,mnemonic,notes,confirmed,seen_min,seen_max\n"
                               "55,Geschwindigkeit \xE4,INT,2,,,,,yes,,\n";
    const SurveyedTable table = merged(before, {{7, saw({"1.5"}, "a7")}});

    EXPECT_EQ(table.text, before + "7,,INT,1,,,a7,,no,1.5,1.5\n");
}

TEST(SurveyTable, two_tags_that_one_mnemonic_reaches_get_one_row)
{
    const std::string before = std::string{kHeader} + "140,FIELD CURRENT,INT,1,,,,0F,,,,yes,,\n";

    const SurveyedTable table =
        merged(before, {{140, saw({"85."}, "0F")}, {1015, saw({"85."}, "0F")}, {1016, saw({"1."}, "10")}});

    EXPECT_EQ(table.text, before + "1016,,INT,0,,,,10,,,,no,1,1\n");
    EXPECT_THAT(
        table.contradictions,
        ElementsAre(
            "tag 1015: its mnemonic is that of tag 140: they are one parameter, and one row is enough"));
}

TEST(SurveyTable, the_same_survey_twice_changes_nothing)
{
    Survey seen{{55, saw({"12.34", "-0.5"}, "bj")},
                {56, saw({">1B0B"})},
                {57, saw({">05"})},
                {58, saw({"TEXT"})},
                {59, saw({"40000."})}};
    const std::string once = merged("", seen).text;
    EXPECT_EQ(merged(once, seen).text, once);
}

TEST(SurveyTable, what_is_no_tag_table_is_refused_with_its_faults)
{
    const auto result = merge_survey("name,type\nSPEED,INT\n", "t.csv", {});
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().front().what, HasSubstr("no column tag"));
}

} // namespace
} // namespace dpslave::profile
