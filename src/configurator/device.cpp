// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"

#include <algorithm>

namespace dpslave::configurator {

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
    for (const toml::Fault& fault : profile.error()) outcome.messages.push_back(to_string(fault));
    if (!files.names.empty() &&
        std::find(files.names.begin(), files.names.end(), name) == files.names.end()) {
        std::string there;
        for (const std::string& each : files.names) there += (there.empty() ? "" : ", ") + each;
        outcome.refusals.push_back("the profiles there: " + there);
    }
    return std::nullopt;
}

std::optional<drive::TagTable> own_table(const Files& files, const std::string& table, Outcome& outcome)
{
    auto tags = profile::load_tags(files.source, table);
    if (tags) return *std::move(tags);
    outcome.exit = kNo;
    for (const toml::Fault& fault : tags.error()) outcome.refusals.push_back(to_string(fault));
    return std::nullopt;
}

} // namespace dpslave::configurator
