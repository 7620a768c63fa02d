// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"

#include "facts.hpp"
#include "plant_keys.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

std::optional<profile::Profile> load(const Files& files, const std::string& name, Outcome& outcome)
{
    if (name.empty() || name.find('/') != std::string::npos) {
        outcome.exit = name.empty() ? kUsage : kNo;
        outcome.refusals.push_back(name.empty()
                                       ? "no profile is named: name that of the device that the file is for."
                                       : "the profile is a name such as 590, without its folder.");
        return std::nullopt;
    }
    auto profile = profile::load_profile(files.source, files.profiles, name);
    if (profile) return *std::move(profile);
    outcome.exit = kNo;
    for (const input::Fault& fault : profile.error()) outcome.messages.push_back(to_string(fault));
    if (!files.names.empty() &&
        std::find(files.names.begin(), files.names.end(), name) == files.names.end()) {
        std::string there;
        for (const std::string& each : files.names) there += (there.empty() ? "" : ", ") + each;
        outcome.refusals.push_back("the profiles there: " + there);
    }
    return std::nullopt;
}

std::optional<drive::TagTable> taken(Result<drive::TagTable, input::Faults> tags, Outcome& outcome)
{
    if (tags) return *std::move(tags);
    outcome.exit = kNo;
    for (const input::Fault& fault : tags.error()) outcome.refusals.push_back(to_string(fault));
    return std::nullopt;
}

} // namespace

std::optional<profile::Profile> load(const Files& files, const std::string& name, const std::string& table,
                                     Outcome& outcome)
{
    auto profile = load(files, name, outcome);
    if (!profile || table.empty()) return profile;
    auto own = taken(profile::load_tags(files.source, table), outcome);
    if (!own) return std::nullopt;
    profile->tags = *std::move(own);
    return profile;
}

std::optional<profile::Profile> load(const Files& files, const profile::Mapping& mapping,
                                     const std::string& table, Outcome& outcome)
{
    auto profile = load(files, mapping.profile, table, outcome);
    if (!profile || !table.empty() || !mapping.table) return profile;
    auto own = taken(profile::read_tags(mapping.table->text, mapping.table->name), outcome);
    if (!own) return std::nullopt;
    profile->tags = *std::move(own);
    return profile;
}

gsd::MapHints hints_of(const Files& files, const std::string& profile, const std::string& table,
                       const gsd::Document& document, Outcome& outcome)
{
    if (!profile.empty()) {
        const auto device = load(files, profile, table, outcome);
        if (!device) return {};
        gsd::MapHints hints = hints_of(*device);
        if (const auto at = plant_keys(*device, document).keys.tags_at) hints.tags_at = at;
        return hints;
    }
    gsd::MapHints hints;
    if (table.empty()) return hints;
    if (const auto own = taken(profile::load_tags(files.source, table), outcome))
        for (const drive::Tag& tag : own->all()) hints.names.emplace(tag.number, tag.name);
    return hints;
}

} // namespace dpslave::configurator
