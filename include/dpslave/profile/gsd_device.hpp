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
#include <string_view>
#include <vector>

namespace dpslave::profile {

enum class Direction : std::uint8_t { in, out, in_out }; ///< as the master sees it

/// One word of the telegrams, or one of each direction.
struct Parameter {
    Direction direction = Direction::in;
    std::uint16_t tag = 0;
    friend bool operator==(const Parameter&, const Parameter&) = default;
};
std::string_view text(Direction direction) noexcept; ///< "in", "out", "in-out"
std::string to_string(const Parameter& parameter);   ///< "in-out:9"
/// Nothing: the text is no such word.
std::optional<Parameter> parse_parameter(std::string_view text);

/// What a site chooses. The parameters stand in the file in this order: inputs, outputs, both, then `list`;
/// in each as it is given, nothing is sorted.
struct Selection {
    std::vector<std::uint16_t> in = {}, out = {}, in_out = {}; ///< tags
    /// Directions in any order. Nothing: not said, so that the profile's own mapping stands where nothing is
    /// said of in, out and in_out either. Empty: no parameter, for Demand Data alone.
    std::optional<std::vector<Parameter>> list = {};
    bool demand = false;                     ///< Demand Data in front of them
    std::optional<std::uint16_t> ident = {}; ///< needed where the profile has none
    /// The machine's own MaxTsdr, T_bit ([bus] max_tsdr of the daemon): for each rate where it is larger than
    /// the profile's.
    std::optional<std::uint32_t> max_tsdr = {};
    std::optional<std::string> description = {}, model = {};

    std::vector<Parameter> parameters() const; ///< all, in the order of the file
    bool says_parameters() const;              ///< which ones, or that there are none
    friend bool operator==(const Selection&, const Selection&) = default;
};

struct GsdDevice {
    gsd::Device device;
    std::vector<std::string> warnings; ///< sentences
};

/// What is wrong with a selection, or remarkable.
struct Note {
    bool refuses = false;          ///< no file can be made
    std::string_view code;         ///< stays the same where the sentence changes
    std::string text;              ///< a sentence that says what to change
    std::optional<std::size_t> at; ///< the parameter it is about: its place in parameters()
};

/// A device while its selection is being made: also what would be refused, as far as it goes.
struct Draft {
    gsd::Device device;
    std::vector<Parameter> parameters; ///< those of the selection, or the profile's own
    std::vector<Note> notes;
};
Draft draft_of(const Profile& profile, const Selection& selection);

/// Without tags and Demand Data: the profile's own mapping; where it has none, the file whose modules the
/// master's tool puts together, with User_Prm_Data of zeros for the tags. Nothing: sentences that say what to
/// change.
Result<GsdDevice, std::vector<std::string>> device_of(const Profile& profile, const Selection& selection);

/// A tag table of the user's own, as it was loaded.
struct OwnTable {
    std::string name; ///< of its file, without a folder
    std::string text; ///< CSV
    friend bool operator==(const OwnTable&, const OwnTable&) = default;
};

/// A selection that is kept as a file (C-045, C-046), TOML: profile, list or in, out and in_out, demand,
/// ident, max_tsdr, description, model, [table]; only `profile` is required.
struct Mapping {
    std::string profile;
    Selection selection = {};
    std::optional<OwnTable> table = {}; ///< one that read_tags() reads, in place of the profile's
    friend bool operator==(const Mapping&, const Mapping&) = default;
};
Result<Mapping, toml::Faults> load_mapping(const toml::TextSource& source, const std::string& file);

} // namespace dpslave::profile
