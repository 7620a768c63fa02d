// SPDX-License-Identifier: Apache-2.0
// What is said of a GSD file is what the slave does: files made by changes of good ones (tools/run gsd-files:
// 10 000). A reader of its own makes the telegrams of each, and a slave takes them or refuses them.
#include "changed_files.hpp"
#include "second_hand.hpp"
#include "support/count_of.hpp"

#include "dpslave/dp/slave.hpp"
#include "dpslave/profile/gsd_judge.hpp"
#include "dpslave/refusal/words.hpp"

#include <gmock/gmock.h>

#include <map>

namespace dpslave {
namespace {

/// What a slave says to a master that sends these two telegrams.
dp::RefusalDetail answer_of(const dp::Personality& personality, const sim::GsdTelegrams& telegrams)
{
    constexpr std::uint8_t kMaster = 2, kMasterSap = 62, kSetPrm = 61, kChkCfg = 62;
    dp::Slave slave{personality, 5};
    const Instant now{std::chrono::seconds{1}};
    slave.start(now);
    fdl::ReplyData reply;
    slave.srd({kMaster, kSetPrm, kMasterSap, telegrams.set_prm, now}, reply);
    if (slave.snapshot().refusal.why != dp::Refusal::none) return slave.snapshot().refusal;
    slave.srd({kMaster, kChkCfg, kMasterSap, telegrams.chk_cfg, now}, reply);
    if (slave.snapshot().refusal.why != dp::Refusal::none) return slave.snapshot().refusal;
    EXPECT_EQ(slave.state(), dp::State::data_exch);
    return {};
}

/// "#1", "#3": the modules by their places in the file.
std::vector<std::string> places_of(const std::vector<const gsd::Module*>& modules,
                                   const gsd::Document& document)
{
    std::vector<std::string> names;
    for (const gsd::Module* module : modules)
        names.push_back('#' + std::to_string(module - document.modules.data() + 1));
    return names;
}

class Judged {
public:
    std::map<std::string, std::size_t> codes; ///< of refusals; "" = taken
    std::size_t files = 0, not_comparable = 0;

    void judge(const dp::Personality& personality, const std::string& text, test::ChangedFiles& changes)
    {
        ++files;
        const gsd::Document document = gsd::parse(text);
        const profile::FileVerdict verdict = profile::judge_file(personality, document);
        auto telegrams = test::telegrams_of(text, places_of(verdict.modules, document));
        if (!telegrams) {
            ++not_comparable; // the file contradicts itself, and the check of its form says so
            return;
        }
        if (verdict.tags_are_open && !verdict.refused)
            test::type_tags(*telegrams, personality.prm.tags_at, verdict.taken.layout.count);
        const dp::RefusalDetail said = answer_of(personality, *telegrams);
        const dp::RefusalDetail judged = verdict.refused ? verdict.refused->detail : dp::RefusalDetail{};
        ++codes[said.why == dp::Refusal::none ? "" : std::string{refusal::code(said.why)}];
        ASSERT_EQ(refusal::code(judged.why), refusal::code(said.why)) << text;
        if (!verdict.tags_are_open) {
            ASSERT_EQ(judged, said) << text;
        }
        if (verdict.refused && verdict.plugging == gsd::Plugging::choice)
            no_list_is_taken(personality, document, text, changes);
    }

private:
    static void no_list_is_taken(const dp::Personality& personality, const gsd::Document& document,
                                 const std::string& text, test::ChangedFiles& changes)
    {
        if (document.modules.empty()) return;
        const std::size_t most = std::min<std::size_t>(gsd::limits_of(document).modules, 14);
        for (int i = 0; i < 4; ++i) {
            std::vector<std::string> names;
            for (std::size_t count = 1 + changes.below(most); count > 0; --count)
                names.push_back('#' + std::to_string(1 + changes.below(document.modules.size())));
            const auto telegrams = test::telegrams_of(text, names);
            if (!telegrams) continue;
            ASSERT_NE(answer_of(personality, *telegrams).why, dp::Refusal::none)
                << text << testing::PrintToString(names);
        }
    }
};

TEST(Verdict, OfAFileIsWhatTheSlaveSaysToItsTelegrams)
{
    const std::size_t files_wanted = test::count_of("VERDICT_FILES", 2000);
    test::ChangedFiles changes{20261128};
    std::vector<profile::Profile> profiles;
    for (const std::string& name : test::kProfiles) profiles.push_back(test::load(name));
    Judged judged;
    while (judged.files < files_wanted && !HasFatalFailure()) {
        const profile::Profile& profile = profiles[judged.files % profiles.size()];
        const std::string text = changes.next(profile);
        const dp::Personality personality =
            personality_of(profile, {.ident = profile.ident.value_or(test::kOwnIdent)});
        judged.judge(personality, text, changes);
    }
    for (const auto& [code, count] : judged.codes) {
        RecordProperty(code.empty() ? "taken" : code, static_cast<int>(count));
        std::cout << (code.empty() ? "taken" : code) << ' ' << count << '\n';
    }
    std::cout << "not comparable " << judged.not_comparable << '\n';
    EXPECT_GE(judged.codes[""], files_wanted * 4 / 10);
    EXPECT_LE(judged.not_comparable, files_wanted / 10);
    // prm_watchdog and cfg_changed are not in this list: no file can cause them.
    const std::size_t of_each = files_wanted >= 10'000 ? 50 : 1;
    for (const auto why : {dp::Refusal::prm_ident, dp::Refusal::prm_not_supported, dp::Refusal::prm_length,
                           dp::Refusal::prm_dpv1, dp::Refusal::prm_tag_too_large, dp::Refusal::prm_zero_tag,
                           dp::Refusal::cfg_empty, dp::Refusal::cfg_too_long, dp::Refusal::cfg_identifier,
                           dp::Refusal::cfg_too_few, dp::Refusal::cfg_too_many})
        EXPECT_GE(judged.codes[std::string{refusal::code(why)}], of_each) << refusal::code(why);
}

} // namespace
} // namespace dpslave
