// SPDX-License-Identifier: Apache-2.0
/// The keywords of a GSD: where each is allowed and what its value is. Source: wire reference 9.2.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::gsd {

enum class Kind : std::uint8_t { boolean, number, text, octets, family, other };

/// These bits say where a keyword is allowed.
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

/// Data_Area_Beg to Data_Area_End in a module: keywords for data exchange between slaves, which are not
/// judged (wire reference 9.2).
class DataArea {
public:
    /// Takes the next line of the module and returns whether it belongs to an area, whose first and last line
    /// count.
    bool has(std::string_view keyword, std::string_view value);
    bool is_open() const { return open_; }

private:
    bool open_ = false;
};

/// The word of the standard that was probably meant, a keyword or the begin or end of a block: at most two
/// letters apart. It is empty if there is none.
std::string_view nearest_keyword(std::string_view name);

/// These are all rates of the standard, as spelled in "9.6_supp" and "MaxTsdr_9.6".
inline constexpr std::array<std::string_view, 11> kRates{"9.6", "19.2", "31.25", "45.45", "93.75", "187.5",
                                                         "500", "1.5M", "3M",    "6M",    "12M"};

} // namespace dpslave::gsd
