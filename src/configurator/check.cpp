// SPDX-License-Identifier: Apache-2.0
#include "facts.hpp"

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

Outcome check(std::string_view file, std::string_view path, bool strict)
{
    const std::string_view name = path.substr(path.rfind('/') + 1);
    const gsd::Document document = gsd::parse(file);
    gsd::Findings findings =
        gsd::check(document, strict ? gsd::Reading::strict : gsd::Reading::tolerant, name);
    if (!document.has_section) // no GSD file at all: what is remarkable about its lines is beside the point
        std::erase_if(findings, [](const gsd::Finding& one) { return one.severity != gsd::Severity::error; });
    Outcome outcome;
    for (const gsd::Finding& finding : findings) outcome.lines.push_back(line_of(path, finding));
    outcome.lines.push_back(std::string{path} + ": " + summary(findings));
    outcome.exit = any_error(findings) ? kNo : kFine;
    outcome.facts = text_of({{"findings", findings_of(findings)}});
    return outcome;
}

} // namespace dpslave::configurator
