// SPDX-License-Identifier: Apache-2.0
// A device that is made, and what the station says to its file.
#include "gsd_made.hpp"
#include "module_lists.hpp"

#include "dpslave/dp/set_prm.hpp"
#include "dpslave/profile/gsd_judge.hpp"
#include "dpslave/refusal/words.hpp"

namespace dpslave::profile {
namespace {

/// The parameter that a refusal is about.
std::optional<std::size_t> parameter_of(const dp::RefusalDetail& detail, const Draft& draft)
{
    const std::size_t octet = detail.octet - std::size_t{1};
    if (detail.octet == 0) return std::nullopt;
    if (dp::service_of(detail.why) == dp::Service::set_prm) {
        const std::size_t first = dp::kPrmHeader + draft.tags_at, at = (octet - first) / 2;
        return octet >= first && at < draft.parameters.size() ? std::optional{at} : std::nullopt;
    }
    for (std::size_t at = 0; at < draft.cfg_places.size(); ++at)
        if (const auto [begin, count] = draft.cfg_places[at]; octet >= begin && octet < begin + count)
            return at;
    return std::nullopt;
}

void say_that_modules_differ(Draft& draft)
{
    draft.notes.push_back(
        {true,
         "modules_differ",
         "the modules of the mapping do not make its parameters: their number, an order, a direction or Demand Data differs. Make the two agree, or remove the modules.",
         {},
         "modules"});
}

/// Adds whether a station with the file's own keys accepts it as it was meant.
void add_verdict(const Profile& profile, const Selection& selection, Draft& draft)
{
    StationKeys keys = selection.keys();
    if (!wrong_keys(profile, keys).empty()) return; // said already
    keys.ident = draft.device.ident;
    const gsd::Document document = gsd::parse(gsd::write(draft.device));
    const dp::Personality personality = personality_of(profile, keys);
    const bool is_choice = gsd::plugging_of(document) == gsd::Plugging::choice;
    const bool has_both = !selection.modules.empty() && (!draft.parameters.empty() || selection.demand);
    std::optional<std::vector<const gsd::Module*>> list;
    if (has_both && is_choice) {
        list = list_of_words(personality, document, draft.parameters, selection.demand);
        if (!list) return say_that_modules_differ(draft);
        if (const std::string limit = gsd::broken_limit(document, *list, false); !limit.empty()) {
            draft.notes.push_back({true, "limit", "the parameters do not fit: " + limit, {}, "modules"});
            return;
        }
    }
    const FileVerdict verdict = judge_file(personality, document, list);
    if (verdict.refused) {
        const dp::RefusalDetail& detail = verdict.refused->detail;
        draft.notes.push_back(
            {true, refusal::code(detail.why), sentence(*verdict.refused), parameter_of(detail, draft), {}});
    } else if (has_both && (parameters_of(verdict.taken) != draft.parameters ||
                            verdict.taken.demand != selection.demand)) {
        say_that_modules_differ(draft);
    }
}

} // namespace

std::vector<GsdParameter> parameters_of(const dp::Configuration& taken)
{
    std::vector<GsdParameter> all;
    for (std::size_t i = 0; i < taken.layout.count; ++i) {
        const auto& one = taken.layout.parameters[i];
        using enum Direction;
        all.push_back({one.reads && one.writes ? in_out : one.reads ? in : out, one.tag});
    }
    return all;
}

Draft draft_of(const Profile& profile, const Selection& selection)
{
    Draft draft = made(profile, selection);
    if (!draft.device.modules.empty()) add_verdict(profile, selection, draft);
    return draft;
}

Result<GsdDevice, std::vector<std::string>> device_of(const Profile& profile, const Selection& selection)
{
    Draft draft = draft_of(profile, selection);
    std::vector<std::string> warnings, refused;
    for (Note& note : draft.notes) (note.refuses ? refused : warnings).push_back(std::move(note.text));
    if (!refused.empty()) return Failure{std::move(refused)};
    return GsdDevice{std::move(draft.device), std::move(warnings)};
}

} // namespace dpslave::profile
