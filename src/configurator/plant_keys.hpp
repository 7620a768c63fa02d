// SPDX-License-Identifier: Apache-2.0
/// Finds the keys that a station needs to accept the plant's own GSD file.
#pragma once

#include "dpslave/profile/gsd_judge.hpp"
#include "dpslave/profile/station_keys.hpp"

#include <optional>
#include <vector>

namespace dpslave::configurator {

struct PlantKeys {
    profile::StationKeys keys;    ///< without them: what the profile has
    profile::FileVerdict verdict; ///< with them
    std::vector<std::string> no_identifiers =
        {};                    ///< of the modules: why none of these can be a key; sentences
    bool is_ambiguous = false; ///< several places of the tags would do, and the file does not say which
};

/// None where the profile takes the file. Else the identifiers of its modules, another place of the tags, or
/// both, where that alone makes the station take it. If nothing does, the verdict is that of the profile.
PlantKeys plant_keys(const profile::Profile& profile, const gsd::Document& document,
                     const std::optional<std::vector<const gsd::Module*>>& modules = {});

} // namespace dpslave::configurator
