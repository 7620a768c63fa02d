// SPDX-License-Identifier: Apache-2.0
/// The profiles and files of this tree, and findings as text.
#pragma once

#include "profile/files.hpp"
#include "reader.hpp"
#include "support/paths.hpp"

#include "dpslave/gsd/check.hpp"
#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/profile/profile.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::test {

inline const std::filesystem::path kSource{source_path()};

/// Every profile that is shipped, and those whose ident is open.
inline const std::vector<std::string> kProfiles{"584s", "590",     "620",   "584sv", "590plus",
                                                "605",  "690plus", "2408f", "2404f"};

/// An ident that no profile has, for those that have none.
inline constexpr std::uint16_t kOwnIdent = 0x7EA5;

profile::Profile load(const std::string& name);

/// The file for `selection`, with kOwnIdent where the profile leaves it open. A refusal is a failure of the
/// test.
std::string made(const profile::Profile& profile, profile::Selection selection);

/// "12: error: sentence" for each finding.
std::vector<std::string> findings_of(const gsd::Findings& findings);
/// The same for a file's content.
std::vector<std::string> findings_of(const std::string& content,
                                     gsd::Reading reading = gsd::Reading::tolerant,
                                     const std::string& file_name = {});

/// `count` tags from `first` on.
std::vector<std::uint16_t> tags(std::uint16_t first, std::size_t count);

} // namespace dpslave::test
