// SPDX-License-Identifier: Apache-2.0
/// A reader of GSD files, written a second time (wire reference, section 9). It shares nothing with the
/// daemon's and dpctl's, on purpose: an error there is not repeated here. All but load_gsd() is pure.
#pragma once

#include "telegram.hpp"

#include <cstddef>

namespace dpslave::sim {

/// One line KEY = VALUE.
struct GsdEntry {
    std::string key;            ///< as printed, without its number
    std::optional<unsigned> at; ///< the number in brackets after it
    std::string value;          ///< without comment, and without blanks outside of quotation marks
    unsigned line = 0;          ///< counted from 1
};

/// The lines of the device, or of one module, in the order of the file.
struct GsdEntries {
    std::vector<GsdEntry> all{};

    /// The last one counts, as in the masters' tools; any case. nullptr: not there.
    const GsdEntry* find(std::string_view key) const;
    /// A whole number from 0 to `most`, or `absent` where the key is not there; else "line 7: sentence".
    Result<std::uint32_t, std::string> number(std::string_view key, std::uint32_t most,
                                              std::uint32_t absent) const;
    bool is_on(std::string_view key) const;       ///< it is there and 1
    std::string text(std::string_view key) const; ///< UTF-8 without its quotes; empty: not there, or no text
};

/// The default octets that a block ExtUserPrmData puts into User_Prm_Data.
struct PrmBlock {
    std::int64_t reference = -1; ///< of the block; -1: it has none
    std::size_t octets = 0;      ///< 1, 2 or 4
    unsigned first_bit = 0;      ///< of Bit and BitArea, in the one octet
    std::uint32_t mask = 0;      ///< the bits of the value, before they are shifted to first_bit
    std::uint32_t value = 0;     ///< the default, masked
    std::string fault{};         ///< why it cannot be used: "line 7: sentence"; empty: it can
};

struct GsdModule {
    std::string name{};   ///< UTF-8
    Octets identifiers{}; ///< what it puts into Chk_Cfg
    GsdEntries entries{}; ///< of the block
    std::string fault{};  ///< why it cannot be plugged: "line 7: sentence"; empty: it can
};

struct GsdFile {
    GsdEntries entries{}; ///< of the device, and of blocks that no master needs for its telegrams
    std::vector<PrmBlock> parameters{};
    std::vector<GsdModule> modules{};
};

/// Any octets: 8-bit text or UTF-8, each end of line, with or without a byte order mark. Text before
/// #Profibus_DP or in another section is not read. It fails if there is no such section.
Result<GsdFile, std::string> parse_gsd(std::string_view text);

/// Reads the file first; says so if that is not possible.
Result<GsdFile, std::string> load_gsd(const std::string& path);

/// Reads "12", "012" (twelve too) or "0x0C", with a minus before it or not; returns nullopt if it is none, or
/// beyond 2^32.
std::optional<std::int64_t> gsd_number(std::string_view text);

/// Reads "0x00,12,0xFF"; returns nullopt if one of them is no octet.
std::optional<Octets> gsd_octets(std::string_view list);

} // namespace dpslave::sim
