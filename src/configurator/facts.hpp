// SPDX-License-Identifier: Apache-2.0
/// Pieces of the replies that several requests have.
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/configurator/configurator.hpp"
#include "dpslave/gsd/check.hpp"
#include "dpslave/gsd/io_map.hpp"
#include "dpslave/profile/gsd_device.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace dpslave::configurator {

using Json = nlohmann::ordered_json;
struct Outcome;

constexpr std::size_t kMostOctets = std::size_t{1024} * 1024; ///< of a file, as dpctl reads at most

/// The text of `value`; octets that are no UTF-8 are replaced.
std::string text_of(const Json& value);

/// "FILE:12: warning: sentence", as compilers do.
std::string line_of(std::string_view path, const gsd::Finding& finding);
/// "1 error, 2 warnings".
std::string summary(const gsd::Findings& findings);

bool any_error(const gsd::Findings& findings);
/// Returns what is remarkable about the form of a file. `path` as in check().
gsd::Findings form_of(const gsd::Document& document, std::string_view path, bool strict);
/// Their lines and their summary; kNo where one is an error.
void add_findings(Outcome& outcome, std::string_view path, const gsd::Findings& findings);
/// Returns nullopt if no modules are given, or if a name is wrong; `why` then says which.
std::optional<std::vector<const gsd::Module*>>
modules_asked(const gsd::Document& document, const std::vector<std::string>& names, std::string& why);

Json findings_of(const gsd::Findings& findings);
/// Adds the sentences of the check on the lines of an opened file that are not understood: what follows goes
/// on without them. `whose`: "the first file: ", or empty.
void say_unread(const gsd::Document& document, std::string_view whose, Outcome& outcome);
/// Why nothing was read of a file, with the line.
std::string not_read(const gsd::Document& document);
/// `mapping`, and `table` with `table_name` where it has one.
void add_mapping(Json& facts, const profile::Mapping& mapping);
Json profile_of(const profile::Profile& profile);

Json tag_of(const profile::Profile& profile, const drive::Tag& tag);
Json facts_of(const gsd::IoMap& map);
/// Returns what the page shows of a selection while it is being made. `name`: of the file, without folders;
/// empty: not judged.
Json preview_of(const profile::Profile& profile, const profile::Draft& draft, bool demand,
                std::string_view name);

gsd::MapHints hints_of(const profile::Profile& profile);

std::string hex_of(std::uint32_t word); ///< "0x0533"
/// Each octet one character, whatever else it might be read as: what was read is written again.
std::string utf8_of_latin1(std::string_view octets);

} // namespace dpslave::configurator
