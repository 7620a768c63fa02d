// SPDX-License-Identifier: Apache-2.0
/// A GSD file taken apart: keywords, blocks and modules with their lines. Reading never fails; what is odd
/// becomes a remark. Source: wire reference 9.1.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::gsd {

/// The severity of a remark.
enum class Weight : std::uint8_t {
    error,    ///< tools refuse the file, misread it, or the slave will not start with it
    warning,  ///< tools read the file, but it does not say what the standard demands
    pedantic, ///< every tool takes it; reported on request only
};

struct Remark {
    unsigned line = 0; ///< from 1; 0 = the file as a whole
    Weight weight = Weight::error;
    std::string what;    ///< a sentence that says what is wrong and what to do
    bool unread = false; ///< a slip: what the line was to say is not read
};
using Remarks = std::vector<Remark>;

/// One logical line: `Keyword(index) = value`, or a line without "=" (keyword empty, all in `value`).
/// Comments are gone, continued lines are joined, and `line` is the first of them.
struct Entry {
    std::string keyword;
    std::optional<std::uint32_t> index;
    std::string value;
    unsigned line = 0;
};

/// A block such as `Module = ... EndModule`. `head` is the text after the "=" of its first line.
struct Block {
    std::string kind; ///< as the standard spells it: "Module", "PrmText", "ExtUserPrmData", ...
    std::string head;
    unsigned line = 0;
    std::vector<Entry> body;
};

struct Module {
    std::string name;
    std::vector<std::uint8_t> identifiers; ///< what it puts into Chk_Cfg
    std::optional<std::uint32_t> reference;
    bool preset = false; ///< Preset = 1: plugged from the start
    unsigned line = 0;
};

struct Document {
    bool has_section = false;    ///< there is a line #Profibus_DP; without it nothing was read
    Remark not_read{};           ///< without it: why, which is also among the remarks
    std::vector<Entry> keywords; ///< of the device, in the order of the file
    std::vector<Block> blocks;   ///< modules included
    std::vector<Module> modules; ///< the blocks of this kind once more, taken apart
    Remarks remarks;             ///< on the form of the file alone; check() adds the rest

    /// The last one counts, as in the masters' tools; any case. nullptr: not there.
    const Entry* find(std::string_view keyword) const;
    std::optional<std::uint32_t> number(std::string_view keyword) const; ///< nullopt: not there or no number
    std::string text(std::string_view keyword) const; ///< without its quotes; empty: not there or no text
    std::vector<std::uint8_t> octets(std::string_view keyword) const; ///< empty: not there or no octets
};

/// Any octets: 8-bit text with CR LF or LF.
Document parse(std::string_view content);

} // namespace dpslave::gsd
