// SPDX-License-Identifier: Apache-2.0
/// Pieces of the replies that several requests have.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/gsd/check.hpp"
#include "dpslave/gsd/io_map.hpp"
#include "dpslave/profile/gsd_device.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace dpslave::configurator {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostOctets = std::size_t{1024} * 1024; ///< of a file, as dpctl reads at most

/// The text of `value`; octets that are no UTF-8 are replaced.
std::string text_of(const Json& value);

/// "FILE:12: warning: sentence", as compilers do.
std::string line_of(std::string_view path, const gsd::Finding& finding);
/// "1 error, 2 warnings".
std::string summary(const gsd::Findings& findings);

bool any_error(const gsd::Findings& findings);

Json findings_of(const gsd::Findings& findings);
/// `mapping`, and `table` with `table_name` where it has one.
void add_mapping(Json& facts, const profile::Mapping& mapping);
Json profile_of(const profile::Profile& profile);

Json tag_of(const profile::Profile& profile, const drive::Tag& tag);
Json facts_of(const gsd::IoMap& map);
/// What the page shows of a selection while it is being made.
Json preview_of(const profile::Profile& profile, const profile::Draft& draft, bool demand);

/// Chk_Cfg: the identifiers of the plugged modules.
std::vector<std::uint8_t> identifiers_of(const gsd::Document& document);
gsd::MapHints hints_of(const profile::Profile& profile);

std::string hex_of(std::uint32_t word); ///< "0x0533"
/// Each octet one character, whatever else it might be read as: what was read is written again.
std::string utf8_of_latin1(std::string_view octets);

} // namespace dpslave::configurator
