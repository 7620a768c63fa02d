// SPDX-License-Identifier: Apache-2.0
#include "profile/files.hpp"

#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using profile::Faults;
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

const std::filesystem::path kShipped = std::filesystem::path{DPSLAVE_SOURCE_DIR} / "config/profiles";

class ShippedProfile : public testing::TestWithParam<const char*> {
protected:
    static Profile load(const std::string& name)
    {
        auto profile = load_profile(kShipped, name);
        if (profile) return *std::move(profile);
        for (const auto& fault : profile.error()) ADD_FAILURE() << to_string(fault);
        return {};
    }
};

TEST_P(ShippedProfile, is_the_option_board_of_HA389815)
{
    const Profile profile = load(GetParam());
    const dp::Personality& personality = profile.personality;

    EXPECT_EQ(profile.name, GetParam());
    EXPECT_EQ(profile.manual, "HA389815");
    EXPECT_EQ(profile.ident, 0x0533);
    EXPECT_EQ(personality.ident, 0x0533);
    EXPECT_THAT(personality.max_tsdr,
                ElementsAre(60_tbit, 60_tbit, 60_tbit, 60_tbit, 60_tbit, 100_tbit, 150_tbit));
    ASSERT_EQ(personality.identifiers.size(), 2U);
    EXPECT_EQ(personality.identifiers[0].octet, 0x50);
    EXPECT_TRUE(personality.identifiers[0].reads && !personality.identifiers[0].writes);
    EXPECT_EQ(personality.identifiers[1].octet, 0x60);
    EXPECT_TRUE(!personality.identifiers[1].reads && personality.identifiers[1].writes);
    EXPECT_EQ(personality.demand_identifier, 0x73);
    EXPECT_EQ(personality.max_parameters, 12U);
    EXPECT_TRUE(personality.may_have_no_parameters);
    EXPECT_EQ(personality.prm.tags_at, 0U);
    EXPECT_EQ(personality.prm.min_length, 24U);
    EXPECT_EQ(personality.prm.max_length, 24U);
    EXPECT_FALSE(personality.prm.may_be_absent || personality.prm.dpv1_status);
    EXPECT_EQ(personality.prm.max_tag, 2047);
    EXPECT_EQ(personality.prm.list, dp::TagList::first_zero_ends);
    EXPECT_EQ(personality.demand, dp::DemandForm::basic);
    EXPECT_EQ(personality.demand_error_base, 0);
    EXPECT_TRUE(personality.sync && personality.freeze);
    EXPECT_FALSE(personality.fail_safe);
    EXPECT_EQ(personality.max_diag_length, 6U);
    EXPECT_EQ(profile.mnemonics, drive::MnemonicRule::dc_590plus);
    EXPECT_EQ(profile.output_loss, drive::OutputLoss::zero);
    EXPECT_FALSE(profile.tags_only_from_table);
    EXPECT_THAT(profile.protocols, ElementsAre("ei-ascii"));
    EXPECT_EQ(profile.tag_file, kShipped.parent_path() / "tags/example.csv");
    EXPECT_FALSE(profile.tags.all().empty());
}

INSTANTIATE_TEST_SUITE_P(hosts, ShippedProfile, testing::Values("584s", "590", "620"));

TEST_F(ShippedProfile, order_codes_firmware_addresses_and_lamps_are_those_of_each_host)
{
    const Profile p584 = load("584s");
    const Profile p590 = load("590");
    const Profile p620 = load("620");

    EXPECT_THAT(p584.order_code, HasSubstr("/PR00/"));
    EXPECT_THAT(p590.order_code, StartsWith("590/XXXX/X/X/X/X/X/2/"));
    EXPECT_THAT(p620.order_code, StartsWith("6204/1"));
    for (const Profile* profile : {&p584, &p590, &p620})
        EXPECT_THAT(profile->order_code, EndsWith("AH389918U001"));
    EXPECT_EQ(p584.firmware, "V5.1 onwards");
    EXPECT_EQ(p590.firmware, "V4.2 onwards");
    EXPECT_EQ(p620.firmware, "V3.6 onwards");
    EXPECT_EQ(p584.min_address, 0);
    EXPECT_EQ(p590.min_address, 0);
    EXPECT_EQ(p620.min_address, 1);
    for (const Profile* profile : {&p584, &p590, &p620}) EXPECT_EQ(profile->max_address, 125);
    EXPECT_EQ(p584.leds, led::Language::option_board);
    EXPECT_EQ(p590.leds, led::Language::option_board);
    EXPECT_EQ(p620.leds, led::Language::option_board_620);
}

TEST_F(ShippedProfile, names_are_found_sorted_and_an_absent_folder_has_none)
{
    EXPECT_THAT(profile::profile_names(kShipped), ElementsAre("584s", "590", "620"));
    EXPECT_THAT(profile::profile_names(kShipped / "absent"), testing::IsEmpty());
}

class OwnProfile : public testing::Test {
protected:
    OwnProfile() { folder_.write("tags/example.csv", "tag,name\n55,SPEED\n"); }

    Result<Profile, Faults> load(std::string_view content)
    {
        folder_.write("profiles/own.toml", content);
        return load_profile(folder_.path() / "profiles", "own");
    }

    Folder folder_;
    const std::string good_ = test::content_of(kShipped / "590.toml");
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
    const auto profile = load(with(text, "[0x50, 0x60]", "[0x50, 0x60, 0x70, 0xD0, 0x11]"));

    ASSERT_TRUE(profile) << to_string(profile.error().at(0));
    EXPECT_EQ(profile->personality.demand, dp::DemandForm::none);
    EXPECT_EQ(profile->personality.demand_identifier, 0);
    EXPECT_TRUE(profile->tags_only_from_table);
    EXPECT_EQ(profile->output_loss, drive::OutputLoss::hold);
    ASSERT_EQ(profile->personality.identifiers.size(), 5U);
    EXPECT_TRUE(profile->personality.identifiers[2].reads && profile->personality.identifiers[2].writes);
    EXPECT_TRUE(profile->personality.identifiers[3].reads) << "0xD0: one word in, consistent";
    EXPECT_TRUE(profile->personality.identifiers[4].reads) << "0x11: two octets in";
}

struct BadChange {
    const char* from;
    const char* to;
    const char* sentence;
    std::ptrdiff_t column; ///< of the fault in the line that was changed; 0 = the fault stands elsewhere
};

void PrintTo(const BadChange& change, std::ostream* out)
{
    *out << test::case_name(std::string{change.sentence} + " for " + change.from + " made " + change.to);
}

class BadProfile : public OwnProfile, public testing::WithParamInterface<BadChange> {};

TEST_P(BadProfile, is_refused_with_place_and_remedy)
{
    const BadChange& change = GetParam();
    const auto line =
        1 +
        std::count(good_.begin(), good_.begin() + static_cast<std::ptrdiff_t>(good_.find(change.from)), '\n');

    const auto profile = load(with(good_, change.from, change.to));

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
        BadChange{"mnemonic_rule = \"590plus\"", "mnemonic_rule = \"590\"", "\"590plus\", \"ac\" or \"none\"",
                  17},
        BadChange{"tag_table = \"example.csv\"", "tag_table = \"../x.csv\"", "without a folder", 13},
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
        BadChange{"[0x50, 0x60]", "[0x50, 0x50]", "stands twice", 26},
        BadChange{"[0x50, 0x60]", "[0x50, 256]", "from 0 to 255", 33},
        BadChange{"max_parameters         = 12", "max_parameters = 118", "from 1 to 117", 18},
        BadChange{"max_parameters         = 12", "max_parameters = 13", "that takes 26 octets", 0},
        BadChange{"may_have_no_parameters = true", "may_have_no_parameters = 1", "true or false", 26},
        BadChange{"form       = \"basic\"", "form = \"extended\"", "\"none\" or \"basic\"", 8},
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
        BadChange{"ident = 0x0533", "ident = ", "no TOML", 0}));

TEST_F(OwnProfile, a_missing_table_is_one_fault)
{
    const auto at = good_.find("[slave_diag]");
    const auto profile = load(good_.substr(0, at));

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

TEST_F(OwnProfile, faults_of_the_profile_and_of_its_table_are_told_in_one_run)
{
    folder_.write("tags/example.csv", "tag,type\n55,FLOAT\n");

    const auto profile = load(with(good_, "ident = 0x0533", "ident = 0"));

    ASSERT_FALSE(profile);
    ASSERT_EQ(profile.error().size(), 2U);
    EXPECT_THAT(profile.error()[0].file, EndsWith("profiles/own.toml"));
    EXPECT_THAT(profile.error()[1].file, EndsWith("tags/example.csv"));
    EXPECT_THAT(test::short_form(profile.error()[1]), AllOf(StartsWith("2:4: "), HasSubstr("FLOAT")));
}

TEST_F(OwnProfile, a_table_or_a_profile_that_is_not_there_is_named)
{
    const auto no_table = load(with(good_, "example.csv", "absent.csv"));
    ASSERT_FALSE(no_table);
    EXPECT_THAT(to_string(no_table.error().at(0)),
                HasSubstr("tags/absent.csv: the file cannot be read: No such file"));

    const auto no_profile = load_profile(folder_.path() / "profiles", "absent");
    ASSERT_FALSE(no_profile);
    EXPECT_THAT(to_string(no_profile.error().at(0)),
                HasSubstr("absent.toml: the file cannot be read: No such file"));
}

} // namespace
} // namespace dpslave
