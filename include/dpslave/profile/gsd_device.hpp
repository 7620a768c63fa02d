// SPDX-License-Identifier: Apache-2.0
/// Makes a GSD from a profile: what the daemon accepts is what the file makes the master send.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/gsd/device.hpp"
#include "dpslave/input/fault.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/profile/station_keys.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::profile {

enum class Direction : std::uint8_t { in, out, in_out }; ///< as the master sees it

/// One word of the telegrams, or one of each direction.
struct GsdParameter {
    Direction direction = Direction::in;
    std::uint16_t tag = 0;
    friend bool operator==(const GsdParameter&, const GsdParameter&) = default;
};
std::string_view text(Direction direction) noexcept;  ///< "in", "out", "in-out"
std::string to_string(const GsdParameter& parameter); ///< "in-out:9"
/// Returns nullopt if the text is no such word.
std::optional<GsdParameter> parse_parameter(std::string_view text);
/// The words that a slave has taken.
std::vector<GsdParameter> parameters_of(const dp::Configuration& taken);

/// A module of the plant's own GSD.
struct PlantModule {
    std::string name;                           ///< UTF-8
    std::vector<std::uint8_t> identifiers = {}; ///< what it puts into Chk_Cfg
    bool preset = false;                        ///< plugged from the start; one alone makes a compact station
    friend bool operator==(const PlantModule&, const PlantModule&) = default;
};

/// Lengths of the plant's own GSD, where it says others than the profile would: octets, Max_Module modules.
struct PlantLengths {
    std::optional<std::uint32_t> user_prm_data = {}, max_module = {}, max_input = {}, max_output = {},
                                 max_data = {};
    friend bool operator==(const PlantLengths&, const PlantLengths&) = default;
};

/// The choices of a site. The parameters are in the file in this order: inputs, outputs, both, then `list`;
/// in each as it is given, nothing is sorted.
struct Selection {
    std::vector<std::uint16_t> in = {}, out = {}, in_out = {}; ///< tags
    /// Directions in any order. nullopt means that it is not given, so that the profile's own mapping applies
    /// if in, out and in_out are not given either. It is empty if there is no parameter, for Demand Data
    /// alone.
    std::optional<std::vector<GsdParameter>> list = {};
    /// Tags in the order of User_Prm_Data whose directions the modules of the master's project say. They
    /// replace all others, and the master's tool puts the modules together.
    std::optional<std::vector<std::uint16_t>> tags = {};
    bool demand = false;                     ///< Demand Data in front of them
    std::optional<std::uint16_t> ident = {}; ///< needed where the profile has none
    /// The machine's own MaxTsdr, T_bit ([bus] max_tsdr of the daemon): for each rate where it is larger than
    /// the profile's.
    std::optional<std::uint32_t> max_tsdr = {};
    std::optional<std::string> description = {}, model = {};
    // The plant's own GSD: the keys that its station needs, and what the profile would make otherwise.
    std::optional<std::size_t> tags_at = {};
    std::vector<dp::Identifier> identifiers = {};
    std::vector<PlantModule> modules = {}; ///< in place of the profile's
    PlantLengths lengths = {};

    StationKeys keys() const;                     ///< of a station with this file
    std::vector<GsdParameter> parameters() const; ///< all, in the order of the file
    bool says_parameters() const;                 ///< which ones, or that there are none
    friend bool operator==(const Selection&, const Selection&) = default;
};

struct GsdDevice {
    gsd::Device device;
    std::vector<std::string> warnings; ///< sentences
};

/// A fault of a selection, or something remarkable.
struct Note {
    bool refuses = false;          ///< no file can be made
    std::string_view code;         ///< stays the same where the sentence changes
    std::string text;              ///< a sentence that says what to change
    std::optional<std::size_t> at; ///< the parameter it is about: its place in parameters()
    std::string_view field;        ///< the key of a mapping that mends it; empty: the list of parameters
};

/// A device while its selection is being made: also what would be refused, as far as it goes.
struct Draft {
    gsd::Device device;
    std::vector<GsdParameter> parameters; ///< those of the selection, or the profile's own
    std::size_t tags_at = 0;              ///< octet of User_Prm_Data
    /// The place of each parameter's identifier in Chk_Cfg: first octet and number of octets. It is empty if
    /// the modules are a choice.
    std::vector<std::pair<std::size_t, std::size_t>> cfg_places;
    std::vector<Note> notes;
};
Draft draft_of(const Profile& profile, const Selection& selection);

/// Makes the device of a selection. Without tags and Demand Data it has the profile's own mapping; if there
/// is none, the file whose modules the master's tool puts together, with User_Prm_Data of zeros for the tags.
/// The error has sentences that say what to change.
Result<GsdDevice, std::vector<std::string>> device_of(const Profile& profile, const Selection& selection);

/// A tag table of the user's own, as it was loaded.
struct OwnTable {
    std::string name; ///< of its file, without a folder
    std::string text; ///< CSV
    friend bool operator==(const OwnTable&, const OwnTable&) = default;
};

/// A selection that is kept as a file (C-045, C-046), TOML: profile, list or in, out and in_out or tags,
/// demand, ident, max_tsdr, description, model, tags_at, identifiers, the lengths, [[module]], [table]; only
/// `profile` is required.
struct Mapping {
    std::string profile;
    Selection selection = {};
    std::optional<OwnTable> table = {}; ///< one that read_tags() reads, in place of the profile's
    friend bool operator==(const Mapping&, const Mapping&) = default;
};
Result<Mapping, input::Faults> load_mapping(const input::TextSource& source, const std::string& file);

} // namespace dpslave::profile
