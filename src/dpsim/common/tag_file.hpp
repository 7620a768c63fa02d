// SPDX-License-Identifier: Apache-2.0
/// A tag table from a CSV file, read without the daemon's reader (columns as dpslaved.toml describes them).
#pragma once

#include "dpslave/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::sim {

/// INT/REAL, WORD, BOOL, ENUM, STRING.
enum class TagKind : std::uint8_t { number, word, boolean, enumeration, string };
enum class TagAccess : std::uint8_t { read_write, read_only, write_only }; ///< an empty column counts as rw

/// No instrument shows more (tag 525 of a 2400).
inline constexpr unsigned kDisplayDecimals = 2;

/// The value of a parameter: counts = displayed value x 10^decimals, or the text of a STRING.
struct SimValue {
    std::int32_t counts = 0;
    std::string text{};
};

struct SimLabel { ///< of a value; labels of bits are checked and not kept
    std::uint16_t number = 0;
    std::string text{};
};

struct SimTag {
    std::uint16_t number = 0;
    std::string name{};
    TagKind type = TagKind::number;
    bool has_type = false; ///< the column is not empty
    bool is_real = false;  ///< REAL, or its decimals are those of the display: scaled
    /// Milliseconds that one count of a time is (the notes say "time type"); 0 = it is none.
    std::int32_t ms_per_count = 0;
    unsigned decimals = 0; ///< 0..4
    /// The column says "display": as many as the instrument shows. There are kDisplayDecimals until it says
    /// how many.
    bool follows_display = false;
    std::int32_t min = 0; ///< counts; what the type allows where the table says nothing
    std::int32_t max = 0;
    TagAccess access = TagAccess::read_write;
    std::string mnemonic{}; ///< two characters; empty = by the rule of the family
    std::vector<SimLabel> labels{};
    bool has_start = false; ///< the table says where it starts
    SimValue start{};       ///< column `start` (only dpsim knows it), else the nearest to 0 within the limits
};

/// Counts with another number of decimals; rounded to the nearest, ties away from zero.
std::int32_t rescaled(std::int32_t counts, unsigned from, unsigned to);

/// Displayed form: "12.50", "-0.05", ">1B0B", "2 (Jog)".
std::string displayed(const SimTag& tag, const SimValue& value);

/// Reads a displayed form back into a value; a label, ">1B0B" and "0x1B0B" are accepted too. It returns
/// nullopt if the text is none of these or beyond the limits.
std::optional<SimValue> value_of_text(const SimTag& tag, std::string_view text);

/// The complete table, or "FILE:LINE: sentence". `file` only names it.
Result<std::vector<SimTag>, std::string> parse_tags(std::string_view text, std::string_view file);

/// Reads the file first; says so if that is not possible.
Result<std::vector<SimTag>, std::string> load_tags(const std::string& path);

} // namespace dpslave::sim
