// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"
#include "recognise.hpp"
#include "verdict.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/configurator/configurator.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

std::string counted(std::size_t count, const std::string& what)
{
    return std::to_string(count) + ' ' + what + (count == 1 ? "" : "s");
}

std::size_t errors_in(const gsd::Findings& findings)
{
    return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), [](const auto& one) {
        return one.severity == gsd::Severity::error;
    }));
}

} // namespace

bool any_error(const gsd::Findings& findings)
{
    return errors_in(findings) > 0;
}

std::string line_of(std::string_view path, const gsd::Finding& finding)
{
    std::string line{path};
    if (finding.line > 0) line += ':' + std::to_string(finding.line);
    line += finding.severity == gsd::Severity::error ? ": error: " : ": warning: ";
    return line + printable(finding.what);
}

std::string summary(const gsd::Findings& findings)
{
    const std::size_t errors = errors_in(findings);
    if (findings.empty()) return "no errors and no warnings";
    return counted(errors, "error") + ", " + counted(findings.size() - errors, "warning");
}

void say_unread(const gsd::Document& document, std::string_view whose, Outcome& outcome)
{
    constexpr std::size_t kMost = 10; // a file of another kind has hundreds
    const std::string begin = "warning: " + std::string{whose};
    std::size_t count = 0;
    for (const gsd::Finding& one : gsd::check(document, gsd::Reading::tolerant)) {
        if (!one.unread || ++count > kMost) continue;
        const std::string line = one.line > 0 ? "line " + std::to_string(one.line) + ": " : std::string{};
        outcome.messages.push_back(begin + line + printable(one.what));
    }
    if (count <= kMost) return;
    const std::size_t more = count - kMost;
    outcome.messages.push_back(begin + counted(more, "more line") + (more == 1 ? " is" : " are") +
                               " not understood: check the file to read " + (more == 1 ? "it." : "them."));
}

gsd::Findings form_of(const gsd::Document& document, std::string_view path, bool strict)
{
    const std::string_view name = path.substr(path.rfind('/') + 1);
    gsd::Findings findings =
        gsd::check(document, strict ? gsd::Reading::strict : gsd::Reading::tolerant, name);
    if (!document.has_section) // no GSD file at all: what is remarkable about its lines is beside the point
        std::erase_if(findings, [](const gsd::Finding& one) { return one.severity != gsd::Severity::error; });
    return findings;
}

void add_findings(Outcome& outcome, std::string_view path, const gsd::Findings& findings)
{
    for (const gsd::Finding& finding : findings) outcome.lines.push_back(line_of(path, finding));
    outcome.lines.push_back(std::string{path} + ": " + summary(findings));
    if (any_error(findings)) outcome.exit = kNo;
}

namespace {

/// The profile that is named, or those that the file may be for; none: only its form can be judged.
std::vector<profile::Profile> devices_of(const Files& files, std::string_view file,
                                         const gsd::Document& document, const CheckOptions& options,
                                         Outcome& outcome)
{
    std::vector<profile::Profile> devices;
    std::string name = options.profile;
    if (name.empty()) {
        Recognised recognised = recognise(files, file, document);
        if (recognised.is_guess || recognised.profiles.empty()) return devices;
        devices = std::move(recognised.profiles);
        name = devices.front().name;
    }
    if (auto profile = load(files, name, options.table, outcome)) { // with its tags
        devices.resize(std::max<std::size_t>(devices.size(), 1));
        devices.front() = *std::move(profile);
    }
    return devices;
}

Json names_as_json(const std::vector<profile::Profile>& profiles)
{
    Json names = Json::array();
    for (const profile::Profile& profile : profiles) names.push_back(profile.name);
    return names;
}

} // namespace

Outcome check(const Files& files, std::string_view file, std::string_view path, const CheckOptions& options)
{
    const gsd::Document document = gsd::parse(file);
    const auto reading = options.strict ? gsd::Reading::strict : gsd::Reading::tolerant;
    Outcome outcome;
    if (!document.has_section) {
        const gsd::Findings findings = form_of(document, path, options.strict);
        add_findings(outcome, path, findings);
        outcome.facts = text_of({{"findings", findings_of(findings)}});
        return outcome;
    }
    std::string why;
    const auto modules = modules_asked(document, options.modules, why);
    if (!why.empty()) return {.exit = kUsage, .refusals = {printable(why)}};
    const bool is_of_a_master = document.number("Station_Type") == 1U; // add_check() says so
    const auto devices = is_of_a_master ? std::vector<profile::Profile>{}
                                        : devices_of(files, file, document, options, outcome);
    if (!devices.empty())
        for (const profile::WrongKey& one : profile::wrong_keys(devices.front(), options.keys)) {
            outcome.refusals.push_back(one.sentence);
            outcome.exit = kUsage;
        }
    if (outcome.exit != kFine) return outcome;

    Json facts{{"profiles", names_as_json(devices)}};
    std::vector<CodedFinding> all;
    std::string verdict =
        "only the form was judged: the file says of no profile that it is for it. Name the profile to judge whether a station takes it.";
    if (!devices.empty()) { // those that are left differ in nothing that is judged here
        const Judged judged = judge_as(devices.front(), options.keys, document, modules);
        all = coded_findings(judged);
        if (!judged.verdict.refused) add_advice(all, document);
        facts["verdict"] = facts_of(judged.verdict);
        verdict = "judged as a file for " + names_of(devices) + ": it ";
        verdict += judged.verdict.refused ? "is refused." : printable(utf8_of_latin1(fits(judged.verdict)));
    }
    add_check(all, document, reading, path.substr(path.rfind('/') + 1));
    gsd::Findings findings;
    for (const CodedFinding& one : all) findings.push_back(one.finding);
    facts["findings"] = facts_of(all);
    outcome.facts = text_of(facts);
    add_findings(outcome, path, findings);
    if (!is_of_a_master) outcome.lines.push_back(std::string{path} + ": " + verdict);
    return outcome;
}

std::optional<std::vector<const gsd::Module*>>
modules_asked(const gsd::Document& document, const std::vector<std::string>& names, std::string& why)
{
    if (names.empty()) return std::nullopt;
    return gsd::modules_named(document, names, why);
}

} // namespace dpslave::configurator
