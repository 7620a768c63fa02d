// SPDX-License-Identifier: Apache-2.0
// The tag table of the 2408f and 2404f against chapter 8 of their PROFIBUS handbook (C-100 to C-129).
// chapter_8.txt is the chapter kept by itself; the programs are reckoned here.
#include "files.hpp"
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace dpslave {
namespace {

using drive::Access;
using drive::Tag;
using drive::TagType;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kSource{test::source_path()};

const drive::TagTable& table()
{
    static const drive::TagTable tags = [] {
        auto read = profile::load_tags(io::read_regular_file, kSource / "config/tags/2400.csv");
        EXPECT_TRUE(read) << to_string(read.error().at(0));
        return read ? *std::move(read) : drive::TagTable{};
    }();
    return tags;
}

const Tag& tag(int number)
{
    static const Tag absent;
    const Tag* found = table().find(static_cast<std::uint16_t>(number));
    EXPECT_NE(found, nullptr) << number;
    return found != nullptr ? *found : absent;
}

/// "0=Auto;1=Manual", "bit0=...": as the table writes them.
std::string labels_of(const Tag& tag)
{
    std::string out;
    for (const drive::Label& label : tag.labels)
        out += (out.empty() ? "" : ";") + std::string{label.is_bit ? "bit" : ""} +
               std::to_string(label.number) + "=" + label.text;
    return out;
}

struct Printed {
    std::uint16_t number = 0;
    std::string kind, access, name, values;
};

struct Group {
    std::string row; ///< "C-100"
    std::string tab;
    std::vector<Printed> tags;
};

void PrintTo(const Group& group, std::ostream* out)
{
    *out << test::case_name(group.row);
}

std::vector<Group> chapter_8()
{
    std::vector<Group> groups;
    std::istringstream lines{test::content_of(kSource / "tests/profile/chapter_8.txt")};
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words{line};
        if (line.empty() || line[0] == '#') continue;
        if (line.starts_with("C-")) {
            groups.push_back({});
            words >> groups.back().row;
            std::getline(words >> std::ws, groups.back().tab);
            continue;
        }
        Printed printed;
        words >> printed.number >> printed.kind >> printed.access;
        std::getline(words >> std::ws, printed.name);
        if (const auto bar = printed.name.find(" | "); bar != std::string::npos) {
            printed.values = printed.name.substr(bar + 3);
            printed.name.resize(bar);
        }
        groups.back().tags.push_back(printed);
    }
    return groups;
}

std::string kind_of(const Tag& tag)
{
    if (tag.type == TagType::word) return "word";
    if (tag.type == TagType::enumeration) return "choice";
    if (tag.type != TagType::number || tag.decimals != 0) return "?";
    if (tag.is_real) return tag.follows_display ? "display" : "number";
    return tag.is_unsigned ? "natural" : "?";
}

std::string access_of(const Tag& tag)
{
    switch (tag.access) {
        case Access::unknown: return "-";
        case Access::read_only: return "ro";
        case Access::read_write: return "rw";
        case Access::write_only: return "wo";
    }
    return "?";
}

class Chapter8 : public testing::TestWithParam<Group> {};

TEST_P(Chapter8, every_tag_has_its_name_type_access_and_the_names_of_its_values_or_bits)
{
    ASSERT_FALSE(GetParam().tags.empty());
    for (const Printed& printed : GetParam().tags) {
        SCOPED_TRACE(GetParam().tab + ", tag " + std::to_string(printed.number));
        const Tag& found = tag(printed.number);
        EXPECT_EQ(found.name, printed.name);
        EXPECT_EQ(kind_of(found), printed.kind);
        EXPECT_EQ(access_of(found), printed.access);
        EXPECT_EQ(labels_of(found), printed.values);
        EXPECT_EQ(found.modbus_register, std::nullopt) << "C-128: the tag is the Modbus address";
        EXPECT_TRUE(found.mnemonic.empty()) << "an f model has no EI-Bisynch";
    }
}

INSTANTIATE_TEST_SUITE_P(rows, Chapter8, testing::ValuesIn(chapter_8()));

TEST(Chapter8Table, has_the_tags_of_the_chapter_and_the_programs_and_no_others)
{
    std::set<std::uint16_t> expected;
    for (const Group& group : chapter_8())
        for (const Printed& printed : group.tags)
            EXPECT_TRUE(expected.insert(printed.number).second)
                << printed.number << " stands twice in the list";
    EXPECT_EQ(expected.size(), 370U) << "369 of the chapter and 12611";
    for (std::uint16_t number = 8192; number <= 8871; ++number) expected.insert(number);

    std::set<std::uint16_t> found;
    for (const Tag& each : table().all()) found.insert(each.number);

    EXPECT_EQ(found, expected);
}

TEST(Chapter8Table, has_its_tags_in_the_order_of_the_chapter)
{
    std::vector<std::uint16_t> expected, found;
    for (const Group& group : chapter_8())
        for (const Printed& printed : group.tags) expected.push_back(printed.number);
    for (const Tag* each : table().in_table_order())
        if (each->number < 8192 || each->number > 8871) found.push_back(each->number);

    EXPECT_EQ(found, expected);
    EXPECT_THAT(
        test::content_of(kSource / "config/tags/2400.csv"),
        testing::ContainsRegex("\n62,Dwell segment,[^\n]*\n517,Goto,[^\n]*\n57,Programmer state write,"))
        << "the further names stand where the chapter prints them too";
}

TEST(Chapter8Table, says_which_tags_are_written_in_configuration_mode_only)
{
    for (const int number : {517, 525, 12550})
        EXPECT_EQ(tag(number).when, drive::WritableWhen::configuration);
    for (const int number : {1, 24, 270, 8200, 199})
        EXPECT_EQ(tag(number).when, drive::WritableWhen::not_said);
}

TEST(Chapter8Table, keeps_both_names_of_a_tag_that_is_printed_twice_the_first_meaning_first)
{
    const std::map<std::uint16_t, std::pair<std::string, std::string>> twice{
        {57, {"Fast run", "Programmer state write"}},
        {62, {"VP bounded sensor break", "Dwell segment"}},
        {517, {"Programmer type", "Goto"}},
        {23, {"Program status", "Programmer state read"}}};
    for (const auto& [number, names] : twice) {
        EXPECT_EQ(tag(number).name, names.first);
        EXPECT_THAT(tag(number).aliases, ElementsAre(names.second)) << number;
        const auto by_alias = table().search(names.second);
        ASSERT_EQ(by_alias.size(), 1U) << names.second;
        EXPECT_EQ(by_alias[0]->number, number);
    }
    EXPECT_EQ(labels_of(tag(57)), "0=No;1=Yes") << "the values of the first meaning";
    EXPECT_EQ(labels_of(tag(517)), "0=None;1=Single program;4=Four programs");

    for (const int same : {12694, 162}) EXPECT_THAT(tag(same).aliases, IsEmpty()) << "one meaning, one name";
    std::size_t with_alias = 0;
    for (const Tag& each : table().all()) with_alias += each.aliases.empty() ? 0U : 1U;
    EXPECT_EQ(with_alias, twice.size());
}

TEST(Chapter8Table, names_the_bits_that_are_set_and_says_in_the_notes_what_0_and_1_mean)
{
    EXPECT_EQ(displayed(tag(75), 0x4030), ">4030 (Manual mode, Sensor break, IP1 fault)")
        << "the diagnosis example of chapter 4";
    EXPECT_THAT(tag(75).notes, HasSubstr("bits 0-3: 0=Safe 1=Alarm; bit 4: 0=Auto 1=Manual"));
    EXPECT_THAT(tag(75).notes, HasSubstr("bit 12: 0=Waiting 1=Running"));
    EXPECT_EQ(displayed(tag(75), 0x8000), ">8000") << "reserved";
    EXPECT_EQ(displayed(tag(76), 0x1008), ">1008 (Self tune failed, Autotune enabled)");
    EXPECT_EQ(displayed(tag(77), 0xFFE0), ">FFE0") << "eleven reserved bits";
    EXPECT_EQ(displayed(tag(87), 0x0020), ">0020 (1B module)") << "X-42: the 1B input";
    EXPECT_EQ(displayed(tag(551), 0x0018), ">0018 (LB logic telemetry, LA logic telemetry)");
    EXPECT_EQ(displayed(tag(270), 1), "1 (Tune)");
}

TEST(Chapter8Table, shows_values_that_are_not_printed_as_numbers_and_takes_them)
{
    struct Gap {
        std::uint16_t number, value, printed;
        const char* label; ///< of `printed`
    };
    for (const Gap& gap :
         {Gap{524, 4, 5, "On/off"},
          Gap{535, 3, 4, "Remote trim + local setpoint"}, // X-42 from here on
          Gap{536, 3, 2, "Full scale high"}, Gap{536, 15, 16, "Deviation band"},
          Gap{536, 19, 18, "Deviation low"}, Gap{536, 33, 34, "Load current low"},
          Gap{12355, 221, 220, "Program waits at end of segment"}, Gap{12355, 222, 223, "Run/Hold"},
          Gap{12355, 228, 227, "Advance to end of segment"}, Gap{12355, 239, 240, "Amps"},
          Gap{12611, 132, 133, "PDSIO SP retransmission no holdback"}, Gap{12830, 19, 18, "Custom mA"}}) {
        SCOPED_TRACE(gap.number);
        EXPECT_EQ(displayed(tag(gap.number), gap.value), std::to_string(gap.value));
        EXPECT_EQ(displayed(tag(gap.number), gap.printed),
                  std::to_string(gap.printed) + " (" + gap.label + ")");
        const auto parsed = parse_value(tag(gap.number), std::to_string(gap.value));
        EXPECT_EQ(parsed.error, AccessError::none);
        EXPECT_EQ(parsed.word, gap.value);
    }
}

TEST(Chapter8Table, has_the_module_function_of_JA_that_is_printed_without_a_tag)
{
    EXPECT_EQ(tag(12611).name, "JA module function");
    EXPECT_THAT(tag(12611).notes, HasSubstr("WITHOUT a tag; 12611 comes from HA026230"));
}

TEST(Chapter8Table, keeps_the_remarks_of_the_chapter)
{
    EXPECT_THAT(tag(3).notes, HasSubstr("-100 (cool), 0 (off) or 100 (heat) per cent"));
    EXPECT_THAT(tag(5).notes, HasSubstr("change tag 2 or the selected setpoint instead"));
    EXPECT_THAT(tag(60).notes, HasSubstr("writable in manual only"));
    EXPECT_THAT(tag(80).notes, HasSubstr("PDSIO mode 2"));
    EXPECT_THAT(tag(72).notes, HasSubstr("read only while gain scheduling is selected"));
    EXPECT_EQ(tag(64).name, "Power in end segment");
    EXPECT_EQ(displayed(tag(558), 8), "8 (Eight (version 1))");
    EXPECT_EQ(displayed(tag(558), 1), "1 (Eight (versions 2 and 3))");
    EXPECT_THAT(tag(12483).notes, HasSubstr("2 and 3 on 2208/2204 only"));
    for (const int function : {12675, 12739, 12803})
        EXPECT_THAT(tag(function).notes, HasSubstr("depends on the identity")) << function;
    for (const int off : {8, 9, 49, 51, 83, 35, 37, 101, 103})
        EXPECT_EQ(displayed(tag(off), 0), "0 (Off)") << off;
    for (const int automatic : {17, 18, 117, 118, 45, 89})
        EXPECT_EQ(displayed(tag(automatic), 0), "0 (Auto)") << automatic;
}

TEST(Chapter8Table, marks_the_instrument_mode_read_only_and_says_why)
{
    EXPECT_EQ(tag(199).access, Access::read_only);
    EXPECT_THAT(tag(199).notes, HasSubstr("never write other values"));
}

TEST(Chapter8Table, has_an_access_only_where_a_source_says_it_and_names_the_place_in_the_handbook)
{
    for (int setpoint = 167; setpoint <= 177; ++setpoint)
        EXPECT_THAT(tag(setpoint).notes, HasSubstr("access: the remark on tag 5 in chapter 8")) << setpoint;
    for (const int term : {48, 49, 51})
        EXPECT_THAT(tag(term).notes, HasSubstr("access: chapter 7 of the handbook")) << term;

    const auto& all = table().all();
    EXPECT_EQ(
        std::count_if(all.begin(), all.end(), [](const Tag& each) { return each.access == Access::unknown; }),
        421);
}

TEST(Chapter8Table, names_the_words_of_the_standard_mapping)
{
    EXPECT_THAT(tag(3).notes, HasSubstr("default PROFIBUS input \"Output 1\""));
    for (const int input : {1, 5, 75})
        EXPECT_THAT(tag(input).notes, HasSubstr("default PROFIBUS input")) << input;
    for (const int output : {24, 25, 15, 274})
        EXPECT_THAT(tag(output).notes, HasSubstr("default PROFIBUS output")) << output;
}

// --- The ramp/dwell programs ---

constexpr std::array<std::uint16_t, 5> kBases{8192, 8328, 8464, 8600, 8736}; // C-122, as printed

struct Word {
    const char* name;
    TagType type;
    const char* labels;
};

// C-123 and C-124.
constexpr Word kGeneral[] = {{"Holdback type", TagType::enumeration, "0=None;1=Low;2=High;3=Band"},
                             {"Holdback value", TagType::number, ""},
                             {"Ramp units", TagType::enumeration, "0=Secs;1=Mins;2=Hours"},
                             {"Dwell units", TagType::enumeration, "0=Secs;1=Mins;2=Hours"},
                             {"Program cycles", TagType::number, ""},
                             {"Reserved", TagType::word, ""},
                             {"Reserved", TagType::word, ""},
                             {"Reserved", TagType::word, ""}};
constexpr Word kSegment[] = {
    {"Segment type", TagType::enumeration, "0=End;1=Ramp rate;2=Ramp time to target;3=Dwell;4=Step;5=Call"},
    {"Target setpoint", TagType::number, ""},
    {"Duration or rate", TagType::number, ""},
    {"Program number or end type", TagType::number,
     "0=Reset (end);1=Indefinite dwell (end);2=Set output (end)"},
    {"Logic outputs or call cycles", TagType::word, ""},
    {"Unused", TagType::word, ""},
    {"Unused", TagType::word, ""},
    {"Unused", TagType::word, ""}};

TEST(Chapter8Programs, are_five_of_17_blocks_of_8_words_each_with_its_name_type_and_values)
{
    std::size_t rows = 0;
    for (std::size_t program = 0; program < kBases.size(); ++program)
        for (unsigned block = 0; block <= 16; ++block)
            for (unsigned word = 0; word < 8; ++word) {
                const auto number = static_cast<std::uint16_t>(kBases[program] + 8 * block + word);
                const Word& expected = block == 0 ? kGeneral[word] : kSegment[word];
                const std::string name = "Program " + std::to_string(program) +
                                         (block == 0 ? " general" : " segment " + std::to_string(block)) +
                                         ": " + expected.name;
                SCOPED_TRACE(number);
                EXPECT_EQ(tag(number).name, name);
                EXPECT_EQ(tag(number).type, expected.type);
                EXPECT_EQ(labels_of(tag(number)), expected.labels);
                EXPECT_EQ(tag(number).section, "Program " + std::to_string(program));
                ++rows;
            }
    EXPECT_EQ(rows, 680U);
}

TEST(Chapter8Programs, have_the_addresses_of_the_examples_and_the_right_one_of_the_misprint)
{
    EXPECT_EQ(tag(8360).name, "Program 1 segment 4: Segment type");
    EXPECT_EQ(tag(8465).name, "Program 2 general: Holdback value");
    EXPECT_EQ(tag(8867).name, "Program 4 segment 16: Program number or end type") << "X-22: not 9003";
    EXPECT_EQ(table().find(9003), nullptr);
    EXPECT_EQ(table().find(8872), nullptr);
}

TEST(Chapter8Programs, say_that_program_0_is_not_stored_and_which_segments_use_a_word)
{
    EXPECT_THAT(tag(8192).notes, HasSubstr("writable in hold only and not stored"));
    EXPECT_THAT(tag(8328).notes, testing::Not(HasSubstr("hold only")));
    EXPECT_THAT(tag(8337).notes, HasSubstr("Step and Ramp segments"));
    EXPECT_THAT(tag(8338).notes, HasSubstr("Dwell: duration; Ramp rate: rate; Ramp time: duration"));
    EXPECT_THAT(tag(8339).notes, HasSubstr("Call: program number; End: end type"));
    EXPECT_THAT(tag(8340).notes, HasSubstr("Step, Dwell, Ramp, End: logic outputs; Call: call cycles"));
    for (const int writable : {8192, 8200, 8337, 8338, 8339, 8340})
        EXPECT_EQ(tag(writable).access, Access::read_write) << "X-39: the controller refuses what it refuses";
}

} // namespace
} // namespace dpslave
