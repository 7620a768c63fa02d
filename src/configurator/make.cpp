// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

/// The messages of a file that is made, as dpctl prints them: notes, lengths, then what a tool would say of
/// the file. One that a tool refuses is not made.
void add_messages(Outcome& outcome, const profile::Draft& draft, const std::string& path)
{
    const gsd::Document document = gsd::parse(outcome.octets);
    for (const profile::Note& note : draft.notes)
        outcome.messages.push_back("warning: " + printable(note.text));
    for (const gsd::Advice& advice : gsd::io_map(document, {}).advice)
        outcome.messages.push_back("warning: " + printable(advice.text));
    const std::string name = path.substr(path.rfind('/') + 1);
    for (const gsd::Finding& finding : gsd::check(document, gsd::Reading::tolerant, name))
        if (finding.severity == gsd::Severity::error)
            outcome.refusals.push_back("the file would be faulty: " + printable(finding.what));
        else if (!path.empty())
            outcome.messages.push_back(line_of(path, finding));
    if (outcome.refusals.empty()) return;
    outcome.exit = kNo;
    outcome.octets.clear();
}

} // namespace

Outcome make(const Files& files, const profile::Mapping& mapping, const std::string& table,
             const std::string& path)
{
    Outcome outcome;
    const auto profile = load(files, mapping, table, outcome);
    if (!profile) return outcome;
    const profile::Draft draft = profile::draft_of(*profile, mapping.selection);
    outcome.facts =
        text_of(preview_of(*profile, draft, mapping.selection.demand, path.substr(path.rfind('/') + 1)));
    for (const profile::Note& note : draft.notes)
        if (note.refuses) outcome.refusals.push_back(note.text);
    if (!outcome.refusals.empty()) {
        outcome.exit = kNo;
        return outcome;
    }
    outcome.octets = gsd::write(draft.device);
    add_messages(outcome, draft, path);
    return outcome;
}

} // namespace dpslave::configurator
