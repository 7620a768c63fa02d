// SPDX-License-Identifier: Apache-2.0
/// Decides what the sighting of a tag says of its row.
#pragma once

#include "dpslave/drive/tag.hpp"
#include "dpslave/profile/survey.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::profile {

/// Cells of a row by the name of their column.
using Cells = std::map<std::string, std::string>;

/// The columns that a survey writes; the others are written by hand.
inline constexpr std::array<std::string_view, 7> kSurveyColumns = {"type",     "decimals", "min",     "max",
                                                                   "mnemonic", "seen_min", "seen_max"};

/// Returns why no row can be made of these answers; nullopt if one can, or nothing answered.
std::optional<std::string> no_row_for(const Sighting& one);

/// A row made of these answers, without its tag. Precondition: there were answers, and no_row_for() has
/// nothing against them.
Cells new_row(const Sighting& one);

/// Widens the cells of a row that waits for confirmation: type where the answers rule it out, more decimals,
/// further extremes. Precondition: as new_row().
void widen_row(Cells& cells, const Sighting& one);

/// Returns how the answers contradict a confirmed row. `has_decimals`: the row says how many.
std::vector<std::string> against(const drive::Tag& row, bool has_decimals, const Sighting& one);

} // namespace dpslave::profile
