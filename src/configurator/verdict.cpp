// SPDX-License-Identifier: Apache-2.0
#include "verdict.hpp"

#include "import.hpp"
#include "recognise.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/refusal/words.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

std::string counted(std::size_t count, const std::string& what)
{
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

/// Returns what the profile says of the mapping of a file that the slave accepts. If the master's project has
/// the list of modules, directions are not judged.
profile::Draft draft_of_file(const profile::Profile& profile, const gsd::Document& document,
                             const profile::FileVerdict& verdict)
{
    const auto mapping = mapping_of_file(document, profile);
    if (!mapping) return {};
    profile::Selection selection = mapping->selection;
    if (!verdict.other_lists) {
        selection.tags.reset();
        selection.modules.clear();
        selection.list = profile::parameters_of(verdict.taken);
        selection.demand = verdict.taken.demand;
    }
    profile::Draft draft = profile::draft_of(profile, selection);
    std::erase_if(draft.notes, [](const profile::Note& note) { // the slave has taken it
        return note.code.starts_with("prm_") || note.code.starts_with("cfg_") ||
               note.code == "modules_differ";
    });
    for (profile::Note& note : draft.notes) note.refuses = false;
    return draft;
}

/// Returns what else to do if the file is the plant's; empty if there is nothing.
std::string_view remedy_for(dp::Refusal why)
{
    return why == dp::Refusal::prm_ident ? " Or write the ident of the file into the station." : "";
}

} // namespace

Judged judge_as(const profile::Profile& profile, const profile::StationKeys& keys,
                const gsd::Document& document, const std::optional<std::vector<const gsd::Module*>>& modules)
{
    const dp::Personality personality = profile::personality_of(profile, keys_for(profile, document, keys));
    Judged judged{.verdict = profile::judge_file(personality, document, modules)};
    if (!judged.verdict.refused && !judged.verdict.tags_are_open && personality.prm.list != dp::TagList::none)
        judged.draft = draft_of_file(profile, document, judged.verdict);
    if (judged.verdict.refused) judged.plant_keys = configurator::plant_keys(profile, document, modules);
    return judged;
}

std::string names_of(const profile::StationKeys& keys)
{
    std::string names = keys.tags_at ? "tags_at" : "";
    if (!keys.identifiers.empty()) names += names.empty() ? "identifiers" : " and identifiers";
    return names;
}

std::string refusal_words(const Judged& judged)
{
    const profile::Refused& refused = *judged.verdict.refused;
    std::string words = sentence(refused);
    if (!judged.verdict.limit.empty()) words += ' ' + judged.verdict.limit;
    words += remedy_for(refused.detail.why);
    const profile::StationKeys& keys = judged.plant_keys.keys;
    if (names_of(keys).empty() || judged.plant_keys.verdict.refused) return words;
    if (judged.plant_keys.is_ambiguous)
        return words +
               " If this is the plant's file, the station needs tags_at: the file does not say which of several places it is. Ask who made it.";
    words += " If this is the plant's file, write into its [[station]]:";
    if (keys.tags_at) words += " tags_at = " + std::to_string(*keys.tags_at);
    std::string identifiers;
    for (const dp::Identifier& one : keys.identifiers)
        identifiers += (identifiers.empty() ? "\"" : ", \"") + profile::to_string(one) + '"';
    if (!identifiers.empty())
        words += std::string{keys.tags_at ? " and" : ""} + " identifiers = [" + identifiers + ']';
    return words + '.';
}

namespace {

void add_not_usable(std::vector<CodedFinding>& all, const profile::FileVerdict& verdict)
{
    for (const gsd::Module* module : verdict.not_usable)
        all.push_back(
            {{module->line, gsd::Severity::warning,
              "the station takes the module \"" + utf8_of_latin1(module->name) +
                  "\" in no list: an identifier of it is not legal there. If the plant uses the module, write identifiers into its [[station]]."},
             "module_not_taken",
             "",
             {}});
}

} // namespace

std::vector<CodedFinding> coded_findings(const Judged& judged)
{
    std::vector<CodedFinding> all;
    add_notes(all, judged.draft.notes, judged.draft.parameters);
    if (!judged.verdict.refused) {
        add_not_usable(all, judged.verdict);
        return all;
    }
    const profile::Refused& refused = *judged.verdict.refused;
    all.push_back({{refused.line, gsd::Severity::error, refusal_words(judged)},
                   refusal::code(refused.detail.why),
                   "list",
                   {}});
    return all;
}

std::string fits(const profile::FileVerdict& verdict)
{
    std::string modules;
    for (const gsd::Module* module : verdict.modules) modules += (modules.empty() ? "" : ", ") + module->name;
    std::string text = "fits";
    if (verdict.tags_are_open)
        return text +
               ": its modules are taken with as many tags in User_Prm_Data as they have words. The tags are in the master's project.";
    text += " with " + counted(verdict.taken.layout.count, "word") +
            (verdict.taken.demand ? " and Demand Data" : "");
    if (verdict.plugging == gsd::Plugging::fixed) return text + '.';
    if (!verdict.other_lists) return text + ": " + modules + '.';
    return text + ", for example: " + modules + ". The master's project has the list.";
}

Json facts_of(const profile::Refused& refused)
{
    const dp::RefusalDetail& detail = refused.detail;
    const auto [expected, got] = refusal::expected_and_got(detail);
    return {{"code", refusal::code(detail.why)},
            {"telegram", refusal::name_of(dp::service_of(detail.why))},
            {"octet", detail.octet != 0 ? Json(detail.octet) : Json()},
            {"expected", expected.empty() ? Json() : Json(expected)},
            {"got", got.empty() ? Json() : Json(got)},
            {"line", refused.line}};
}

Json facts_of(const profile::FileVerdict& verdict)
{
    Json modules = Json::array();
    for (const gsd::Module* module : verdict.modules)
        modules.push_back(printable(utf8_of_latin1(module->name)));
    Json facts{{"taken", !verdict.refused}, {"modules", modules}};
    if (verdict.refused) {
        facts["refusal"] = facts_of(*verdict.refused);
        return facts;
    }
    facts["words"] = verdict.tags_are_open ? Json() : Json(verdict.taken.layout.count);
    facts["demand"] = verdict.taken.demand;
    facts["other_lists"] = verdict.other_lists;
    facts["tags_are_open"] = verdict.tags_are_open;
    return facts;
}

} // namespace dpslave::configurator
