// SPDX-License-Identifier: Apache-2.0
/// The keys in which a station differs from its profile about Set_Prm and Chk_Cfg: the plant's GSD is the law
///
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/profile/profile.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::profile {

/// The keys `ident`, `tags_at` and `identifiers` of a station. Without them the profile applies.
struct StationKeys {
    std::optional<std::uint16_t> ident = {};
    std::optional<std::size_t> tags_at = {};      ///< octet of User_Prm_Data where the tags begin, from 0
    std::vector<dp::Identifier> identifiers = {}; ///< in place of the profile's; empty: the profile's
    friend bool operator==(const StationKeys&, const StationKeys&) = default;
};

/// One identifier of whole words (wire reference 4.5). The failure is a sentence: octets are counted in place
/// of words, the lengths of the two directions differ, there are manufacturer's octets, or there is more or
/// less than one.
Result<dp::Identifier, std::string> identifier_of(Bytes octets);
/// Reads an identifier from a text: "52", "C0 40 40".
Result<dp::Identifier, std::string> read_identifier(std::string_view text);
std::string to_string(const dp::Identifier& identifier); ///< "C0 40 40"

/// Reads octets in hexadecimal with blanks between: "50 60"; returns nullopt if the text is invalid or empty.
std::optional<std::vector<std::uint8_t>> read_hex_octets(std::string_view text);
std::string hex_octets(Bytes octets); ///< "50 60"

/// Why the profile cannot have these keys, in sentences by key; none: it can.
struct WrongKey {
    std::string_view key; ///< "tags_at", "identifiers"
    std::string sentence;
};
std::vector<WrongKey> wrong_keys(const Profile& profile, const StationKeys& keys);

/// The profile's personality with the keys. The permitted lengths of User_Prm_Data move with the tags.
/// Precondition: no wrong_keys().
dp::Personality personality_of(const Profile& profile, const StationKeys& keys);

} // namespace dpslave::profile
