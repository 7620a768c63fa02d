// SPDX-License-Identifier: Apache-2.0
// The tag tables of config/tags as files, and those of the drives against what public pages of their manuals
// print.
#include "files.hpp"
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

#include <regex>

namespace dpslave {
namespace {

using drive::Access;
using drive::MnemonicRule;
using drive::Tag;
using drive::TagType;
using testing::Contains;
using testing::HasSubstr;

const std::filesystem::path kTags = test::source_path("config/tags");

drive::TagTable load_table(const std::string& file)
{
    auto tags = profile::load_tags(io::read_regular_file, kTags / file);
    EXPECT_TRUE(tags) << to_string(tags.error().at(0));
    return tags ? *std::move(tags) : drive::TagTable{};
}

std::string mnemonic(std::uint16_t number, MnemonicRule rule)
{
    const auto two = drive::mnemonic_by_rule(number, rule);
    return two ? std::string{two->begin(), two->end()} : "";
}

class ShippedTable : public testing::TestWithParam<const char*> {};

TEST_P(ShippedTable, can_be_read_and_is_plain_ASCII_with_line_feeds)
{
    EXPECT_TRUE(profile::load_tags(io::read_regular_file, kTags / GetParam()));
    for (const char c : test::content_of(kTags / GetParam()))
        EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
}

TEST_P(ShippedTable, writes_the_limits_of_a_word_in_hexadecimal)
{
    const std::regex word_row{R"(^[0-9]+,("[^"]*"|[^,"]*),WORD,([^,]*),([^,]*),([^,]*),.*)"};
    const std::regex hexadecimal{"(0x)?[0-9A-F]{4}"};
    std::istringstream lines{test::content_of(kTags / GetParam())};
    for (std::string line; std::getline(lines, line);) {
        if (line.find(",WORD,") == std::string::npos) continue;
        std::smatch cells;
        ASSERT_TRUE(std::regex_match(line, cells, word_row)) << line;
        EXPECT_TRUE(std::regex_match(cells[3].str(), hexadecimal)) << line;
        EXPECT_TRUE(std::regex_match(cells[4].str(), hexadecimal)) << line;
    }
}

INSTANTIATE_TEST_SUITE_P(files, ShippedTable,
                         testing::Values("2400.csv", "590plus.csv", "690plus.csv", "650v.csv", "empty.csv",
                                         "example.csv"));

TEST(ShippedTables, are_these_and_no_others)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator{kTags})
        if (entry.path().extension() == ".csv") names.push_back(entry.path().filename().string());
    EXPECT_THAT(names, testing::UnorderedElementsAre("2400.csv", "590plus.csv", "690plus.csv", "650v.csv",
                                                     "empty.csv", "example.csv"));
    EXPECT_TRUE(load_table("empty.csv").all().empty())
        << "no table of a 605 or 584SV is public: no tag is made up";
}

TEST(ShippedTables, of_the_590plus_have_the_tags_and_mnemonics_that_its_manual_prints)
{
    const drive::TagTable tags = load_table("590plus.csv");
    struct Row {
        std::uint16_t number;
        const char* name;
        TagType type;
        Access access;
        const char* mnemonic;
    };
    const std::vector<Row> rows{{12, "HEALTHY (output)", TagType::boolean, Access::read_only, "ac"},
                                {17, "AT ZERO SPEED (output)", TagType::boolean, Access::read_only, "ah"},
                                {130, "P3 MODE", TagType::enumeration, Access::read_write, "dm"},
                                {198, "P3 BAUD RATE", TagType::enumeration, Access::read_write, "fi"},
                                {536, "REM. SEQUENCE", TagType::word, Access::read_write, "ow"},
                                {537, "SEQ STATUS", TagType::word, Access::read_only, "ox"},
                                {559, "READY (output)", TagType::boolean, Access::read_only, "pj"}};
    for (const Row& row : rows) {
        const Tag* found = tags.find(row.number);
        ASSERT_NE(found, nullptr) << row.number;
        EXPECT_EQ(found->name, row.name);
        EXPECT_EQ(found->type, row.type);
        EXPECT_EQ(found->access, row.access);
        EXPECT_EQ(mnemonic(row.number, MnemonicRule::dc_590plus), row.mnemonic)
            << "by the rule of the profile";
        EXPECT_TRUE(found->mnemonic.empty() || found->mnemonic == row.mnemonic);
    }
    EXPECT_EQ(tags.all().size(), rows.size());
    EXPECT_EQ(displayed(*tags.find(537), 0x1B0B),
              ">1B0B (Coast stop, Program stop, Run, Running, Enabled, Healthy, Ready)");
    EXPECT_EQ(parse_value(*tags.find(536), "start").word, 0x0203);
    EXPECT_EQ(displayed(*tags.find(536), 0x0200), ">0200 (Disable)");
}

TEST(ShippedTables, of_the_ac_drives_have_the_command_and_status_words)
{
    for (const char* file : {"690plus.csv", "650v.csv"}) {
        const drive::TagTable tags = load_table(file);
        for (const std::uint16_t number : std::initializer_list<std::uint16_t>{271, 272, 273}) {
            const Tag* found = tags.find(number);
            ASSERT_NE(found, nullptr) << file << ' ' << number;
            EXPECT_EQ(found->type, TagType::word);
            EXPECT_THAT(found->name, HasSubstr(number == 272 ? "COMMS STATUS" : "COMMS COMMAND"));
            EXPECT_EQ(found->access, number == 271 ? Access::unknown : Access::read_only)
                << "whether 271 can be read is not said: the drive decides";
        }
    }
    EXPECT_EQ(displayed(*load_table("690plus.csv").find(272), 0x0008), ">0008 (Tripped)");
    EXPECT_EQ(mnemonic(271, MnemonicRule::ac), "7j");
    EXPECT_EQ(mnemonic(272, MnemonicRule::ac), "7k");
}

TEST(ShippedTables, of_the_650V_keep_the_printed_mnemonic_and_say_where_decimals_are_not_known)
{
    const drive::TagTable tags = load_table("650v.csv");
    ASSERT_NE(tags.find(348), nullptr);
    EXPECT_EQ(tags.find(348)->mnemonic, "9o");
    EXPECT_EQ(tags.find(348)->decimals, 2);
    EXPECT_EQ(mnemonic(348, MnemonicRule::ac), "9o");
    ASSERT_NE(tags.find(269), nullptr);
    EXPECT_THAT(tags.find(269)->notes, HasSubstr("decimals not stated"));
    ASSERT_NE(tags.find(300), nullptr);
    EXPECT_EQ(tags.find(300)->access, Access::read_write);
    EXPECT_THAT(tags.find(300)->notes, HasSubstr("writable in: configuration mode"));
    EXPECT_EQ(tags.all().size(), 21U);
}

} // namespace
} // namespace dpslave
