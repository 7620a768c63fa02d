// SPDX-License-Identifier: Apache-2.0
// The GSD is the contract with the master: what the files say, the profiles must do, key by key and in both
// directions. The files are read by a second hand (reader.hpp).
#include "second_hand.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace dpslave {
namespace {

using test::load;
using test::second_hand;
using test::SecondHand;

std::string quoted(const std::string& text)
{
    return '"' + text + '"';
}

std::string flag(bool on)
{
    return on ? "1" : "0";
}

std::string hex(std::uint16_t word)
{
    char text[8];
    std::snprintf(text, sizeof text, "0x%04X", word);
    return text;
}

std::string zeros(std::size_t count)
{
    std::string out;
    for (std::size_t i = 0; i < count; ++i) out += i == 0 ? "0x00" : ",0x00";
    return out;
}

/// Every key that a file of a device has whose modules the master's tool puts together.
std::map<std::string, std::string> expected(const profile::Profile& profile, std::uint16_t ident)
{
    const dp::Personality& p = profile.personality;
    const bool both = std::any_of(p.identifiers.begin(), p.identifiers.end(),
                                  [](const dp::Identifier& each) { return each.reads && each.writes; });
    const std::size_t longest = 8 + 2 * p.max_parameters;
    std::map<std::string, std::string> keys{
        {"GSD_Revision", "3"},
        {"Vendor_Name", quoted(profile.gsd.vendor)},
        {"Model_Name", quoted(profile.gsd.model)},
        {"Revision", quoted(profile.gsd.revision)},
        {"Ident_Number", hex(ident)},
        {"Protocol_Ident", "0"},
        {"Station_Type", "0"},
        {"FMS_supp", "0"},
        {"Hardware_Release", quoted(profile.gsd.hardware)},
        {"Software_Release", quoted(profile.gsd.software)},
        {"Redundancy", "0"},
        {"Repeater_Ctrl_Sig", std::to_string(profile.gsd.repeater)},
        {"24V_Pins", "0"},
        {"Slave_Family", std::to_string(profile.gsd.family)},
        {"Freeze_Mode_supp", flag(p.freeze)},
        {"Sync_Mode_supp", flag(p.sync)},
        {"Fail_Safe", flag(p.fail_safe)},
        {"Auto_Baud_supp", "1"},
        {"Set_Slave_Add_supp", "0"},
        {"Min_Slave_Intervall", std::to_string(profile.gsd.min_slave_interval)},
        {"Max_Diag_Data_Len", std::to_string(p.max_diag_length)},
        {"User_Prm_Data_Len", std::to_string(p.prm.max_length)},
        {"User_Prm_Data", zeros(p.prm.max_length)},
        {"Modular_Station", "1"},
        {"Max_Module", std::to_string(p.max_parameters + 1)},
        {"Max_Input_Len", std::to_string(longest)},
        {"Max_Output_Len", std::to_string(longest)},
        {"Max_Data_Len", std::to_string(16 + p.max_parameters * (both ? 4 : 2))},
    };
    for (const Baud baud : kBauds) {
        const Tbit bits = p.max_tsdr[index_of(baud)];
        if (bits.count == 0 || baud == Baud::k45_45) continue; // 45.45 is fixed by hand only
        keys[std::string{text(baud)} + "_supp"] = "1";
        keys["MaxTsdr_" + std::string{text(baud)}] = std::to_string(bits.count);
    }
    return keys;
}

class MadeGsd : public testing::TestWithParam<std::string> {
protected:
    const profile::Profile profile_ = load(GetParam());
    const std::uint16_t ident_ = profile_.ident.value_or(test::kOwnIdent);
};

TEST_P(MadeGsd, SaysExactlyWhatTheProfileDoes)
{
    EXPECT_EQ(second_hand(test::made(profile_, {})).keys, expected(profile_, ident_));
}

TEST_P(MadeGsd, HasAModuleForEachIdentifierOfTheProfileAndNoOther)
{
    std::vector<std::pair<std::string, std::vector<std::uint8_t>>> found, wanted;
    for (const auto& module : second_hand(test::made(profile_, {})).modules)
        found.emplace_back(module.name, module.identifiers);
    wanted.emplace_back(profile_.gsd.demand_module, std::vector{profile_.personality.demand_identifier});
    for (const dp::Identifier& each : profile_.personality.identifiers)
        wanted.emplace_back(each.reads && each.writes ? profile_.gsd.in_out_module
                            : each.reads              ? profile_.gsd.in_module
                                                      : profile_.gsd.out_module,
                            std::vector{each.form[0]});
    EXPECT_EQ(found, wanted);
}

TEST_P(MadeGsd, IsLikedByAStrictReader)
{
    EXPECT_THAT(test::findings_of(test::made(profile_, {}), gsd::Reading::strict), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Modular, MadeGsd,
                         testing::Values("584s", "590", "620", "584sv", "590plus", "605", "690plus"),
                         [](const auto& one) { return "Of" + test::case_name(one.param); });

class MappedGsd : public testing::TestWithParam<std::string> {};

/// A file for a mapping differs in the mapping alone.
TEST_P(MappedGsd, SaysExactlyWhatTheProfileDoes)
{
    const profile::Profile profile = load(GetParam());
    auto keys = expected(profile, profile.ident.value_or(test::kOwnIdent));
    const auto file = second_hand(test::made(profile, {.in = {11, 12}, .out = {13}, .demand = true}));
    const std::size_t at = profile.personality.prm.tags_at;
    const std::size_t length = std::max(profile.personality.prm.min_length, at + 6);
    keys["User_Prm_Data_Len"] = std::to_string(length);
    keys["User_Prm_Data"] = (at > 0 ? zeros(at) + "," : "") + "0x00,0x0B,0x00,0x0C,0x00,0x0D" +
                            (length > at + 6 ? "," + zeros(length - at - 6) : "");
    keys["Modular_Station"] = "0";
    keys["Max_Module"] = "1";
    keys["Max_Input_Len"] = "12";
    keys["Max_Output_Len"] = "10";
    keys["Max_Data_Len"] = "22";
    EXPECT_EQ(file.keys, keys);
}

INSTANTIATE_TEST_SUITE_P(OfEveryProfile, MappedGsd, testing::ValuesIn(test::kProfiles),
                         [](const auto& one) { return "Of" + test::case_name(one.param); });

/// The manual's files and the profiles that stand for them.
class ManualsGsd : public testing::TestWithParam<std::pair<const char*, const char*>> {
protected:
    const SecondHand gsd_ =
        second_hand(test::content_of(test::kSource / "gsd/manual" / GetParam().first / "EURO0533.GSD"));
    const profile::Profile profile_ = load(GetParam().second);
};

TEST_P(ManualsGsd, SaysWhatTheProfileDoes)
{
    auto keys = expected(profile_, 0x0533);
    for (const char* newer : {"GSD_Revision", "Slave_Family", "Fail_Safe"}) {
        EXPECT_FALSE(gsd_.keys.count(newer));
        keys.erase(newer);
    }
    keys["User_Prm_data_Len"] = keys["User_Prm_Data_Len"]; // as the manual spells it
    keys.erase("User_Prm_Data_Len");
    const bool is_620 = profile_.name == "620";
    if (is_620) keys.erase("Max_Diag_Data_Len");
    if (!is_620) keys["Max_Data_Len"] = "64";
    for (const auto& [key, value] : keys) {
        if (value.front() == '"' || key == "User_Prm_Data")
            EXPECT_EQ(gsd_.keys.at(key), value) << key;
        else
            EXPECT_EQ(gsd_.number(key), std::stoi(value, nullptr, 0)) << key;
    }
    EXPECT_EQ(gsd_.keys.size(), keys.size());
}

TEST_P(ManualsGsd, HasTheModulesOfTheMadeOne)
{
    const SecondHand made = second_hand(test::made(profile_, {}));
    ASSERT_EQ(gsd_.modules.size(), made.modules.size());
    for (std::size_t i = 0; i < made.modules.size(); ++i) {
        EXPECT_EQ(gsd_.modules[i].name, made.modules[i].name);
        EXPECT_EQ(gsd_.modules[i].identifiers, made.modules[i].identifiers);
    }
}

INSTANTIATE_TEST_SUITE_P(OfAppendixA, ManualsGsd,
                         testing::Values(std::pair{"584s-590", "584s"}, std::pair{"584s-590", "590"},
                                         std::pair{"620", "620"}),
                         [](const auto& one) { return "AndProfile" + test::case_name(one.param.second); });

TEST(ManualsGsdFlags, AreThoseOfTheProfilesThatReallyWork)
{
    for (const char* name : {"584s", "590", "620"}) {
        const dp::Personality personality = load(name).personality;
        EXPECT_TRUE(personality.sync && personality.freeze) << name;
        EXPECT_FALSE(personality.fail_safe) << name;
        EXPECT_EQ(personality.max_diag_length, 6U) << name;
        EXPECT_EQ(personality.diag_octets, 0) << "no extended diagnosis";
    }
}

} // namespace
} // namespace dpslave
