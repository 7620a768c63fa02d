// SPDX-License-Identifier: Apache-2.0
/// How wide text is on a terminal. Letters of East Asia have two columns, accents that stand on the letter
/// before have none. Source: Unicode 15, EastAsianWidth.txt (W and F) and the categories Mn, Me and Cf.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

/// Columns that printable() text takes. An octet that is no UTF-8 has one.
std::size_t columns_of(std::string_view text);

/// How many octets of `text` are its longest beginning of at most `columns` columns. An accent stays with its
/// letter.
std::size_t octets_within(std::string_view text, std::size_t columns);

/// `text` in at most so many columns: as it is, or its beginning and '~'.
std::string cut(std::string_view text, std::size_t columns);

/// `text` in exactly so many columns: cut, or filled with blanks.
std::string fitted(std::string_view text, std::size_t columns, bool to_the_right = false);

} // namespace dpslave::dpctl
