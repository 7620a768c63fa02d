// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/gsd_judge.hpp"

#include "module_lists.hpp"

#include "dpslave/base/bytes.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/refusal/words.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

unsigned line_at(const gsd::LinedOctets& octets, std::size_t at, unsigned otherwise)
{
    return at < octets.lines.size() && octets.lines[at] != 0 ? octets.lines[at] : otherwise;
}

/// The line that says what was refused.
unsigned line_of(const dp::RefusalDetail& detail, const gsd::Sent& sent)
{
    const unsigned modules = line_at(sent.cfg, 0, 0);
    if (dp::service_of(detail.why) == dp::Service::chk_cfg)
        return detail.octet == 0 ? modules : line_at(sent.cfg, detail.octet - 1U, modules);
    if (detail.why == dp::Refusal::prm_ident) return sent.ident_line;
    if (detail.why == dp::Refusal::prm_not_supported)
        return (detail.got & ~detail.expected & 0x20) != 0 ? sent.sync_line : sent.freeze_line;
    if (detail.octet > dp::kPrmHeader)
        return line_at(sent.user, detail.octet - dp::kPrmHeader - 1, sent.length_line);
    return sent.length_line;
}

Failure<Refused> refused(const dp::RefusalDetail& detail, const gsd::Sent& sent)
{
    return {{detail, line_of(detail, sent)}};
}

/// Room for a tag, and none in it. A device that refuses a tag 0 has no open ones.
bool has_open_tags(const dp::Personality& personality, const gsd::Sent& sent)
{
    const dp::PrmLayout& prm = personality.prm;
    const std::vector<std::uint8_t>& user = sent.user.octets;
    if (prm.list == dp::TagList::none || prm.list == dp::TagList::exact || user.size() < prm.tags_at + 2)
        return false;
    return std::all_of(user.begin() + static_cast<std::ptrdiff_t>(prm.tags_at), user.end(),
                       [](std::uint8_t octet) { return octet == 0; });
}

/// Puts in as many tags as the modules have words: 1, 2, 3 ...
gsd::Sent with_any_tags(const gsd::Sent& sent, const dp::Personality& personality)
{
    const std::size_t room = (sent.user.octets.size() - personality.prm.tags_at) / 2;
    std::vector<std::uint16_t> tags;
    gsd::Sent with = sent;
    // The slave itself counts the words: as many tags as it expects.
    while (tags.size() < room) {
        const auto verdict = judge(personality, with);
        if (verdict || verdict.error().detail.why != dp::Refusal::cfg_too_many) return with;
        tags.push_back(static_cast<std::uint16_t>(tags.size() + 1));
        with = with_tags(sent, personality.prm, tags);
    }
    return with;
}

FileVerdict verdict_of(const dp::Personality& personality, const gsd::Document& document,
                       std::vector<const gsd::Module*> modules)
{
    FileVerdict verdict;
    verdict.plugging = gsd::plugging_of(document);
    verdict.modules = std::move(modules);
    if (verdict.plugging == gsd::Plugging::choice) verdict.not_usable = not_usable(personality, document);
    gsd::Sent sent = gsd::sent_by_master(document, verdict.modules);
    verdict.tags_are_open = verdict.plugging == gsd::Plugging::choice && has_open_tags(personality, sent);
    if (verdict.tags_are_open) sent = with_any_tags(sent, personality);
    const auto taken = judge(personality, sent);
    if (taken)
        verdict.taken = *taken;
    else
        verdict.refused = taken.error();
    return verdict;
}

/// No list of the file's modules is accepted for this number of tags: the verdict is about the one that comes
/// closest.
FileVerdict verdict_without_a_list(const dp::Personality& personality, const gsd::Document& document,
                                   std::size_t tags)
{
    FileVerdict verdict = verdict_of(personality, document, closest_list(personality, document, tags));
    if (!verdict.refused || verdict.refused->detail.why != dp::Refusal::cfg_too_few ||
        verdict.modules.empty())
        return verdict;
    std::vector<const gsd::Module*> longer = verdict.modules;
    longer.push_back(longer.back());
    verdict.limit = gsd::broken_limit(document, longer);
    return verdict;
}

} // namespace

std::string sentence(const Refused& refused)
{
    return std::string{refusal::name_of(dp::service_of(refused.detail.why))} +
           " would be refused: " + refusal::clause(refused.detail) + '.';
}

Result<dp::Configuration, Refused> judge(const dp::Personality& personality, const gsd::Sent& sent)
{
    const auto parameters = dp::check_set_prm(personality, gsd::set_prm_of(sent));
    if (!parameters) return refused(parameters.error(), sent);
    const auto configuration = dp::check_chk_cfg(personality, parameters->tags(), sent.cfg.octets);
    if (!configuration) return refused(configuration.error(), sent);
    return *configuration;
}

gsd::Sent with_tags(gsd::Sent sent, const dp::PrmLayout& layout, const std::vector<std::uint16_t>& tags)
{
    std::vector<std::uint8_t>& user = sent.user.octets;
    std::fill(user.begin() + static_cast<std::ptrdiff_t>(std::min(layout.tags_at, user.size())), user.end(),
              std::uint8_t{0});
    std::size_t at = layout.tags_at;
    for (const std::uint16_t tag : tags) {
        if (at + 2 > user.size()) break;
        user[at++] = high(tag);
        user[at++] = low(tag);
    }
    return sent;
}

FileVerdict judge_file(const dp::Personality& personality, const gsd::Document& document,
                       const std::optional<std::vector<const gsd::Module*>>& modules)
{
    if (modules) return verdict_of(personality, document, *modules);
    if (gsd::plugging_of(document) == gsd::Plugging::fixed)
        return verdict_of(personality, document, gsd::plugged_modules(document));

    if (auto preset = gsd::preset_modules(document); !preset.empty()) { // as the master's tool begins
        FileVerdict verdict = verdict_of(personality, document, std::move(preset));
        verdict.other_lists = true;
        if (!verdict.refused) return verdict;
    }
    const gsd::Sent sent = gsd::sent_by_master(document, {});
    const auto parameters = dp::check_set_prm(personality, gsd::set_prm_of(sent));
    const bool any = personality.prm.list == dp::TagList::none || has_open_tags(personality, sent);
    const std::size_t tags = parameters ? parameters->tags().size() : 0;
    if (auto list = list_of_modules(personality, document, any ? std::nullopt : std::optional{tags})) {
        FileVerdict verdict = verdict_of(personality, document, std::move(list->modules));
        verdict.other_lists = !list->is_only_one;
        if (!verdict.refused) return verdict;
    }
    // Modules that bring tags of their own: their number depends on the list.
    const bool have_tags = gsd::any_own_parameters(document);
    for (std::size_t words = 0; have_tags && words <= personality.max_parameters; ++words)
        if (auto list = list_of_modules(personality, document, words)) {
            FileVerdict verdict = verdict_of(personality, document, std::move(list->modules));
            verdict.other_lists = true;
            if (!verdict.refused) return verdict;
        }
    return verdict_without_a_list(personality, document, tags);
}

} // namespace dpslave::profile
