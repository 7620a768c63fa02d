// SPDX-License-Identifier: Apache-2.0
// The shipped profiles against the manuals of their devices, key by key.
#include "files.hpp"
#include "support/paths.hpp"

#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cstdio>

namespace dpslave {
namespace {

using profile::DiagForm;
using profile::MirroredLamp;
using profile::Profile;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::filesystem::path kProfiles = test::source_path("config/profiles");

Profile load_shipped(const std::string& name)
{
    auto profile = profile::load_profile(io::read_regular_file, kProfiles.string(), name);
    if (profile) return *std::move(profile);
    for (const auto& fault : profile.error()) ADD_FAILURE() << to_string(fault);
    return {};
}

/// "50r 60w 70rw"
std::string identifiers_of(const Profile& profile)
{
    std::string out;
    for (const dp::Identifier& identifier : profile.personality.identifiers) {
        std::array<char, 8> hex{};
        std::snprintf(hex.data(), hex.size(), "%02X", identifier.form[0]);
        out += (out.empty() ? "" : " ") + std::string{hex.data()} + (identifier.reads ? "r" : "") +
               (identifier.writes ? "w" : "");
    }
    return out;
}

TEST(ShippedProfiles, are_these_sorted_and_an_absent_folder_has_none)
{
    EXPECT_THAT(io::names_in(kProfiles, ".toml"),
                ElementsAre("2404f", "2408f", "584s", "584sv", "590", "590plus", "605", "620", "690plus"));
    EXPECT_TRUE(io::names_in(kProfiles / "absent", ".toml").empty());
}

TEST(ShippedProfiles, support_the_six_rates_of_the_boards_and_the_fixed_one)
{
    for (const std::string& name : io::names_in(kProfiles, ".toml"))
        EXPECT_THAT(load_shipped(name).personality.max_tsdr,
                    ElementsAre(60_tbit, 60_tbit, 60_tbit, 60_tbit, 60_tbit, 100_tbit, 150_tbit))
            << name;
}

TEST(ShippedProfiles, name_an_ident_only_where_a_manual_prints_one)
{
    for (const std::string& name : io::names_in(kProfiles, ".toml")) {
        const Profile profile = load_shipped(name);
        const bool is_board = name == "584s" || name == "590" || name == "620";
        EXPECT_EQ(profile.ident, is_board        ? std::optional<std::uint16_t>{0x0533}
                                 : name == "605" ? std::optional<std::uint16_t>{0x1649}
                                                 : std::nullopt)
            << name;
        EXPECT_EQ(profile.personality.ident, profile.ident.value_or(0)) << name;
        EXPECT_EQ(profile.gsd.file.empty(), !profile.ident.has_value()) << name << ": no ident, no GSD";
        if (!profile.ident) {
            EXPECT_THAT(test::content_of(kProfiles / (name + ".toml")), HasSubstr("(Ident_Number")) << name;
        }
    }
}

TEST(ShippedProfiles, say_where_their_mnemonic_rule_comes_from_and_where_it_is_assumed)
{
    for (const std::string& name : io::names_in(kProfiles, ".toml")) {
        const Profile profile = load_shipped(name);
        const bool is_board = name == "584s" || name == "590" || name == "620";
        EXPECT_EQ(profile.mnemonics_assumed, is_board) << name << ": X-52";
        EXPECT_EQ(profile.mnemonic_source.empty(), profile.mnemonics == drive::MnemonicRule::none) << name;
    }
}

// --- HA389815 ---

class OptionBoard : public testing::TestWithParam<const char*> {};

TEST_P(OptionBoard, is_that_of_HA389815)
{
    const Profile profile = load_shipped(GetParam());
    const dp::Personality& personality = profile.personality;

    EXPECT_EQ(profile.name, GetParam());
    EXPECT_EQ(profile.manual, "HA389815");
    EXPECT_EQ(identifiers_of(profile), "50r 60w");
    EXPECT_EQ(personality.demand_identifier, 0x73);
    EXPECT_EQ(personality.max_parameters, 12U);
    EXPECT_EQ(personality.max_words, 0U);
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
    EXPECT_EQ(personality.diag_octets, 0);
    EXPECT_EQ(profile.diagnosis, DiagForm::none);
    EXPECT_EQ(profile.mnemonics, drive::MnemonicRule::dc_590plus);
    EXPECT_EQ(profile.zero_after, std::chrono::nanoseconds{0}) << "X-46: zero at once";
    EXPECT_FALSE(profile.tags_only_from_table || profile.has_tec || profile.selectable_resolution);
    EXPECT_THAT(profile.never_written, IsEmpty());
    EXPECT_TRUE(profile.option_software.empty());
    EXPECT_THAT(profile.protocols, ElementsAre("ei-ascii"));
    EXPECT_EQ(profile.tag_file, kProfiles.parent_path() / "tags/empty.csv");
    EXPECT_TRUE(profile.tags.all().empty()) << "no public table: no tag is made up";
}

TEST_P(OptionBoard, has_the_gsd_facts_of_appendix_A)
{
    const Profile profile = load_shipped(GetParam());
    const bool is_620 = profile.name == "620";

    EXPECT_EQ(profile.gsd.vendor, "EUROTHERM");
    EXPECT_EQ(profile.gsd.model, is_620 ? "620" : "584S/590");
    EXPECT_EQ(profile.gsd.revision, "Revision_1");
    EXPECT_EQ(profile.gsd.hardware, is_620 ? "HW_V2.3" : "HW_V2.0");
    EXPECT_EQ(profile.gsd.software, is_620 ? "SW_V4.0" : "SW_V5.0");
    EXPECT_EQ(profile.gsd.min_slave_interval, 20);
    EXPECT_EQ(profile.gsd.repeater, 2);
    EXPECT_EQ(profile.gsd.family, 0);
    EXPECT_EQ(profile.gsd.demand_module, is_620 ? "DEMAND_DATA" : "Demand-Data");
    EXPECT_EQ(profile.gsd.in_module, is_620 ? "PROZESS_DATA_LESEN" : "Process-Data-Input");
    EXPECT_EQ(profile.gsd.out_module, is_620 ? "PROZESS_DATA_SCHREIBEN" : "Process-Data-Output");
    EXPECT_TRUE(profile.gsd.in_out_module.empty());
    EXPECT_TRUE(profile.gsd.in_tags.empty() && profile.gsd.out_tags.empty());
}

INSTANTIATE_TEST_SUITE_P(hosts, OptionBoard, testing::Values("584s", "590", "620"));

TEST(ShippedProfiles, of_the_option_board_differ_in_order_code_firmware_addresses_and_lamps)
{
    const Profile p584 = load_shipped("584s");
    const Profile p590 = load_shipped("590");
    const Profile p620 = load_shipped("620");

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

// --- HA463561U002 ---

class TechnologyBox : public testing::TestWithParam<const char*> {};

TEST_P(TechnologyBox, is_that_of_HA463561U002)
{
    const Profile profile = load_shipped(GetParam());
    const dp::Personality& personality = profile.personality;

    EXPECT_EQ(profile.manual, "HA463561U002");
    EXPECT_EQ(profile.option_software, "Version 3.x");
    EXPECT_EQ(identifiers_of(profile), "50r 60w 70rw");
    EXPECT_EQ(personality.max_parameters, 30U);
    EXPECT_EQ(personality.max_words, 0U);
    EXPECT_TRUE(personality.may_have_no_parameters);
    EXPECT_EQ(personality.demand, dp::DemandForm::basic);
    EXPECT_EQ(personality.demand_identifier, 0x73);
    EXPECT_EQ(personality.demand_error_base, 0);
    EXPECT_EQ(personality.prm.tags_at, 3U);
    EXPECT_EQ(personality.prm.min_length, 3U);
    EXPECT_EQ(personality.prm.max_length, 63U) << "3 + 2 x 30";
    EXPECT_TRUE(personality.prm.may_be_absent);
    EXPECT_TRUE(personality.prm.dpv1_status);
    EXPECT_EQ(personality.prm.max_tag, 65535);
    EXPECT_EQ(personality.prm.list, dp::TagList::zeros_at_end);
    EXPECT_TRUE(personality.sync && personality.freeze) << "X-33";
    EXPECT_FALSE(personality.fail_safe);
    EXPECT_EQ(personality.max_diag_length, 10U);
    EXPECT_EQ(personality.diag_octets, 3);
    EXPECT_EQ(profile.min_address, 0);
    EXPECT_EQ(profile.max_address, 125);
    EXPECT_TRUE(profile.has_tec);
    EXPECT_EQ(profile.leds, led::Language::technology_box);
    EXPECT_THAT(profile.protocols, ElementsAre("ei-ascii"));
    EXPECT_FALSE(profile.tags_only_from_table || profile.selectable_resolution);
}

TEST_P(TechnologyBox, has_gsd_facts_of_a_drive_with_all_four_modules)
{
    const profile::GsdFacts gsd = load_shipped(GetParam()).gsd;

    EXPECT_THAT(gsd.model, StartsWith("SSD Drives "));
    EXPECT_EQ(gsd.family, 1) << "drives";
    EXPECT_EQ(gsd.repeater, 2);
    EXPECT_EQ(gsd.min_slave_interval, 20);
    EXPECT_EQ(gsd.software, "Version 3.x");
    EXPECT_FALSE(gsd.vendor.empty() || gsd.hardware.empty() || gsd.revision.empty());
    EXPECT_FALSE(gsd.demand_module.empty() || gsd.in_module.empty() || gsd.out_module.empty() ||
                 gsd.in_out_module.empty());
}

INSTANTIATE_TEST_SUITE_P(hosts, TechnologyBox, testing::Values("584sv", "590plus", "605", "690plus"));

TEST(ShippedProfiles, of_the_technology_box_have_the_order_codes_and_firmware_of_page_3)
{
    const Profile p584 = load_shipped("584sv");
    const Profile p590 = load_shipped("590plus");
    const Profile p605 = load_shipped("605");
    const Profile p690 = load_shipped("690plus");

    EXPECT_EQ(p584.firmware, "V4.x onwards");
    EXPECT_EQ(p590.firmware, "V5.x onwards");
    EXPECT_EQ(p605.firmware, "V4.x onwards");
    EXPECT_EQ(p690.firmware, "V1.x onwards");
    EXPECT_THAT(p584.order_code, StartsWith("584SV/XXXX/XXX/XXXX/XX/XXX/PROF/XX/XXX/XXX"));
    EXPECT_THAT(p584.order_code, HasSubstr("LA463610U002"));
    EXPECT_THAT(p590.order_code, StartsWith("590P/XXXX/XXX/XXXX/XX/XXX/PROF/XXX/XXX"));
    EXPECT_THAT(p590.order_code, HasSubstr("955+/X/X/XXXX/XXX (590+DRV)"));
    EXPECT_THAT(p605.order_code, StartsWith("605/XXX/XXX/X/X/XXX3/XX/XXX"));
    EXPECT_THAT(p605.order_code, HasSubstr("605C/XXXX/XXX/XXXX/XX/XXX/PROF/XX/XXX/XXX"));
    EXPECT_THAT(p690.order_code, StartsWith("690PB/XXXX/XXX/X/X/XXXX/XXXX/XXXX/PROF/XXXX/XXXX/XXXX"));
    EXPECT_THAT(p690.order_code, HasSubstr("690P/XXXX/XXXX/XX/XXX/PROF/XXX/XXX/XX/XXX/XXX"));
    for (const Profile* profile : {&p605, &p690}) {
        EXPECT_THAT(profile->order_code, HasSubstr("6053/PROF/00")) << "X-36: not 6035";
        EXPECT_THAT(profile->order_code, HasSubstr("6055/PROF/00"));
    }
    for (const Profile* profile : {&p584, &p590, &p605, &p690}) {
        EXPECT_THAT(profile->order_code, HasSubstr("AH500602U001")) << "X-36: AH463470U002 is obsolete";
        EXPECT_THAT(profile->order_code, testing::Not(HasSubstr("AH463470U002")));
    }
    EXPECT_THAT(p690.device, HasSubstr("B to K")) << "X-37";
}

TEST(ShippedProfiles, of_the_technology_box_report_the_trip_code_where_the_drive_has_it)
{
    for (const char* name : {"584sv", "605", "690plus"})
        EXPECT_EQ(load_shipped(name).diagnosis, DiagForm::trip_code) << name;
    EXPECT_EQ(load_shipped("590plus").diagnosis, DiagForm::tripped) << "0 or 31 only";
}

TEST(ShippedProfiles, of_the_technology_box_mirror_the_lamps_that_are_known)
{
    const Profile p690 = load_shipped("690plus");
    EXPECT_EQ(p690.health, (MirroredLamp{272, 0x0008, true})) << "COMMS STATUS bit 3: tripped";
    EXPECT_EQ(p690.run, (MirroredLamp{272, 0x0004, false})) << "bit 2: running";
    for (const char* name : {"584sv", "590plus", "605"}) {
        EXPECT_EQ(load_shipped(name).health, MirroredLamp{}) << name;
        EXPECT_EQ(load_shipped(name).run, MirroredLamp{}) << name;
    }
}

TEST(ShippedProfiles, of_the_technology_box_name_their_tables_and_their_mnemonic_rule)
{
    for (const char* name : {"584sv", "605", "690plus"})
        EXPECT_EQ(load_shipped(name).mnemonics, drive::MnemonicRule::ac) << name;
    EXPECT_EQ(load_shipped("590plus").mnemonics, drive::MnemonicRule::dc_590plus);
    for (const char* name : {"584sv", "605"}) {
        EXPECT_THAT(load_shipped(name).tag_file, EndsWith("tags/empty.csv"));
        EXPECT_TRUE(load_shipped(name).tags.all().empty()) << "no public table: nothing is made up";
    }
    EXPECT_NE(load_shipped("590plus").tags.find(537), nullptr);
    EXPECT_NE(load_shipped("690plus").tags.find(272), nullptr);
}

TEST(ShippedProfiles, of_the_605_and_584SV_have_the_names_of_the_figures)
{
    EXPECT_EQ(load_shipped("605").gsd.model, "SSD Drives 605");
    EXPECT_EQ(load_shipped("584sv").gsd.model, "SSD Drives 584SV");
}

TEST(ShippedProfiles, of_the_590plus_reach_PNO_0_to_127_as_tags_1000_to_1127_by_their_own_mnemonics)
{
    const drive::MnemonicRule rule = load_shipped("590plus").mnemonics;
    const auto mnemonic = [rule](std::uint16_t tag) {
        const auto two = drive::mnemonic_of(drive::unlisted_tag(tag), rule);
        return two ? std::string{two->begin(), two->end()} : "";
    };

    EXPECT_EQ(mnemonic(1039), "27");
    EXPECT_EQ(mnemonic(1015), "0F");
    EXPECT_EQ(mnemonic(1000), "00");
    EXPECT_EQ(mnemonic(1127), "7F");
    EXPECT_EQ(mnemonic(999), "cL") << "an ordinary tag again: 63 = 2 x 26 + 11";
    EXPECT_EQ(mnemonic(1128), "hK") << "192 = 7 x 26 + 10";
    EXPECT_EQ(mnemonic(536), "ow");
}

// --- The 2408f and 2404f handbook ---

class Controller : public testing::TestWithParam<const char*> {};

TEST_P(Controller, is_that_of_the_handbook)
{
    const Profile profile = load_shipped(GetParam());
    const dp::Personality& personality = profile.personality;

    EXPECT_EQ(profile.manual, "HA026290");
    EXPECT_THAT(profile.device, HasSubstr(GetParam()));
    for (const char* code : {GetParam(), "PROF-ENG", "SUB24/PB PROFIBUS AH026222U002"})
        EXPECT_THAT(profile.order_code, HasSubstr(code));
    EXPECT_THAT(profile.firmware, HasSubstr("V3.22"));
    EXPECT_TRUE(profile.option_software.empty());
    EXPECT_EQ(identifiers_of(profile), "50r 60w");
    EXPECT_EQ(personality.max_parameters, 117U);
    EXPECT_EQ(personality.max_words, 117U) << "in and out together, with Demand Data";
    EXPECT_TRUE(personality.may_have_no_parameters);
    EXPECT_EQ(personality.demand, dp::DemandForm::extended);
    EXPECT_EQ(personality.demand_identifier, 0x73);
    EXPECT_EQ(personality.demand_error_base, 0);
    EXPECT_EQ(personality.extended_reply, dp::ExtendedReply::table);
    EXPECT_EQ(personality.prm.tags_at, 0U);
    EXPECT_EQ(personality.prm.min_length, 0U);
    EXPECT_EQ(personality.prm.max_length, 234U) << "2 x 117";
    EXPECT_TRUE(personality.prm.may_be_absent);
    EXPECT_FALSE(personality.prm.dpv1_status);
    EXPECT_EQ(personality.prm.max_tag, 16383);
    EXPECT_EQ(personality.prm.list, dp::TagList::exact);
    EXPECT_FALSE(personality.sync || personality.freeze || personality.fail_safe);
    EXPECT_EQ(personality.max_diag_length, 9U);
    EXPECT_EQ(personality.diag_octets, 2);
    EXPECT_EQ(profile.diagnosis, DiagForm::status_word);
    EXPECT_EQ(profile.status_tag, 75);
    EXPECT_EQ(profile.zero_after, std::nullopt) << "the front panel regains control";
    EXPECT_TRUE(profile.selectable_resolution);
    EXPECT_THAT(profile.never_written, ElementsAre(199));
    EXPECT_EQ(profile.mnemonics, drive::MnemonicRule::none);
    EXPECT_THAT(profile.protocols, ElementsAre("modbus-rtu"));
    EXPECT_EQ(profile.leds, led::Language::controller);
    EXPECT_FALSE(profile.has_tec || profile.tags_only_from_table);
    EXPECT_EQ(profile.min_address, 0);
    EXPECT_EQ(profile.max_address, 125);
    EXPECT_EQ(profile.tags.all().size(), 1050U);
}

TEST_P(Controller, counts_the_bits_of_table_4_2_that_are_faults)
{
    const Profile profile = load_shipped(GetParam());

    unsigned faults = 0;
    for (const unsigned bit : {0U, 1U, 2U, 3U, 5U, 6U, 7U, 10U, 11U, 13U, 14U}) faults |= 1U << bit;
    EXPECT_EQ(profile.fault_mask, faults)
        << "not: manual, tune active, program complete, segment synchronise";
    const drive::Tag* status = profile.tags.find(profile.status_tag);
    ASSERT_NE(status, nullptr);
    EXPECT_EQ(displayed(*status, static_cast<std::uint16_t>(~profile.fault_mask)),
              ">9310 (Manual mode, Tune active, Ramp or program complete, Programmer segment synchronise)");
}

TEST_P(Controller, maps_what_EURO2400_maps)
{
    const Profile profile = load_shipped(GetParam());

    EXPECT_THAT(profile.gsd.in_tags, ElementsAre(1, 5, 3, 75));
    EXPECT_THAT(profile.gsd.out_tags, ElementsAre(24, 25, 15, 274));
    std::vector<std::string> names;
    for (const auto* tags : {&profile.gsd.in_tags, &profile.gsd.out_tags})
        for (const std::uint16_t tag : *tags) names.push_back(profile.tags.find(tag)->name);
    EXPECT_THAT(names, ElementsAre("Process variable", "Working setpoint", "Output power %",
                                   "Summary output status word", "Setpoint 1", "Setpoint 2",
                                   "Select setpoint", "Acknowledge all alarms"));
    EXPECT_EQ(profile.gsd.model, "2408f/2404f") << "one GSD serves all controllers of the type";
    EXPECT_EQ(profile.gsd.family, 5) << "controllers";
    EXPECT_EQ(profile.gsd.repeater, 0) << "no RTS on terminals HB to HF";
    EXPECT_EQ(profile.gsd.min_slave_interval, 20);
}

INSTANTIATE_TEST_SUITE_P(models, Controller, testing::Values("2408f", "2404f"));

} // namespace
} // namespace dpslave
