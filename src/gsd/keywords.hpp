// SPDX-License-Identifier: Apache-2.0
/// The keywords of a GSD: where each may stand and what its value is. Source: wire reference 9.2.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::gsd {

enum class Kind : std::uint8_t { boolean, number, text, octets, family, other };

/// Where a keyword may stand: bits.
enum Section : std::uint8_t { kUnit = 1, kModule = 2 };

struct Keyword {
    std::string_view name;
    Kind kind;
    std::uint32_t min, max; ///< of a number; of a text `max` is its longest
    std::uint8_t revision;  ///< GSD_Revision that brought it
    std::uint8_t places;    ///< of Section
    bool indexed;           ///< Unit_Diag_Bit(3)
    bool dpv1;              ///< has a meaning with DPV1_Slave = 1 only
};

/// Any case. nullptr: none of the standard.
const Keyword* find_keyword(std::string_view name);

/// A block: `opens` with a value or alone, until `closes`.
struct BlockKind {
    std::string_view opens, closes;
};
const BlockKind* find_opening(std::string_view word);
const BlockKind* find_closing(std::string_view word);

/// The keyword of the standard that was probably meant: at most two letters apart. Empty: none.
std::string_view nearest_keyword(std::string_view name);

/// As in "9.6_supp" and "MaxTsdr_9.6": every rate of the standard.
inline constexpr std::array<std::string_view, 11> kRates{"9.6", "19.2", "31.25", "45.45", "93.75", "187.5",
                                                         "500", "1.5M", "3M",    "6M",    "12M"};

} // namespace dpslave::gsd
