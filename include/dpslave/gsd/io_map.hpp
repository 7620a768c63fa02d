// SPDX-License-Identifier: Apache-2.0
/// Tells where each value of a GSD file's mapping is in the telegrams (C-044).
#pragma once

#include "dpslave/gsd/document.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::gsd {

/// One value of one direction.
struct IoValue {
    std::size_t octet = 0; ///< offset in the telegram's data, from 0
    std::size_t octets = 2;
    std::string what; ///< the tag's name, the place in Demand Data, or the module's name
    std::optional<std::uint16_t> tag;
    bool is_demand = false; ///< a register of Demand Data
};

/// A length that some masters cannot take.
struct Advice {
    std::string_view code; ///< "over_32_octets", "over_32_words", "over_117_words"
    std::string text;      ///< a sentence
};

struct IoMap {
    bool fixed = false; ///< false: the master's tool puts modules together, so there is no map yet
    std::vector<IoValue> inputs, outputs; ///< directions as the master sees them
    std::size_t in_octets = 0, out_octets = 0;
    std::vector<Advice> advice;
};

/// The file itself does not say this.
struct MapHints {
    /// The modules in their order; nullopt means those that are plugged without an order of the user.
    std::optional<std::vector<const Module*>> modules = {};
    /// The offset of the first tag in User_Prm_Data. nullopt means 3 where its length is odd (three octets of
    /// DP-V1, then tags), else 0; and no tags at all where the octets do not look like those of this file's
    /// parameters.
    std::optional<std::size_t> tags_at = {};
    std::uint8_t demand_identifier = 0x73; ///< Demand Data, in first position
    bool extended_tags = true; ///< register 2 of Demand Data takes a tag (2408f/2404f); drives have none
    std::map<std::uint16_t, std::string> names = {}; ///< of tags
};

IoMap io_map(const Document& document, const MapHints& hints);

/// Some masters take 32 octets a direction, others 32 words; the configurator's limit is 117 words
/// both ways together.
std::vector<Advice> advice_on_lengths(std::size_t in_octets, std::size_t out_octets);

} // namespace dpslave::gsd
