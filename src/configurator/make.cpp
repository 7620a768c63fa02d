// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/io_map.hpp"

namespace dpslave::configurator {

Outcome make(const Files& files, const profile::Mapping& mapping, const std::string& table,
             const std::string& path)
{
    Outcome outcome;
    auto profile = load(files, mapping.profile, outcome);
    if (!profile) return outcome;
    if (!table.empty()) {
        auto own = own_table(files, table, outcome);
        if (!own) return outcome;
        profile->tags = *std::move(own);
    }
    const auto made = profile::device_of(*profile, mapping.selection);
    if (!made) {
        outcome.exit = kNo;
        outcome.refusals = made.error();
        return outcome;
    }
    outcome.octets = gsd::write(made->device);
    const gsd::Document document = gsd::parse(outcome.octets);
    for (const std::string& warning : made->warnings)
        outcome.messages.push_back("warning: " + printable(warning));
    for (const std::string& advice : gsd::io_map(document, {}).advice)
        outcome.messages.push_back("warning: " + printable(advice));
    if (path.empty()) return outcome;
    const std::string name = path.substr(path.rfind('/') + 1);
    for (const gsd::Finding& finding : gsd::check(document, gsd::Reading::tolerant, name))
        outcome.messages.push_back(line_of(path, finding));
    return outcome;
}

} // namespace dpslave::configurator
