// SPDX-License-Identifier: Apache-2.0
// What `dpctl gsd check` says of a file is what the daemon says to a master that has it. The reader of dpsim
// makes the telegrams; tests/gsd judges many more of such files with a slave in one process.
// Only here: the verdict of one program against the telegrams of another one.
#include "gsd/changed_files.hpp"
#include "gsd/second_hand.hpp"
#include "support/paths.hpp"
#include "system/gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace dpslave::test {
namespace {

constexpr std::size_t kFilesOfAProfile = 36; // 324 of all nine

constexpr std::size_t kLongest = 244; // octets that a telegram has room for

std::string in_hex(const std::vector<std::uint8_t>& octets)
{
    return octets.empty() ? "none" : fmt::format("{:02X}", fmt::join(octets, ""));
}

/// Of the modules that the profiles have: an octet for each word, and that of Demand Data.
std::size_t words_of(const std::vector<std::uint8_t>& chk_cfg)
{
    constexpr std::uint8_t kDemandData = 0x73;
    return chk_cfg.size() - static_cast<std::size_t>(std::count(chk_cfg.begin(), chk_cfg.end(), kDemandData));
}

/// The station that a file is for.
std::string ident_of(const profile::Profile& profile)
{
    return fmt::format("0x{:04X}", profile.ident.value_or(kOwnIdent));
}
Wiring station_of(const std::string& name, const profile::Profile& profile)
{
    Wiring wiring;
    wiring.profile = name;
    wiring.simulated = false; // Set_Prm and Chk_Cfg are judged without a drive
    if (name == "2408f" || name == "2404f") {
        wiring.protocol = "modbus-rtu";
        wiring.units = {"1"};
    }
    if (!profile.ident) wiring.keys = "ident = " + ident_of(profile) + '\n';
    return wiring;
}

/// What `dpctl gsd check` says of each of these files.
std::vector<Json> verdicts_of(const Gateway& gateway, const std::string& profile, const std::string& ident,
                              const Arguments& files)
{
    Arguments command{"gsd",       "check",      "--json",
                      "--profile", profile,      "--ident",
                      ident,       "--profiles", source_path("config/profiles")};
    command.insert(command.end(), files.begin(), files.end());
    std::istringstream lines{gateway.dpctl(command).out};
    std::vector<Json> verdicts;
    for (std::string line; std::getline(lines, line);) verdicts.push_back(Json::parse(line).at("verdict"));
    return verdicts;
}

/// What the daemon says to a master that sends these two telegrams, in the words of a verdict: a refusal, or
/// null.
void expect_answer(const Gateway& gateway, Master& master, const sim::GsdTelegrams& telegrams,
                   const Json& expected)
{
    EXPECT_TRUE(master.does("set-prm " + in_hex(telegrams.set_prm)));
    EXPECT_TRUE(master.does("try chk-cfg " + in_hex(telegrams.chk_cfg)));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(
        master.does(expected.is_null() ? "expect diag not prm-required" : "expect diag prm-required"));
    Json said;
    const auto is_said = [&] { // dpctl may still show the one before for a moment
        said = gateway.diagnosis().at("refusal");
        if (expected.is_null() || said.is_null()) return said == expected;
        return said.at("code") == expected.at("code") && said.at("octet") == expected.at("octet") &&
               said.at("got") == expected.at("got") && said.at("expected") == expected.at("expected");
    };
    EXPECT_TRUE(eventually(is_said)) << "expected " << expected << ", the daemon says " << said;
    EXPECT_TRUE(master.does("try unlock"));
}

/// Judges files for this profile; counts the codes of their refusals, "" for those that are taken.
void judge(const std::string& name, ChangedFiles& changes, std::map<std::string, std::size_t>& codes)
{
    const profile::Profile profile = load(name);
    const Gateway gateway{station_of(name, profile)};
    Master master{gateway, {"--prm", "none", "--cfg", "50", "--no-watchdog"}};

    std::vector<std::string> texts;
    Arguments files;
    for (std::size_t i = 0; i < kFilesOfAProfile; ++i) {
        texts.push_back(changes.next(profile));
        files.push_back(gateway.folder(fmt::format("{}.gsd", i)));
        write_file(files.back(), texts.back());
    }
    const std::vector<Json> verdicts = verdicts_of(gateway, name, ident_of(profile), files);
    ASSERT_EQ(verdicts.size(), texts.size());

    for (std::size_t i = 0; i < texts.size() && !::testing::Test::HasFailure(); ++i) {
        SCOPED_TRACE(texts[i]);
        const Json& verdict = verdicts[i];
        auto telegrams = telegrams_of(texts[i], verdict.at("modules").get<std::vector<std::string>>());
        if (!telegrams) continue; // the file contradicts itself, and the check of its form says so
        if (telegrams->set_prm.size() > kLongest || telegrams->chk_cfg.size() > kLongest) continue;
        const bool is_taken = verdict.at("taken");
        if (is_taken && verdict.at("tags_are_open"))
            type_tags(*telegrams, profile.personality.prm.tags_at, words_of(telegrams->chk_cfg));
        expect_answer(gateway, master, *telegrams, is_taken ? Json{} : verdict.at("refusal"));
        ++codes[is_taken ? "" : verdict.at("refusal").at("code").get<std::string>()];
    }
}

TEST(Verdict, OfDpctlOnAFileIsWhatTheDaemonSaysToItsMaster)
{
    ChangedFiles changes{20261129};
    std::map<std::string, std::size_t> codes;
    for (const std::string& profile : kProfiles) {
        SCOPED_TRACE(profile);
        judge(profile, changes, codes);
        if (HasFailure()) return;
    }
    std::size_t judged = 0;
    for (const auto& [code, count] : codes) judged += count;
    EXPECT_GE(judged, 300U);
    EXPECT_GE(codes[""], judged * 4 / 10);
    for (const char* const code :
         {"prm_ident", "prm_not_supported", "prm_length", "prm_dpv1", "prm_tag_too_large", "prm_zero_tag",
          "cfg_empty", "cfg_too_long", "cfg_identifier", "cfg_too_few", "cfg_too_many"})
        EXPECT_GE(codes[code], 1U) << code;
}

} // namespace
} // namespace dpslave::test
