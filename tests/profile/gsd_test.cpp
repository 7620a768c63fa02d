// SPDX-License-Identifier: Apache-2.0
// The GSD is the contract with the master: what the shipped files say, the profiles must do.
// The reader here is a small one of its own, so that a GSD is judged by a second hand.
#include "profile/files.hpp"

#include "dpslave/profile/profile.hpp"

#include <gmock/gmock.h>

#include <map>

namespace dpslave {
namespace {

using profile::Profile;
using testing::ElementsAre;
using testing::EndsWith;
using testing::StartsWith;

const std::filesystem::path kSource{DPSLAVE_SOURCE_DIR};

struct Gsd {
    std::map<std::string, std::string> keys; ///< the last one counts, as in the master's tools
    std::vector<std::pair<std::string, int>> modules;

    int number(const std::string& key) const
    {
        EXPECT_TRUE(keys.count(key)) << key;
        return keys.count(key) ? std::stoi(keys.at(key), nullptr, 0) : -1;
    }
};

std::string without_blanks(std::string text)
{
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
}

Gsd read_gsd(const std::filesystem::path& file)
{
    std::string content = test::content_of(file);
    for (auto at = content.find("\\\r\n"); at != std::string::npos; at = content.find("\\\r\n"))
        content.erase(at, 3);
    Gsd gsd;
    std::istringstream lines{content};
    for (std::string line; std::getline(lines, line);) {
        line = line.substr(0, line.find_first_of(";\r"));
        const auto equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string key = without_blanks(line.substr(0, equals));
        const std::string value = line.substr(equals + 1);
        if (key == "Module") {
            const auto open = value.find('"');
            const auto close = value.find('"', open + 1);
            gsd.modules.emplace_back(value.substr(open + 1, close - open - 1),
                                     std::stoi(value.substr(close + 1), nullptr, 0));
        } else {
            gsd.keys[key] = without_blanks(value);
        }
    }
    return gsd;
}

Profile load(const std::string& name)
{
    auto profile = profile::load_profile(kSource / "config/profiles", name);
    EXPECT_TRUE(profile) << to_string(profile.error().at(0));
    return profile ? *std::move(profile) : Profile{};
}

struct Pair {
    const char* gsd;
    const char* profile;
};

void PrintTo(const Pair& pair, std::ostream* out)
{
    *out << test::case_name(pair.profile);
}

class GsdAndProfile : public testing::TestWithParam<Pair> {
protected:
    const Gsd gsd_ = read_gsd(kSource / "gsd" / GetParam().gsd / "EURO0533.GSD");
    const Profile profile_ = load(GetParam().profile);
    const dp::Personality& personality_ = profile_.personality;
};

TEST_P(GsdAndProfile, agree_on_the_ident_number)
{
    EXPECT_EQ(gsd_.number("Ident_Number"), 0x0533);
    EXPECT_EQ(personality_.ident, 0x0533);
}

TEST_P(GsdAndProfile, agree_on_the_rates_and_their_max_tsdr)
{
    for (const Baud baud : kBauds) {
        const std::string rate{text(baud)};
        if (baud == Baud::k45_45) { // only ever fixed by the configuration, so no tool is to offer it
            EXPECT_FALSE(gsd_.keys.count("45.45_supp"));
            continue;
        }
        EXPECT_EQ(gsd_.number(rate + "_supp"), 1) << rate;
        EXPECT_EQ(gsd_.number("MaxTsdr_" + rate),
                  static_cast<int>(personality_.max_tsdr[index_of(baud)].count))
            << rate;
    }
    EXPECT_EQ(std::count_if(gsd_.keys.begin(), gsd_.keys.end(),
                            [](const auto& entry) { return entry.first.starts_with("MaxTsdr_"); }),
              6);
}

TEST_P(GsdAndProfile, agree_on_sync_freeze_and_that_clear_has_data)
{
    EXPECT_EQ(gsd_.number("Sync_Mode_supp"), personality_.sync ? 1 : 0);
    EXPECT_EQ(gsd_.number("Freeze_Mode_supp"), personality_.freeze ? 1 : 0);
    EXPECT_EQ(gsd_.keys.count("Fail_Safe"), personality_.fail_safe ? 1U : 0U);
}

TEST_P(GsdAndProfile, agree_on_modules_and_lengths)
{
    std::vector<int> identifiers;
    for (const auto& [name, octet] : gsd_.modules) identifiers.push_back(octet);
    ASSERT_EQ(personality_.identifiers.size(), 2U);
    EXPECT_THAT(identifiers, ElementsAre(personality_.demand_identifier, personality_.identifiers[0].octet,
                                         personality_.identifiers[1].octet));
    EXPECT_EQ(gsd_.number("Modular_Station"), 1);
    EXPECT_EQ(gsd_.number("Max_Module"), static_cast<int>(personality_.max_parameters) + 1);
    const int longest = 8 + 2 * static_cast<int>(personality_.max_parameters);
    EXPECT_EQ(gsd_.number("Max_Input_Len"), longest);
    EXPECT_EQ(gsd_.number("Max_Output_Len"), longest);
}

TEST_P(GsdAndProfile, agree_on_user_prm_data)
{
    EXPECT_EQ(gsd_.number("User_Prm_data_Len"), 24);
    EXPECT_EQ(personality_.prm.min_length, 24U);
    EXPECT_EQ(personality_.prm.max_length, 24U);
    std::string zeros;
    for (int i = 0; i < 24; ++i) zeros += i == 0 ? "0x00" : ",0x00";
    EXPECT_EQ(gsd_.keys.at("User_Prm_Data"), zeros);
}

INSTANTIATE_TEST_SUITE_P(hosts, GsdAndProfile,
                         testing::Values(Pair{"584s-590", "584s"}, Pair{"584s-590", "590"},
                                         Pair{"620", "620"}));

TEST(Gsd, max_diag_data_len_is_6_and_missing_in_that_of_the_620)
{
    EXPECT_EQ(read_gsd(kSource / "gsd/584s-590/EURO0533.GSD").number("Max_Diag_Data_Len"), 6);
    EXPECT_FALSE(read_gsd(kSource / "gsd/620/EURO0533.GSD").keys.count("Max_Diag_Data_Len"));
    for (const char* name : {"584s", "590", "620"}) EXPECT_EQ(load(name).personality.max_diag_length, 6U);
}

TEST(Gsd, names_and_releases_are_those_of_appendix_A)
{
    const Gsd board = read_gsd(kSource / "gsd/584s-590/EURO0533.GSD");
    EXPECT_EQ(board.keys.at("Vendor_Name"), "\"EUROTHERM\"");
    EXPECT_EQ(board.keys.at("Model_Name"), "\"584S/590\"");
    EXPECT_EQ(board.keys.at("Hardware_Release"), "\"HW_V2.0\"");
    EXPECT_EQ(board.keys.at("Software_Release"), "\"SW_V5.0\"");
    EXPECT_EQ(board.number("Max_Data_Len"), 64);
    const Gsd module = read_gsd(kSource / "gsd/620/EURO0533.GSD");
    EXPECT_EQ(module.keys.at("Model_Name"), "\"620\"");
    EXPECT_EQ(module.keys.at("Hardware_Release"), "\"HW_V2.3\"");
    EXPECT_EQ(module.keys.at("Software_Release"), "\"SW_V4.0\"");
    EXPECT_EQ(module.number("Max_Data_Len"), 40);
    EXPECT_EQ(module.modules.at(1).first, "PROZESS_DATA_LESEN");
    for (const Gsd* gsd : {&board, &module}) {
        EXPECT_EQ(gsd->number("Repeater_Ctrl_Sig"), 2);
        EXPECT_EQ(gsd->number("Auto_Baud_supp"), 1);
        EXPECT_EQ(gsd->number("Set_Slave_Add_supp"), 0);
        EXPECT_EQ(gsd->number("Min_Slave_Intervall"), 20);
    }
}

TEST(Gsd, files_are_plain_ascii_with_cr_lf_and_straight_quotes)
{
    for (const char* folder : {"584s-590", "620"}) {
        const std::string content = test::content_of(kSource / "gsd" / folder / "EURO0533.GSD");
        EXPECT_THAT(content, StartsWith("#Profibus_DP\r\nVendor_Name = \"EUROTHERM\"\r\n"));
        EXPECT_THAT(content, EndsWith("EndModule\r\n"));
        for (std::size_t i = 0; i < content.size(); ++i) {
            EXPECT_LT(static_cast<unsigned char>(content[i]), 0x7F) << i;
            if (content[i] == '\n') {
                EXPECT_EQ(content[i - 1], '\r') << i;
            }
        }
    }
}

} // namespace
} // namespace dpslave
