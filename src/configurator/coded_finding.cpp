// SPDX-License-Identifier: Apache-2.0
#include "coded_finding.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::configurator {

void add_notes(std::vector<CodedFinding>& all, const std::vector<profile::Note>& notes,
               const std::vector<profile::GsdParameter>& parameters)
{
    for (const profile::Note& note : notes) {
        const auto severity = note.refuses ? gsd::Severity::error : gsd::Severity::warning;
        all.push_back(
            {{0, severity, note.text}, note.code, note.field.empty() ? "list" : note.field, note.at});
        if (note.at) all.back().tag = parameters[*note.at].tag;
    }
}

void add_advice(std::vector<CodedFinding>& all, const gsd::Document& file)
{
    for (const gsd::Advice& advice : gsd::io_map(file, {}).advice)
        all.push_back({{0, gsd::Severity::warning, advice.text}, advice.code, "list", {}});
}

/// A finding about the name alone is one that does not appear without the name: another file name corrects
/// it.
void add_check(std::vector<CodedFinding>& all, const gsd::Document& file, gsd::Reading reading,
               std::string_view name)
{
    const gsd::Findings nameless = gsd::check(file, reading);
    for (gsd::Finding& finding : gsd::check(file, reading, name)) {
        const bool of_file = std::any_of(nameless.begin(), nameless.end(), [&](const gsd::Finding& other) {
            return other.what == finding.what;
        });
        all.push_back({std::move(finding), of_file ? "file" : "file_name", of_file ? "" : "name", {}});
    }
}

std::vector<CodedFinding> coded_findings(const profile::Draft& draft, const gsd::Document* file,
                                         gsd::Reading reading, std::string_view name)
{
    std::vector<CodedFinding> all;
    add_notes(all, draft.notes, draft.parameters);
    if (file == nullptr) return all;
    add_advice(all, *file);
    const bool is_refused = std::any_of(draft.notes.begin(), draft.notes.end(),
                                        [](const profile::Note& note) { return note.refuses; });
    if (!is_refused) add_check(all, *file, reading, name);
    return all;
}

Json facts_of(const std::vector<CodedFinding>& all)
{
    Json facts = Json::array();
    for (const CodedFinding& one : all) {
        Json fact{{"code", one.code},
                  {"severity", one.finding.severity == gsd::Severity::error ? "error" : "warning"},
                  {"text", printable(one.finding.what)}};
        if (one.finding.line > 0) fact["line"] = one.finding.line;
        if (!one.field.empty()) fact["field"] = one.field;
        if (one.at) fact["at"] = *one.at;
        if (one.tag) fact["tag"] = *one.tag;
        facts.push_back(std::move(fact));
    }
    return facts;
}

} // namespace dpslave::configurator
