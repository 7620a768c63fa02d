// SPDX-License-Identifier: Apache-2.0
#include "files.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

namespace dpslave {
namespace {

using drive::Access;
using drive::Tag;
using drive::TagType;
using input::Faults;
using profile::load_tags;
using test::Folder;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

class TagTable : public testing::Test {
protected:
    drive::TagTable good(std::string_view content)
    {
        auto tags = load_tags(io::read_regular_file, folder_.write("t.csv", content).string());
        if (tags) return *std::move(tags);
        for (const auto& fault : tags.error()) ADD_FAILURE() << to_string(fault);
        return {};
    }

    Faults bad(std::string_view content)
    {
        const auto tags = load_tags(io::read_regular_file, folder_.write("t.csv", content).string());
        EXPECT_FALSE(tags) << "half a table was taken";
        return tags ? Faults{} : tags.error();
    }

    Folder folder_;
};

TEST_F(TagTable, of_iso_8859_1_or_utf_8_names_what_its_author_wrote)
{
    EXPECT_EQ(good("tag,name\n1,Z\xFCrich\n").find(1)->name, "Z\u00FCrich");
    EXPECT_EQ(good("tag,name\n1,Z\u00FCrich\n").find(1)->name, "Z\u00FCrich");
}

TEST_F(TagTable, with_thousands_of_faults_reports_the_first_ones_and_that_there_are_more)
{
    std::string content = "tag,name,type\n";
    for (int i = 0; i < 12'000; ++i) content += std::to_string(i) + ",a name,NOTYPE\n";

    const Faults faults = bad(content);

    ASSERT_EQ(faults.size(), input::kMaxFaults + 1);
    EXPECT_EQ(faults[0].line, 2u);
    EXPECT_EQ(faults[input::kMaxFaults - 1].line, input::kMaxFaults + 1);
    EXPECT_THAT(faults.back().what, HasSubstr("more faults"));
}

TEST_F(TagTable, with_thousands_of_rows_of_wrong_form_reports_the_first_ones_and_that_there_are_more)
{
    std::string content = "tag,name\n";
    for (int i = 0; i < 12'000; ++i) content += std::to_string(i) + ",a\x07\n";

    EXPECT_EQ(bad(content).size(), input::kMaxFaults + 1);
}

TEST_F(TagTable, whose_first_line_is_nothing_but_commas_is_refused_with_what_to_do)
{
    const Faults faults = bad("tag" + std::string(200, ',') + "\n1\n");

    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].line, 1u);
    EXPECT_THAT(faults[0].what, AllOf(HasSubstr("201 columns"), HasSubstr("check its commas")));
}

TEST_F(TagTable, may_have_many_columns_of_its_user)
{
    std::string header = "tag,name";
    for (int i = 2; i < 200; ++i) header += ",own" + std::to_string(i);

    EXPECT_EQ(good(header + "\n1,SPEED" + std::string(198, ',') + "\n").find(1)->name, "SPEED");
}

TEST_F(TagTable, of_many_names_for_one_tag_keeps_each_once)
{
    std::string content = "tag,name\n";
    for (int i = 0; i < 60'000; ++i) content += "1,n" + std::to_string(i / 2) + "\n";

    EXPECT_EQ(good(content).find(1)->aliases.size(), 29'999u);
}

TEST_F(TagTable, that_is_no_regular_file_or_too_large_is_refused_at_once)
{
    const auto why = [](const std::filesystem::path& file) {
        return load_tags(io::read_regular_file, file.string()).error().at(0).what;
    };
    const auto pipe = folder_.path() / "pipe.csv";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);

    EXPECT_THAT(why(pipe), HasSubstr("no regular file"));
    EXPECT_THAT(why("/dev/ptmx"), HasSubstr("no regular file"));
    EXPECT_THAT(why("/dev/zero"), HasSubstr("no regular file"));
    EXPECT_THAT(why(folder_.path()), HasSubstr("is a folder"));
    EXPECT_THAT(why(folder_.write("large.csv", std::string(1024 * 1024 + 1, ' '))),
                HasSubstr("larger than 1 MiB"));
}

TEST_F(TagTable, recognises_which_numbers_have_no_scale)
{
    const auto tags = good("tag,type,decimals,confirmed\n1,INT,0,\n2,INT,,\n3,,,yes\n4,WORD,,\n5,INT,1,no\n"
                           "6,WORD,,no\n7,REAL,display,\n");
    const auto scaled = [&](std::uint16_t tag) { return drive::has_scale(*tags.find(tag)); };

    EXPECT_TRUE(scaled(1));
    EXPECT_FALSE(scaled(2));
    EXPECT_FALSE(scaled(3));
    EXPECT_TRUE(scaled(4));
    EXPECT_FALSE(scaled(5)) << "a survey made the row";
    EXPECT_FALSE(scaled(6));
    EXPECT_FALSE(scaled(7)) << "until display_decimals says what the display has";
}

TEST_F(TagTable, says_of_which_tags_each_write_counts)
{
    const auto tags = good("tag,once\n1,yes\n2,no\n3,\n");

    EXPECT_TRUE(tags.find(1)->once);
    EXPECT_FALSE(tags.find(2)->once);
    EXPECT_FALSE(tags.find(3)->once);
}

TEST_F(TagTable, takes_a_mnemonic_that_only_looks_like_the_reserved_one)
{
    EXPECT_EQ(good("tag,mnemonic\n518,ee\n5,eE\n").all().size(), 2U);
}

TEST_F(TagTable, takes_every_column_in_any_order_and_leaves_unknown_ones_alone)
{
    const auto tags =
        good("notes,max,tag,colour,min,type,decimals,name,section,access,register,mnemonic,values\n"
             "a note,327.67,55,red,-327.68,REAL,2,SPEED DEMAND,SETPOINTS,rw,1055,bj,\n");

    const Tag* tag = tags.find(55);
    ASSERT_NE(tag, nullptr);
    EXPECT_EQ(tag->name, "SPEED DEMAND");
    EXPECT_EQ(tag->type, TagType::number);
    EXPECT_EQ(tag->decimals, 2);
    EXPECT_EQ(tag->min, -32768);
    EXPECT_EQ(tag->max, 32767);
    EXPECT_FALSE(tag->is_unsigned);
    EXPECT_EQ(tag->access, Access::read_write);
    EXPECT_EQ(tag->modbus_register, 1055);
    EXPECT_EQ(tag->mnemonic, "bj");
    EXPECT_EQ(tag->section, "SETPOINTS");
    EXPECT_EQ(tag->notes, "a note");
}

TEST_F(TagTable, needs_the_tag_alone_and_leaves_the_rest_unsaid)
{
    const auto tags = good("tag\n7\n");

    const Tag* tag = tags.find(7);
    ASSERT_NE(tag, nullptr);
    EXPECT_EQ(tag->type, TagType::number);
    EXPECT_EQ(tag->decimals, 0);
    EXPECT_EQ(tag->access, Access::unknown);
    EXPECT_FALSE(tag->min.has_value() || tag->max.has_value() || tag->modbus_register.has_value());
    EXPECT_TRUE(tag->mnemonic.empty());
}

TEST_F(TagTable, recognises_every_type_and_access)
{
    const auto tags =
        good("tag,type,access\n1,INT,ro\n2,REAL,rw\n3,WORD,wo\n4,BOOL,\n5,ENUM,ro\n6,STRING,ro\n");

    EXPECT_EQ(tags.find(1)->type, TagType::number);
    EXPECT_EQ(tags.find(2)->type, TagType::number);
    EXPECT_EQ(tags.find(3)->type, TagType::word);
    EXPECT_EQ(tags.find(4)->type, TagType::boolean);
    EXPECT_EQ(tags.find(5)->type, TagType::enumeration);
    EXPECT_EQ(tags.find(6)->type, TagType::string);
    EXPECT_EQ(tags.find(1)->access, Access::read_only);
    EXPECT_EQ(tags.find(2)->access, Access::read_write);
    EXPECT_EQ(tags.find(3)->access, Access::write_only);
    EXPECT_EQ(tags.find(4)->access, Access::unknown);
}

TEST_F(TagTable, a_number_is_unsigned_where_min_is_not_negative_and_max_above_32767)
{
    const auto tags = good("tag,type,decimals,min,max\n1,INT,0,0,32768\n2,INT,0,0,32767\n3,INT,0,,32767\n"
                           "4,REAL,2,0.00,655.35\n5,INT,0,-1,32767\n");

    EXPECT_TRUE(tags.find(1)->is_unsigned);
    EXPECT_FALSE(tags.find(2)->is_unsigned);
    EXPECT_FALSE(tags.find(3)->is_unsigned);
    EXPECT_TRUE(tags.find(4)->is_unsigned);
    EXPECT_EQ(tags.find(4)->max, 65535);
    EXPECT_FALSE(tags.find(5)->is_unsigned);
}

TEST_F(TagTable, a_number_may_follow_the_decimals_of_the_display)
{
    const auto tags = good("tag,type,decimals\n1,INT,display\n2,REAL,display\n3,INT,0\n1,,display\n");

    EXPECT_TRUE(tags.find(1)->follows_display);
    EXPECT_EQ(tags.find(1)->decimals, 0);
    EXPECT_TRUE(tags.find(2)->follows_display);
    EXPECT_FALSE(tags.find(3)->follows_display);
}

TEST_F(TagTable, limits_are_displayed_values_and_may_have_fewer_or_needless_decimals)
{
    const auto tags = good("tag,decimals,min,max\n1,2,-5,+1.5\n2,1,0.100,7.\n3,4,-3.2768,3.2767\n");

    EXPECT_EQ(tags.find(1)->min, -500);
    EXPECT_EQ(tags.find(1)->max, 150);
    EXPECT_EQ(tags.find(2)->min, 1);
    EXPECT_EQ(tags.find(2)->max, 70);
    EXPECT_EQ(tags.find(3)->min, -32768);
    EXPECT_EQ(tags.find(3)->max, 32767);
}

TEST_F(TagTable, limits_of_a_word_are_always_hexadecimal)
{
    const auto tags = good("tag,type,min,max\n1,WORD,10,0xFF00\n2,WORD,0000,ffff\n");

    EXPECT_EQ(tags.find(1)->min, 0x10);
    EXPECT_EQ(tags.find(1)->max, 0xFF00);
    EXPECT_EQ(tags.find(2)->max, 0xFFFF);
}

TEST_F(TagTable, values_name_values_or_bits)
{
    const auto tags = good("tag,type,decimals,values\n1,ENUM,,0=Stopped; 1 = Running "
                           ";\n2,WORD,,bit0=Ready;bit15=Tripped;1F=All\n"
                           "3,REAL,1,-0.1=Off\n");

    const auto& states = tags.find(1)->labels;
    ASSERT_EQ(states.size(), 2U);
    EXPECT_EQ(states[1].number, 1);
    EXPECT_EQ(states[1].text, "Running");
    EXPECT_FALSE(states[1].is_bit);
    const auto& bits = tags.find(2)->labels;
    ASSERT_EQ(bits.size(), 3U);
    EXPECT_TRUE(bits[1].is_bit);
    EXPECT_EQ(bits[1].number, 15);
    EXPECT_EQ(bits[2].number, 0x1F);
    EXPECT_EQ(tags.find(3)->labels.at(0).number, 0xFFFF) << "the 16 bits of -1";
}

TEST_F(TagTable, quoted_cells_may_hold_commas_quotes_and_line_ends)
{
    const auto tags = good("tag,name,notes\r\n55,\"SPEED, \"\"main\"\"\",\"two\r\nlines\"\r\n56, LOAD ,\r\n");

    EXPECT_EQ(tags.find(55)->name, "SPEED, \"main\"");
    EXPECT_EQ(tags.find(55)->notes, "two\r\nlines");
    EXPECT_EQ(tags.find(56)->name, "LOAD");
}

TEST_F(TagTable, tolerates_a_byte_order_mark_empty_lines_and_a_missing_last_line_end)
{
    const auto tags = good("\xEF\xBB\xBFtag,name\r\n\r\n1,a\r\n   \r\n\r\n2,b");

    EXPECT_EQ(tags.all().size(), 2U);
    EXPECT_EQ(tags.find(2)->name, "b");
}

TEST(TagTableText, is_read_with_a_byte_order_mark_as_without_it)
{
    const std::string mark = "\xEF\xBB\xBF";
    const auto marked = profile::read_tags(mark + "tag,name\n7,a\n", "t.csv");
    ASSERT_TRUE(marked);
    EXPECT_EQ(*marked, *profile::read_tags("tag,name\n7,a\n", "t.csv"));
    EXPECT_FALSE(profile::read_tags(mark + mark + "tag,name\n7,a\n", "t.csv"))
        << "the second one is of a name";
    EXPECT_FALSE(profile::read_tags(mark, "t.csv")) << "an empty table";
}

TEST_F(TagTable, a_tag_that_stands_twice_with_one_meaning_has_two_names)
{
    const auto tags = good(
        "tag,name,type,access,max\n23,Setpoint 1,INT,rw,100\n23,SP1,INT,rw,100\n23,Alias,,,\n23,SP1,,,\n");

    ASSERT_EQ(tags.all().size(), 1U);
    EXPECT_EQ(tags.find(23)->name, "Setpoint 1");
    EXPECT_THAT(tags.find(23)->aliases, ElementsAre("SP1", "Alias"));
}

TEST_F(TagTable, a_row_that_gives_a_further_name_only_may_stand_before_the_one_that_counts)
{
    const auto tags =
        good("tag,name,type,values,section\n517,Goto,,,Setpoint\n5,WSP,,,Home\n517,Jump,,,Setpoint\n"
             "517,Programmer type,ENUM,0=None,Programmer\n5,Other,,,Home\n517,Goto,,,Setpoint\n");

    EXPECT_EQ(tags.find(517)->name, "Programmer type");
    EXPECT_EQ(tags.find(517)->type, TagType::enumeration);
    EXPECT_EQ(tags.find(517)->section, "Programmer");
    EXPECT_THAT(tags.find(517)->aliases, ElementsAre("Goto", "Jump"));
    EXPECT_EQ(tags.find(5)->name, "WSP") << "where no row says more the first one counts";
    EXPECT_THAT(tags.find(5)->aliases, ElementsAre("Other"));
}

TEST_F(TagTable, keeps_the_order_of_its_rows)
{
    const auto tags = good("tag,name,type\n273,A,ENUM\n2,B,INT\n5,Alias,\n1,C,INT\n5,D,INT\n");

    std::vector<int> order;
    for (const Tag* tag : tags.in_table_order()) order.push_back(tag->number);
    EXPECT_THAT(order, ElementsAre(273, 2, 1, 5)) << "each where its own row stands";
}

TEST_F(TagTable, distinguishes_floating_values_from_whole_numbers)
{
    const auto tags = good("tag,type,decimals,register\n1,INT,2,\n2,REAL,0,32772\n3,INT,display,32774\n"
                           "4,ENUM,,32776\n5,WORD,,32778\n6,BOOL,,32780\n");

    EXPECT_FALSE(tags.find(1)->is_real);
    EXPECT_TRUE(tags.find(2)->is_real);
    EXPECT_TRUE(tags.find(3)->is_real) << "what has the decimals of the display is scaled";
    EXPECT_FALSE(tags.find(4)->is_real);
    EXPECT_EQ(tags.find(6)->modbus_register, 32780);
}

TEST_F(TagTable, recognises_when_a_tag_can_be_written)
{
    const auto tags = good("tag,when\n1,\n2,stopped\n3,configuration\n");

    EXPECT_EQ(tags.find(1)->when, drive::WritableWhen::not_said);
    EXPECT_EQ(tags.find(2)->when, drive::WritableWhen::stopped);
    EXPECT_EQ(tags.find(3)->when, drive::WritableWhen::configuration);
}

TEST_F(TagTable, a_table_may_be_a_header_only)
{
    EXPECT_TRUE(good("tag,name\n").all().empty());
}

struct BadTable {
    const char* content;
    const char* place;    ///< "line:column: "
    const char* sentence; ///< a part of it
};

void PrintTo(const BadTable& table, std::ostream* out)
{
    *out << test::case_name(std::string{table.sentence} + " in " + table.content);
}

class BadTagTable : public TagTable, public testing::WithParamInterface<BadTable> {};

TEST_P(BadTagTable, is_refused_with_place_and_remedy)
{
    const Faults faults = bad(GetParam().content);

    ASSERT_EQ(faults.size(), 1U) << (faults.size() > 1 ? to_string(faults[1]) : "");
    EXPECT_THAT(faults[0].file, EndsWith("/t.csv"));
    EXPECT_THAT(test::short_form(faults[0]),
                AllOf(StartsWith(GetParam().place), HasSubstr(GetParam().sentence)));
}

INSTANTIATE_TEST_SUITE_P(
    rows, BadTagTable,
    testing::Values(
        BadTable{"", "0:0: ", "first line names the columns"},
        BadTable{"\n\n", "0:0: ", "first line names the columns"},
        BadTable{"name,type\nx,INT\n", "1:1: ", "no column tag"},
        BadTable{"tag,decimal\n1,2\n", "1:5: ", "\"decimal\" is nearly \"decimals\""},
        BadTable{"tag,min.\n1,2\n", "1:5: ", "\"min.\" is nearly \"min\""},
        BadTable{"tag,Decimals\n1,2\n", "1:5: ", "nearly \"decimals\""},
        BadTable{"tag,decimal places\n1,2\n", "1:5: ", "nearly \"decimals\""},
        BadTable{"tag,regsiter\n1,2\n", "1:5: ", "nearly \"register\""},
        BadTable{"tag,confirmed\n1,perhaps\n", "2:3: ", "write yes, or no"},
        BadTable{"tag,once\n1,perhaps\n", "2:3: ", "write yes for a parameter of which each write counts"},
        BadTable{"tag,name,type,once\n1,a,INT,\n1,b,,yes\n", "3:6: ", "another once on line 2"},
        BadTable{"tag,Once\n1,yes\n", "1:5: ", "nearly \"once\""},
        BadTable{"tag,confirmed\n1,yes\n1,no\n", "3:3: ", "another confirmed on line 2"},
        BadTable{"tag,mnemonic\n1,EE\n", "2:3: ", "the drive's last error"},
        BadTable{"tag,mnemonic\n1,aa\n2,bb\n3,aa\n", "4:0: ", "is that of tag 1 on line 2"},
        BadTable{"tag,type,register\n1,REAL,32771\n", "2:8: ", "odd"},
        BadTable{"tag,name\n1,\"two\nlines\"\n", "2:3: ", "line break"},
        BadTable{"tag;name;type\n1;x;INT\n", "1:1: ", "not by semicolons"},
        BadTable{"tag,name,tag\n1,x,2\n", "1:10: ", "second column \"tag\""},
        BadTable{"tag,name\n1,x\n2,y,z\n", "3:0: ", "3 cells, the first line has 2"},
        BadTable{"tag,name\n1\n", "2:0: ", "1 cells, the first line has 2"},
        BadTable{"tag,name\n,x\n", "2:1: ", "tag number is missing"},
        BadTable{"name,tag\nx,12a\n", "2:3: ", "decimal number from 0 to 65535"},
        BadTable{"tag\n65536\n", "2:1: ", "from 0 to 65535"},
        BadTable{"tag\n-1\n", "2:1: ", "from 0 to 65535"}, BadTable{"tag\n0x37\n", "2:1: ", "decimal number"},
        BadTable{"tag,type\n1,FLOAT\n", "2:3: ", "write INT, WORD, BOOL, ENUM, REAL or STRING"},
        BadTable{"tag,type\n1,int\n", "2:3: ", "type \"int\""},
        BadTable{"tag,decimals\n1,Display\n", "2:3: ", "from 0 to 4, or display."},
        BadTable{"tag,type,decimals\n1,WORD,display\n", "2:8: ", "only INT and REAL have decimals"},
        BadTable{"tag,decimals,max\n1,display,5\n", "2:11: ", "follow the display has no fixed limits"},
        BadTable{"tag,decimals\n1,display\n1,0\n", "3:3: ", "another decimals on line 2"},
        BadTable{"tag,decimals\n1,5\n", "2:3: ", "from 0 to 4"},
        BadTable{"tag,type,decimals\n1,WORD,1\n", "2:8: ", "only INT and REAL have decimals"},
        BadTable{"tag,access\n1,read\n", "2:3: ", "ro, rw or wo"},
        BadTable{"tag,mnemonic\n1,abc\n", "2:3: ", "two printable characters"},
        BadTable{"tag,mnemonic\n1,\"a \"\n", "2:3: ", "two printable characters"},
        BadTable{"tag,register\n1,70000\n", "2:3: ", "register \"70000\""},
        BadTable{"tag,type,register\n1,INT,32770\n", "2:7: ", "IEEE area"},
        BadTable{"tag,register\n1,32768\n", "2:3: ", "write type REAL if this is one"},
        BadTable{"tag,type,register\n1,STRING,40000\n", "2:10: ", "IEEE area"},
        BadTable{"tag,when\n1,running\n", "2:3: ", "write stopped or configuration"},
        BadTable{"tag,when\n1,stopped\n1,configuration\n", "3:3: ", "another when on line 2"},
        BadTable{"tag,type\n1,INT\n1,REAL\n", "3:3: ", "another type on line 2"},
        BadTable{"tag,name,type\n1,Goto,\n1,Type,ENUM\n1,Type,WORD\n", "4:8: ", "another type on line 3"},
        BadTable{"tag,min\n1,abc\n", "2:3: ", "whole number"},
        BadTable{"tag,min\n1,1.5\n", "2:3: ", "column decimals"},
        BadTable{"tag,decimals,min\n1,1,1.25\n", "2:5: ", "at most 1 decimals"},
        BadTable{"tag,decimals,max\n1,2,327.68\n", "2:5: ", "does not fit in 16 bits"},
        BadTable{"tag,min\n1,-32769\n", "2:3: ", "-32768 to 32767"},
        BadTable{"tag,min,max\n1,0,65536\n", "2:5: ", "0 to 65535"},
        BadTable{"tag,min,max\n1,-1,40000\n", "2:6: ", "min of 0 or more"},
        BadTable{"tag,min,max\n1,10,9\n", "2:3: ", "is above max"},
        BadTable{"tag,type,max\n1,WORD,10000\n", "2:8: ", "hexadecimal number from 0 to FFFF"},
        BadTable{"tag,type,max\n1,BOOL,2\n", "2:8: ", "write 0 or 1"},
        BadTable{"tag,type,max\n1,ENUM,256\n", "2:8: ", "0 to 255"},
        BadTable{"tag,type,max\n1,STRING,8\n", "2:10: ", "a STRING has none"},
        BadTable{"tag,type,values\n1,ENUM,Stopped\n", "2:8: ", "value=label"},
        BadTable{"tag,type,values\n1,ENUM,0=\n", "2:8: ", "value=label"},
        BadTable{"tag,type,values\n1,ENUM,0=a;0=b\n", "2:8: ", "same value again"},
        BadTable{"tag,type,values\n1,ENUM,300=a\n", "2:8: ", "0 to 255"},
        BadTable{"tag,type,values\n1,WORD,bit16=a\n", "2:8: ", "bit0 to bit15"},
        BadTable{"tag,type,values\n1,BOOL,bit0=a\n", "2:8: ", "only WORD and INT have bits"},
        BadTable{"tag,name\n1,\"open\n2,b\n", "2:3: ", "never closed"},
        BadTable{"tag,name\n1,\"a\" b\n", "2:7: ", "after the closing quote"},
        BadTable{"tag,name\n1,5\" pipe\n", "2:4: ", "write this quote twice"},
        BadTable{"tag,name\n1,Z\xE4hler \x80\n", "2:10: ", "save the table as UTF-8"},
        BadTable{"tag,name\n1,a\xC2\x9B"
                 "31mz\n",
                 "2:4: ", "control character"},
        BadTable{"tag,name\n1,a\xE2\x80\xAEz\n", "2:4: ", "control character"},
        BadTable{"tag,name\n1,a\x07z\n", "2:4: ", "control character"},
        BadTable{"tag,\"name\n1,a\n", "1:5: ", "never closed"},
        BadTable{"tag,name,min\n1,\xC3\xA4\xC3\xB6,x\n", "2:6: ", "min \"x\""},
        BadTable{"tag,type\n1,INT\n\n1,WORD\n", "4:3: ", "tag 1 has another type on line 2"},
        BadTable{"tag,access\n1,ro\n1,rw\n", "3:3: ", "another access on line 2"},
        BadTable{"tag,max\n1,5\n1,6\n", "3:3: ", "another max"},
        BadTable{"tag,type,values\n1,ENUM,0=a\n1,ENUM,0=b\n", "3:8: ", "another values"}));

TEST_F(TagTable, all_faults_of_a_table_are_reported_in_one_run_in_the_order_of_the_lines)
{
    const Faults faults = bad("tag,type,access,min\nx,INT,ro,\n2,FLOAT,maybe,\n3,\"INT,ro,1\n");

    EXPECT_THAT(test::short_forms(faults), ElementsAre(StartsWith("2:1: "), StartsWith("3:3: type"),
                                                       StartsWith("3:9: access"), StartsWith("4:3: ")));
}

TEST_F(TagTable, the_line_after_a_cell_of_two_lines_is_counted_right)
{
    EXPECT_THAT(test::short_forms(bad("tag,notes\n1,\"a\nb\"\nx,c\n")), ElementsAre(StartsWith("4:1: ")));
}

TEST_F(TagTable, a_file_that_is_not_there_or_no_file_is_a_fault_of_the_file)
{
    const auto absent = load_tags(io::read_regular_file, (folder_.path() / "absent.csv").string());
    ASSERT_FALSE(absent);
    EXPECT_THAT(to_string(absent.error().at(0)),
                HasSubstr("absent.csv: the file cannot be read: No such file"));

    const auto folder = load_tags(io::read_regular_file, folder_.path().string());
    ASSERT_FALSE(folder);
    EXPECT_THAT(folder.error().at(0).what, HasSubstr("it is a folder"));
}

TEST(FaultText, is_file_line_column_and_sentence_as_compilers_have_it)
{
    EXPECT_EQ(to_string(input::Fault{"a.toml", 3, 7, "wrong."}), "a.toml:3:7: wrong.");
    EXPECT_EQ(to_string(input::Fault{"a.toml", 3, 0, "wrong."}), "a.toml:3: wrong.");
    EXPECT_EQ(to_string(input::Fault{"a.toml", 0, 0, "wrong."}), "a.toml: wrong.");
}

} // namespace
} // namespace dpslave
