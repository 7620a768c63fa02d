// SPDX-License-Identifier: Apache-2.0
#include "files.hpp"
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using input::Faults;
using profile::load_profile;
using profile::Profile;
using test::Folder;
using test::with;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kShipped = test::source_path("config/profiles");

class OwnProfile : public testing::Test {
protected:
    OwnProfile()
    {
        for (const char* table : {"example.csv", "empty.csv", "690plus.csv", "2400.csv"})
            folder_.write(std::string{"tags/"} + table, "tag,name\n55,SPEED\n");
    }

    Result<Profile, Faults> load(std::string_view content)
    {
        folder_.write("profiles/own.toml", content);
        return load_profile(io::read_regular_file, folder_.path() / "profiles", "own");
    }

    static std::string shipped(const std::string& name)
    {
        return test::content_of(kShipped / (name + ".toml"));
    }

    Folder folder_;
    const std::string good_ = shipped("590");
};

TEST_F(OwnProfile, a_copy_of_a_shipped_one_is_a_profile_of_its_own_with_the_table_beside_it)
{
    const auto profile = load(good_);

    ASSERT_TRUE(profile);
    EXPECT_EQ(profile->name, "own");
    ASSERT_NE(profile->tags.find(55), nullptr);
    EXPECT_EQ(profile->tags.find(55)->name, "SPEED");
}

TEST_F(OwnProfile, may_leave_the_ident_open_and_support_fewer_rates)
{
    const auto profile = load(with(with(good_, "ident = 0x0533", ""), "1500000 = 150", ""));

    ASSERT_TRUE(profile);
    EXPECT_EQ(profile->ident, std::nullopt);
    EXPECT_EQ(profile->personality.ident, 0);
    EXPECT_EQ(profile->personality.max_tsdr[index_of(Baud::k1500)], 0_tbit);
}

TEST_F(OwnProfile, may_be_a_device_without_demand_data_that_refuses_unlisted_tags_and_holds_its_outputs)
{
    std::string text = with(good_, "form       = \"basic\"", "form = \"none\"");
    text = with(with(text, "identifier = 0x73", ""), "error_base = 0", "");
    text = with(with(text, "unlisted_tags = \"ask\"", "unlisted_tags = \"refuse\""), "output_loss = \"zero\"",
                "output_loss = \"hold\"");
    text = with(text, "[gsd]\n", "[gsd]\nin_out_module = \"Both ways\"\n");
    const auto profile = load(with(text, "[0x50, 0x60]", "[0x50, 0x60, 0x70, 0xD0, 0x11]"));

    ASSERT_TRUE(profile) << to_string(profile.error().at(0));
    EXPECT_EQ(profile->personality.demand, dp::DemandForm::none);
    EXPECT_EQ(profile->personality.demand_identifier, 0);
    EXPECT_TRUE(profile->tags_only_from_table);
    EXPECT_EQ(profile->zero_after, std::nullopt);
    ASSERT_EQ(profile->personality.identifiers.size(), 5U);
    EXPECT_TRUE(profile->personality.identifiers[2].reads && profile->personality.identifiers[2].writes);
    EXPECT_TRUE(profile->personality.identifiers[3].reads) << "0xD0: one word in, consistent";
    EXPECT_TRUE(profile->personality.identifiers[4].reads) << "0x11: two octets in";
}

struct BadChange {
    const char* from;
    const char* to;
    const char* sentence;
    std::ptrdiff_t column;    ///< of the fault in the line that was changed; 0 = the fault stands elsewhere
    const char* base = "590"; ///< the profile that is changed
};

void PrintTo(const BadChange& change, std::ostream* out)
{
    *out << test::case_name(std::string{change.sentence} + " for " + change.from + " made " + change.to);
}

class BadProfile : public OwnProfile, public testing::WithParamInterface<BadChange> {};

TEST_P(BadProfile, is_refused_with_place_and_remedy)
{
    const BadChange& change = GetParam();
    const std::string good = shipped(change.base);
    const auto line =
        1 +
        std::count(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.find(change.from)), '\n');

    const auto profile = load(with(good, change.from, change.to));

    ASSERT_FALSE(profile);
    ASSERT_EQ(profile.error().size(), 1U) << to_string(profile.error()[1]);
    EXPECT_THAT(profile.error()[0].file, EndsWith("profiles/own.toml"));
    EXPECT_THAT(profile.error()[0].what, HasSubstr(change.sentence));
    if (change.column > 0) {
        EXPECT_EQ(profile.error()[0].line, line);
        EXPECT_EQ(profile.error()[0].column, change.column);
    }
}

INSTANTIATE_TEST_SUITE_P(
    keys, BadProfile,
    testing::Values(
        BadChange{"ident = 0x0533", "iden = 0x0533", "did you mean 'ident'?", 1},
        BadChange{"ident = 0x0533", "ident = 0x10533", "from 1 to 65535", 9},
        BadChange{"ident = 0x0533", "ident = \"0x0533\"", "not \"0x0533\"", 9},
        BadChange{"manual     = \"HA389815\"", "", "'manual' is missing", 0},
        BadChange{"protocols = [\"ei-ascii\"]", "protocols = [\"ei-bisynch\"]", "\"modbus-rtu\"", 13},
        BadChange{"protocols = [\"ei-ascii\"]", "protocols = []", "one at least", 13},
        BadChange{"mnemonic_rule = \"590plus\"", "mnemonic_rule = \"590\"",
                  "\"590plus\", \"ac\", \"pno\" or \"none\"", 17},
        BadChange{"tag_table = \"empty.csv\"", "tag_table = \"../x.csv\"", "without a folder", 13},
        BadChange{"unlisted_tags = \"ask\"", "unlisted_tags = \"refused\"", "Did you mean \"refuse\"?", 17},
        BadChange{"output_loss = \"zero\"", "output_loss = true", "\"zero\" or \"hold\"", 15},
        BadChange{"leds = \"option_board\"", "leds = \"board\"", "\"option_board_620\"", 8},
        BadChange{"min = 0", "min = 126", "from 0 to 125", 7},
        BadChange{"max = 125", "max = -1", "from 0 to 125", 7},
        BadChange{"min = 0\nmax = 125", "min = 9\nmax = 8", "'min' is above 'max'", 7},
        BadChange{"9600    = 60", "9601    = 60", "did you mean '9600'?", 1},
        BadChange{"9600    = 60", "9600    = 10", "from 11 to 65535", 11},
        BadChange{"[0x50, 0x60]", "[0x50, 0x61]", "identifier 0x61 is not one word", 26},
        BadChange{"[0x50, 0x60]", "[0x50, 0x00]", "identifier 0x00 is not one word", 26},
        BadChange{"[0x50, 0x60]", "[0x50, 0x50]", "is listed twice", 26},
        BadChange{"[0x50, 0x60]", "[0x50, 256]", "from 0 to 255", 33},
        BadChange{"max_parameters         = 12", "max_parameters = 118", "from 1 to 117", 18},
        BadChange{"max_parameters         = 12", "max_parameters = 13", "that takes 26 octets", 0},
        BadChange{"may_have_no_parameters = true", "may_have_no_parameters = 1", "true or false", 26},
        BadChange{"form       = \"basic\"", "form = \"extend\"", "Did you mean \"extended\"?", 8},
        BadChange{"identifier = 0x73", "identifier = 0x72", "0x73 is", 14},
        BadChange{"identifier = 0x73", "", "'identifier' is missing in [demand_data]", 0},
        BadChange{"error_base = 0", "error_base = 2", "from 0 to 1", 14},
        BadChange{"min_length    = 24", "min_length = 25", "above 'max_length'", 14},
        BadChange{"max_length    = 24", "max_length = 238", "from 0 to 237", 14},
        BadChange{"dpv1_status   = false", "dpv1_status = true", "'tags_at' must be 3 or more", 0},
        BadChange{"max_tag       = 2047", "max_tag = 0", "from 1 to 65535", 11},
        BadChange{"tag_list = \"first_zero_ends\"", "tag_list = \"first_zero_end\"",
                  "Did you mean \"first_zero_ends\"?", 12},
        BadChange{"sync      = true", "synch = true\nsync = true", "did you mean 'sync'?", 1},
        BadChange{"[slave_diag]\nmax_length = 6", "[slave_diag]\nmax_length = 5", "from 6 to 244", 0},
        BadChange{"[global_control]", "[global_controls]\n[global_control]", "did you mean 'global_control'?",
                  2},
        BadChange{"ident = 0x0533", "ident = ", "not TOML", 0}));

INSTANTIATE_TEST_SUITE_P(
    technology_box_keys, BadProfile,
    testing::Values(
        BadChange{"leds = \"technology_box\"", "leds = \"technology box\"",
                  "Did you mean \"technology_box\"?", 8, "690plus"},
        BadChange{"leds = \"technology_box\"", "leds = \"technology_box\"\noutput_loss = \"zero\"",
                  "RIDE THROUGH alone decides", 0, "690plus"},
        BadChange{"health = \"!272.3\"", "health = \"272.16\"", "'health' is not a bit of a tag", 10,
                  "690plus"},
        BadChange{"health = \"!272.3\"", "health = 272.3", "a text in quotes", 10, "690plus"},
        BadChange{"run    = \"272.2\"", "run = \"status.2\"", "'run' is not a bit of a tag", 7, "690plus"},
        BadChange{"run    = \"272.2\"", "running = \"272.2\"", "unknown key 'running' in [tec]", 1,
                  "690plus"},
        BadChange{"mnemonic_rule = \"ac\"", "mnemonic_rule = \"none\"",
                  "'mnemonic_source' has a meaning only where mnemonic_rule is not \"none\"", 0, "690plus"},
        BadChange{"option_software = \"Version 3.x\"", "option_software = 3", "a text in quotes", 19,
                  "690plus"},
        BadChange{"max_length = 10", "max_length = 9", "that takes 10 octets", 14, "690plus"},
        BadChange{"form       = \"trip_code\"", "form = \"trip\"",
                  "\"trip_code\", \"tripped\" or \"status_word\"", 8, "690plus"},
        BadChange{"form       = \"trip_code\"", "form = \"trip_code\"\nstatus_tag = 75",
                  "only with form = \"status_word\"", 0, "690plus"},
        BadChange{"max_length = 6\nform       = \"none\"", "max_length = 10\nform = \"trip_code\"",
                  "add the table [tec]", 0},
        BadChange{"leds = \"option_board\"", "leds = \"technology_box\"", "add the table [tec]", 8},
        BadChange{"in_out_module = \"Process-Data-In-Output\"", "", "'in_out_module' is missing in [gsd]", 0,
                  "690plus"}));

INSTANTIATE_TEST_SUITE_P(
    controller_keys, BadProfile,
    testing::Values(
        BadChange{"never_written = [199]", "never_written = 199", "a list of whole numbers", 17, "2408f"},
        BadChange{"never_written = [199]", "never_written = [0]", "from 1 to 65535", 18, "2408f"},
        BadChange{"selectable_resolution = true", "selectable_resolution = \"full\"", "true or false", 25,
                  "2408f"},
        BadChange{"max_words              = 117", "max_words = 116", "below 'max_parameters'", 13, "2408f"},
        BadChange{"max_words              = 117", "max_words = 7", "from 8 to 244", 13, "2408f"},
        BadChange{"extended_reply = \"table\"", "extended_reply = \"tables\"", "Did you mean \"table\"?", 18,
                  "2408f"},
        BadChange{"form           = \"extended\"", "form = \"basic\"", "only with form = \"extended\"", 0,
                  "2408f"},
        BadChange{"max_length = 9", "max_length = 8", "that takes 9 octets", 14, "2408f"},
        BadChange{"status_tag = 75", "", "'status_tag' is missing in [slave_diag]", 0, "2408f"},
        BadChange{"status_tag = 75", "status_tag = 0", "from 1 to 65535", 14, "2408f"},
        BadChange{"fault_mask = 0x6CEF", "fault_mask = 0x16CEF", "from 0 to 65535", 14, "2408f"},
        BadChange{"fault_mask = 0x6CEF", "", "'fault_mask' is missing in [slave_diag]", 0, "2408f"},
        BadChange{"in_tags  = [1, 5, 3, 75]", "in_tags = [1, 16384]", "from 1 to 16383", 15, "2408f"},
        BadChange{"out_tags = [24, 25, 15, 274]", "out_tags = [0]", "from 1 to 16383", 13, "2408f"}));

INSTANTIATE_TEST_SUITE_P(
    gsd_keys, BadProfile,
    testing::Values(
        BadChange{"vendor   = \"EUROTHERM\"", "", "'vendor' is missing in [gsd]", 0},
        BadChange{"model    = \"584S/590\"", "model = 590", "a text in quotes", 9},
        BadChange{"model    = \"584S/590\"", "model = \"584S, 590 and all that came after them\"",
                  "at most 32 letters", 9},
        BadChange{"revision = \"Revision_1\"", "revision = 'a \"b\"'", "without quotes", 12},
        BadChange{"hardware = \"HW_V2.0\"", "hardware = \"HW_V2.0 \xC3\xA4\"", "signs of ASCII", 12},
        BadChange{"software = \"SW_V5.0\"", "softwares = \"SW_V5.0\"\nsoftware = \"SW_V5.0\"",
                  "did you mean 'software'?", 1},
        BadChange{"# description = \"...\"", "description = \"\" #", "'description' is empty", 15},
        BadChange{"min_slave_interval = 20", "min_slave_interval = 0", "from 1 to 65535", 22},
        BadChange{"min_slave_interval = 20", "", "'min_slave_interval' is missing", 0},
        BadChange{"family   = 0", "family = 256", "from 0 to 255", 10},
        BadChange{"repeater = 2", "repeater = 3", "from 0 to 2", 12},
        BadChange{"demand_module = \"Demand-Data\"", "", "'demand_module' is missing in [gsd]", 0},
        BadChange{"in_module     = \"Process-Data-Input\"", "in_module = \"\"", "'in_module' is empty", 13},
        BadChange{"out_module    = \"Process-Data-Output\"", "", "'out_module' is missing in [gsd]", 0},
        BadChange{"file = \"590_0533.GSD\"", "file = \"gsd/590_0533.GSD\"", "without a folder", 8},
        BadChange{"# in_tags = [55, 56]", "in_tags = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13] #",
                  "13 tags together, 'max_parameters' allows 12", 11},
        BadChange{"# out_tags = [57]", "out_tags = [2048]", "from 1 to 2047", 13}));

TEST_F(OwnProfile, with_a_function_block_has_no_output_loss_and_may_leave_its_lamps_out)
{
    const std::string box = shipped("690plus");
    const auto profile =
        load(with(with(box, "health = \"!272.3\"", ""), "run    = \"272.2\"", "run = \"12\""));

    ASSERT_TRUE(profile) << to_string(profile.error().at(0));
    EXPECT_TRUE(profile->has_tec);
    EXPECT_EQ(profile->health, profile::MirroredLamp{});
    EXPECT_EQ(profile->run, (profile::MirroredLamp{12, 0xFFFF, false}));
    EXPECT_EQ(profile->zero_after, std::chrono::nanoseconds{0}) << "until RIDE THROUGH is known";
}

TEST_F(OwnProfile, may_leave_out_the_form_of_the_diagnosis_and_what_the_gsd_need_not_say)
{
    std::string text = with(good_, "form       = \"none\"", "");
    text = with(with(text, "family   = 0", ""), "repeater = 2", "repeater = 1");
    text = with(text, "file = \"590_0533.GSD\"", "description = \"of this site\"\nin_tags = [55]");
    const auto profile = load(text);

    ASSERT_TRUE(profile) << to_string(profile.error().at(0));
    EXPECT_EQ(profile->diagnosis, profile::DiagForm::none);
    EXPECT_EQ(profile->personality.diag_octets, 0);
    EXPECT_EQ(profile->gsd.family, 0);
    EXPECT_EQ(profile->gsd.repeater, 1);
    EXPECT_TRUE(profile->gsd.file.empty());
    EXPECT_EQ(profile->gsd.description, "of this site");
    EXPECT_THAT(profile->gsd.in_tags, ElementsAre(55));
}

TEST_F(OwnProfile, may_answer_the_extended_commands_as_the_worked_example_does)
{
    const auto profile =
        load(with(shipped("2408f"), "extended_reply = \"table\"", "extended_reply = \"example\""));

    ASSERT_TRUE(profile) << to_string(profile.error().at(0));
    EXPECT_EQ(profile->personality.extended_reply, dp::ExtendedReply::example);
}

TEST_F(OwnProfile, of_a_new_device_is_a_file_and_a_table_and_no_code)
{
    // A pump that no shipped profile describes: two identifiers of its own, ten parameters, a status word,
    // Modbus.
    std::string text = shipped("2408f");
    for (const auto& [from, to] : std::initializer_list<std::pair<const char*, const char*>>{
             {"device     = \"Eurotherm Controls 2408f controller with PROFIBUS-DP module\"",
              "device = \"Feed pump of a site\"\nident = 0xBEEF"},
             {"tag_table = \"2400.csv\"", "tag_table = \"pump.csv\""},
             {"[0x50, 0x60]", "[0xD0, 0xE0]"},
             {"max_parameters         = 117", "max_parameters = 10"},
             {"form           = \"extended\"", "form = \"none\""},
             {"identifier     = 0x73", ""},
             {"error_base     = 0", ""},
             {"extended_reply = \"table\"", ""},
             {"status_tag = 75", "status_tag = 9"},
             {"fault_mask = 0x6CEF", "fault_mask = 0x0001"},
             {"in_tags  = [1, 5, 3, 75]", "in_tags = [9]"},
             {"out_tags = [24, 25, 15, 274]", "out_tags = [4]"}})
        text = with(text, from, to);
    folder_.write("tags/pump.csv", "tag,name,type,decimals,values\n4,Flow,INT,1,\n9,State,WORD,,bit0=Dry\n");
    folder_.write("profiles/pump.toml", text);

    const auto pump = load_profile(io::read_regular_file, folder_.path() / "profiles", "pump");

    ASSERT_TRUE(pump) << to_string(pump.error().at(0));
    EXPECT_EQ(pump->device, "Feed pump of a site");
    EXPECT_EQ(pump->personality.ident, 0xBEEF);
    EXPECT_EQ(pump->personality.identifiers.size(), 2U);
    EXPECT_EQ(pump->personality.max_parameters, 10U);
    EXPECT_EQ(pump->personality.demand, dp::DemandForm::none);
    EXPECT_EQ(pump->status_tag, 9);
    EXPECT_EQ(pump->fault_mask, 1);
    EXPECT_EQ(displayed(*pump->tags.find(9), 1), ">0001 (Dry)");
    EXPECT_THAT(io::names_in(folder_.path() / "profiles", ".toml"), ElementsAre("pump"));
}

struct LampText {
    const char* text;
    std::optional<profile::MirroredLamp> lamp;
};

class Lamp : public testing::TestWithParam<LampText> {};

TEST_P(Lamp, is_a_bit_of_a_tag_or_any_bit_or_nothing)
{
    EXPECT_EQ(profile::parse_lamp(GetParam().text), GetParam().lamp) << GetParam().text;
}

using profile::MirroredLamp;
INSTANTIATE_TEST_SUITE_P(texts, Lamp,
                         testing::Values(LampText{"272.3", MirroredLamp{272, 0x0008, false}},
                                         LampText{"!272.3", MirroredLamp{272, 0x0008, true}},
                                         LampText{"12", MirroredLamp{12, 0xFFFF, false}},
                                         LampText{"!12", MirroredLamp{12, 0xFFFF, true}},
                                         LampText{"65535.15", MirroredLamp{65535, 0x8000, false}},
                                         LampText{"1.0", MirroredLamp{1, 0x0001, false}},
                                         LampText{"", std::nullopt}, LampText{"!", std::nullopt},
                                         LampText{"0.3", std::nullopt}, LampText{"272.", std::nullopt},
                                         LampText{".3", std::nullopt}, LampText{"272.16", std::nullopt},
                                         LampText{"65536", std::nullopt}, LampText{"272.-1", std::nullopt},
                                         LampText{"+272.1", std::nullopt}, LampText{"272 .3", std::nullopt},
                                         LampText{"!!272.3", std::nullopt}, LampText{"272.3.1", std::nullopt},
                                         LampText{"0x110.3", std::nullopt},
                                         LampText{"none", MirroredLamp{0, 0xFFFF, false}},
                                         LampText{"!none", std::nullopt}, LampText{"none.3", std::nullopt}),
                         [](const auto& parameter) { return "n" + std::to_string(parameter.index); });

TEST_F(OwnProfile, a_missing_table_is_one_fault)
{
    const auto profile = load(with(good_, "[slave_diag]\nmax_length = 6\nform       = \"none\"", ""));

    ASSERT_FALSE(profile);
    EXPECT_THAT(test::short_forms(profile.error()),
                ElementsAre(HasSubstr("'slave_diag' is missing in the file: add the table [slave_diag]")));
}

TEST_F(OwnProfile, needs_one_rate_at_least)
{
    std::string text = good_;
    for (const char* rate : {"9600 ", "19200 ", "45450 ", "93750 ", "187500 ", "500000 ", "1500000 "})
        text = with(text, std::string{"\n"} + rate, std::string{"\n# "} + rate);

    const auto profile = load(text);

    ASSERT_FALSE(profile);
    EXPECT_THAT(test::short_forms(profile.error()), ElementsAre(HasSubstr("[max_tsdr] names no rate")));
}

TEST_F(OwnProfile, faults_of_the_profile_and_of_its_table_are_reported_in_one_run)
{
    folder_.write("tags/empty.csv", "tag,type\n55,FLOAT\n");

    const auto profile = load(with(good_, "ident = 0x0533", "ident = 0"));

    ASSERT_FALSE(profile);
    ASSERT_EQ(profile.error().size(), 2U);
    EXPECT_THAT(profile.error()[0].file, EndsWith("profiles/own.toml"));
    EXPECT_THAT(profile.error()[1].file, EndsWith("tags/empty.csv"));
    EXPECT_THAT(test::short_form(profile.error()[1]), AllOf(StartsWith("2:4: "), HasSubstr("FLOAT")));
}

TEST_F(OwnProfile, a_table_or_a_profile_that_is_not_there_is_named)
{
    const auto no_table = load(with(good_, "\"empty.csv\"", "\"absent.csv\""));
    ASSERT_FALSE(no_table);
    EXPECT_THAT(to_string(no_table.error().at(0)),
                HasSubstr("tags/absent.csv: the file cannot be read: No such file"));

    const auto no_profile = load_profile(io::read_regular_file, folder_.path() / "profiles", "absent");
    ASSERT_FALSE(no_profile);
    EXPECT_THAT(to_string(no_profile.error().at(0)),
                HasSubstr("absent.toml: the file cannot be read: No such file"));
}

} // namespace
} // namespace dpslave
