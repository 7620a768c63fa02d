// SPDX-License-Identifier: Apache-2.0
// tools/convert-tags on small tables of both forms of source: what it writes, what it leaves out, what it
// refuses.
#include "files.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>

namespace dpslave {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kController = "tag,name,section,access,type,enum,notes\n";
constexpr const char* kDrive = "tag,mnemonic,name,type,decimals,min,max,access,source\n";
constexpr const char* kTable =
    "tag,name,type,decimals,min,max,access,when,mnemonic,register,values,section,notes\n";

struct Ended {
    int status = -1;
    std::string output; ///< both streams
};

Ended run(const std::string& arguments)
{
    Ended ended;
    const std::string command = "python3 '" DPSLAVE_SOURCE_DIR "/tools/convert-tags' " + arguments + " 2>&1";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return ended;
    std::array<char, 512> buffer{};
    for (std::size_t got = 0; (got = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        ended.output.append(buffer.data(), got);
    const int status = ::pclose(pipe);
    ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return ended;
}

class ConvertTags : public testing::Test {
protected:
    ConvertTags() { std::filesystem::create_directories(folder_.path() / "to"); }

    Ended convert() const
    {
        return run("'" + (folder_.path() / "from").string() + "' '" + (folder_.path() / "to").string() + "'");
    }
    void source(const std::string& name, const std::string& content) const
    {
        folder_.write("from/" + name, content);
    }
    std::string written(const std::string& name) const
    {
        return test::content_of(folder_.path() / "to" / name);
    }
    bool is_written(const std::string& name) const
    {
        return std::filesystem::exists(folder_.path() / "to" / name);
    }

    test::Folder folder_;
};

TEST_F(ConvertTags, makes_numbers_words_and_enumerations_of_a_controller_table)
{
    source("c.csv", std::string{kController} +
                        "1,Process variable,Home,unknown,scaled,,decimals follow the display (tag 525)\n"
                        "3,Power %,Home,rw,scaled,0=Off,\n"
                        "10,Cycle time,Output,unknown,scaled,,time type\n"
                        "22,Program,Run,ro,word,,\n"
                        "29,Type,Run,unknown,enum,0=End;1=Ramp,\"a, remark\"\n"
                        "30,Flag,Run,unknown,enum,,\n"
                        "31,General: Reserved,Run,unknown,word,,\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("c.csv"),
              std::string{kTable} +
                  "1,Process variable,REAL,display,,,,,,,,Home,decimals follow the display (tag 525)\n"
                  "3,Power %,REAL,0,,,rw,,,,0=Off,Home,\n"
                  "10,Cycle time,INT,0,0,65535,,,,,,Output,time type\n"
                  "22,Program,INT,0,0,65535,ro,,,,,Run,\n"
                  "29,Type,ENUM,,,,,,,,0=End;1=Ramp,Run,\"a, remark\"\n"
                  "30,Flag,ENUM,,,,,,,,,Run,\n"
                  "31,General: Reserved,WORD,,0000,FFFF,,,,,,Run,\n");
}

TEST_F(ConvertTags, names_bits_leaves_reserved_ones_out_and_notes_what_0_and_1_mean)
{
    source("c.csv", std::string{kController} +
                        "75,Status,S,ro,bits,bit0=Alarm 1 (0=Safe 1=Alarm);bit1=Alarm 2 (0=Safe 1=Alarm);"
                        "bit2=Ramp running (read only);bit3=Mode (0=Auto 1=Manual);bit15=reserved,seen\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("c.csv"),
              std::string{kTable} +
                  "75,Status,WORD,,0000,FFFF,ro,,,,bit0=Alarm 1;bit1=Alarm 2;bit2=Ramp running (read "
                  "only);bit3=Mode,S,seen; bits 0-1: 0=Safe 1=Alarm; bit 3: 0=Auto 1=Manual\n");
}

TEST_F(ConvertTags, makes_further_rows_of_a_tag_aliases_where_they_stand)
{
    source("c.csv", std::string{kController} +
                        "517,Goto,Setpoint,unknown,enum,,CONFLICT: of another controller\n"
                        "62,Break,Motor,unknown,scaled,,\n"
                        "62,Dwell,Setpoint,unknown,word,,CONFLICT: of another controller\n"
                        "517,Type,Programmer,rw,enum,0=None,\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("c.csv"), std::string{kTable} +
                                    "517,Goto,,,,,,,,,,Setpoint,CONFLICT: of another controller\n"
                                    "62,Break,REAL,0,,,,,,,,Motor,\n"
                                    "62,Dwell,,,,,,,,,,Setpoint,CONFLICT: of another controller\n"
                                    "517,Type,ENUM,,,,rw,,,,0=None,Programmer,\n");
    const auto tags = profile::load_tags(io::read_regular_file, (folder_.path() / "to/c.csv").string());
    ASSERT_TRUE(tags);
    EXPECT_THAT(tags->find(517)->aliases, ElementsAre("Goto"));
}

TEST_F(ConvertTags, keeps_what_is_a_time_or_a_rate_an_integer_and_says_when_a_tag_can_be_written)
{
    source("c.csv", std::string{kController} +
                        "8202,Program 0 segment 1: Duration or rate,P,rw,scaled,,offset 10\n"
                        "525,Decimals,C,rw,enum,,configuration parameter: writable in configuration mode "
                        "only (tag 199 = 2)\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(
        written("c.csv"),
        std::string{kTable} +
            "8202,Program 0 segment 1: Duration or rate,INT,0,,,rw,,,,,P,\"offset 10; a time or a scaled "
            "rate: as "
            "the instrument has it in its normal area, in both resolutions\"\n"
            "525,Decimals,ENUM,,,,rw,configuration,,,,C,configuration parameter: writable in configuration "
            "mode only (tag 199 = 2)\n");
}

TEST_F(ConvertTags, names_values_that_count_in_one_case_and_protects_what_must_never_be_written)
{
    source("c.csv",
           std::string{kController} +
               "199,Mode,M,rw,enum,,never write other values\n"
               "8203,Word 3,P,rw,word,,Call: program number; End: end type 0=Reset;1=Set output; last\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("c.csv"),
              std::string{kTable} +
                  "199,Mode,ENUM,,,,ro,,,,,M,never write other values; read only here\n"
                  "8203,Word 3,INT,0,0,65535,rw,,,,0=Reset (end);1=Set output (end),P,Call: "
                  "program number; End: end "
                  "type see values; last\n");
}

TEST_F(ConvertTags, takes_types_limits_and_printed_mnemonics_of_a_drive_table)
{
    source("d.csv", std::string{kDrive} +
                        "536,ow,REM. SEQUENCE,WORD,0,0,ffff,rw,\"manual, page 6; mnemonic printed there\"\n"
                        "12,ac,HEALTHY,BOOL,0,0,1,ro,manual; mnemonic by the formula\n"
                        "348,9o,PRESET,REAL,2,-300.00,300.00,rw (configuration mode),manual\n"
                        "84,2c,POLES,numeric,,,,read by the source,driver\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(
        written("d.csv"),
        std::string{kTable} +
            "536,REM. SEQUENCE,WORD,,0000,FFFF,rw,,ow,,,,\"manual, page 6\"\n"
            "12,HEALTHY,BOOL,,0,1,ro,,,,,,manual\n"
            "348,PRESET,REAL,2,-300.00,300.00,rw,configuration,,,,,manual; writable in: configuration mode\n"
            "84,POLES,INT,,,,,,,,,,driver; type not stated; decimals not stated: fill them in "
            "before use; access as the source has it: read by the source\n");
}

TEST_F(ConvertTags, leaves_out_rows_and_tables_without_a_tag_and_files_that_are_no_table)
{
    source("a.csv", std::string{kDrive} + ",0F,Health,WORD,0,0000,FFFF,unknown,m\n5,a5,Speed,INT,0,,,ro,m\n");
    source("none.csv", std::string{kDrive} + ",0F,Health,WORD,0,0000,FFFF,unknown,m\n");
    source("other.csv", "tag,mnemonic\n1,PV\n");

    const Ended ended = convert();

    EXPECT_EQ(ended.status, 0);
    EXPECT_EQ(written("a.csv"), std::string{kTable} + "5,Speed,INT,0,,,ro,,,,,,m\n");
    EXPECT_FALSE(is_written("none.csv"));
    EXPECT_FALSE(is_written("other.csv"));
    EXPECT_THAT(ended.output, HasSubstr("none.csv: no row of it has a tag, left out"));
    EXPECT_THAT(ended.output,
                HasSubstr("other.csv: its first line is not that of a table of tags, left out"));
}

TEST_F(ConvertTags, writes_signs_of_print_in_plain_ASCII)
{
    source("c.csv", std::string{kController} + "1,Units \xC2\xB0"
                                               "C \xE2\x80\x93 off,Home,ro,enum,0=\xC2\xB1"
                                               "5,\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("c.csv"), std::string{kTable} + "1,Units deg C - off,ENUM,,,,ro,,,,0=+/-5,Home,\n");
}

TEST_F(ConvertTags, adds_names_of_bits_that_another_manual_prints)
{
    source("690plus.csv", std::string{kDrive} + "272,7k,COMMS STATUS,WORD,0,0000,FFFF,ro,manual\n");

    ASSERT_EQ(convert().status, 0);

    EXPECT_EQ(written("690plus.csv"),
              std::string{kTable} +
                  "272,COMMS STATUS,WORD,,0000,FFFF,ro,,,,bit0=Ready;bit1=Switched "
                  "on;bit2=Running;bit3=Tripped;bit4=Not voltage disabled;bit5=Not quick "
                  "stop;bit6=Switch on disabled;bit9=Remote,,manual; bits by the 690+ product manual "
                  "page 4-6\n");
}

struct BadSource {
    const char* content;
    const char* message;
};

void PrintTo(const BadSource& bad, std::ostream* out)
{
    *out << test::case_name(bad.message);
}

class BadTagSource : public ConvertTags, public testing::WithParamInterface<BadSource> {};

TEST_P(BadTagSource, is_refused_with_its_line_and_no_table_is_touched)
{
    folder_.write("to/a.csv", "as it was\n");
    source("a.csv", std::string{kController} + "1,Good,Home,ro,enum,,\n");
    source("b.csv", GetParam().content);

    const Ended ended = convert();

    EXPECT_EQ(ended.status, 1);
    EXPECT_THAT(ended.output, HasSubstr(GetParam().message));
    EXPECT_EQ(written("a.csv"), "as it was\n");
    EXPECT_FALSE(is_written("b.csv"));
}

INSTANTIATE_TEST_SUITE_P(
    rows, BadTagSource,
    testing::Values(
        BadSource{"tag,name,section,access,type,enum,notes\n1,A,H,ro,float,,\n",
                  "b.csv:2: type 'float': scaled, word, enum or bits is wanted."},
        BadSource{"tag,name,section,access,type,enum,notes\n1,A,H,ro,enum,,\n2,A,H,maybe,enum,,\n",
                  "b.csv:3: access 'maybe'"},
        BadSource{"tag,name,section,access,type,enum,notes\n70000,A,H,ro,enum,,\n", "b.csv:2: tag '70000'"},
        BadSource{"tag,name,section,access,type,enum,notes\n1,A,H,ro,bits,bit16=x,\n", "bit0 to bit15"},
        BadSource{"tag,name,section,access,type,enum,notes\n1,A,H,ro,enum,Off,\n", "value=label"},
        BadSource{"tag,name,section,access,type,enum,notes\n1,A,H,ro\n", "another number of cells"},
        BadSource{"tag,name,section,access,type,enum,notes\n1,\xC3\x86,H,ro,enum,,\n", "is not ASCII"},
        BadSource{"tag,mnemonic,name,type,decimals,min,max,access,source\n1,ab,A,WORD,0,0,70000,ro,m\n",
                  "limits of a WORD are hexadecimal"},
        BadSource{"tag,mnemonic,name,type,decimals,min,max,access,source\n1,ab,A,FLOAT,0,0,1,ro,m\n",
                  "type 'FLOAT'"}));

TEST_F(ConvertTags, prints_its_usage_and_requires_folders)
{
    const Ended help = run("--help");
    EXPECT_EQ(help.status, 0);
    EXPECT_THAT(help.output, HasSubstr("folder with the source tables"));

    EXPECT_EQ(run("").status, 2);
    EXPECT_EQ(run("'" + (folder_.path() / "absent").string() + "'").status, 2);
}

} // namespace
} // namespace dpslave
