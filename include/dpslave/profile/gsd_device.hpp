// SPDX-License-Identifier: Apache-2.0
/// From a profile to its GSD: what the daemon accepts is what the file makes the master send.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/gsd/device.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/toml/fault.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::profile {

/// What a site chooses. The parameters stand in the file in this order: inputs, outputs, both; in each list
/// as it is given, nothing is sorted.
struct Selection {
    std::vector<std::uint16_t> in = {}, out = {}, in_out = {}; ///< tags
    bool demand = false;                                       ///< Demand Data in front of them
    std::optional<std::uint16_t> ident = {};                   ///< needed where the profile has none
    /// The machine's own MaxTsdr, T_bit ([bus] max_tsdr of the daemon): for each rate where it is larger than
    /// the profile's.
    std::optional<std::uint32_t> max_tsdr = {};
    std::optional<std::string> description = {}, model = {};
};

struct GsdDevice {
    gsd::Device device;
    std::vector<std::string> warnings; ///< sentences
};

/// Without tags and Demand Data: the profile's own mapping; where it has none, the file whose modules the
/// master's tool puts together, with User_Prm_Data of zeros for the tags. Nothing: sentences that say what to
/// change.
Result<GsdDevice, std::vector<std::string>> device_of(const Profile& profile, const Selection& selection);

/// A selection that is kept as a file (C-045, C-046), TOML: profile, in, out, in_out, demand, ident,
/// max_tsdr, description, model; only `profile` is required.
struct Mapping {
    std::string profile;
    Selection selection;
};
Result<Mapping, toml::Faults> load_mapping(const toml::TextSource& source, const std::string& file);

} // namespace dpslave::profile
