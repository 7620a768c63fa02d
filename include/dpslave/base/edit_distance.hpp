// SPDX-License-Identifier: Apache-2.0
/// Counts how much two words differ, for a message that names what was probably meant.
#pragma once

#include <cstddef>
#include <string_view>

namespace dpslave {

/// The octets to add, remove or change that make `b` of `a` (Levenshtein), or most + 1 if these are more than
/// `most`. It takes a.size() times b.size() steps at the most.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t most);

} // namespace dpslave
