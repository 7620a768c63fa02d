// SPDX-License-Identifier: Apache-2.0
/// The parameters of a drive as far as they are known: a table by tag number, made from a CSV file, then
/// constant.
#pragma once

#include "dpslave/base/process_image.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::drive {

enum class TagType : std::uint8_t {
    number,  ///< INT or REAL of the table: signed 16 bit with `decimals`; unsigned where min >= 0 and max >
             ///< 32767. Tag::is_real distinguishes the two
    word,    ///< 16 bits, hexadecimal
    boolean, ///< 0 or 1
    enumeration, ///< 0..255
    string,      ///< not transported: unsupported_type
};
std::string_view
text(TagType type) noexcept; ///< as the table's column spells it: INT, WORD, BOOL, ENUM, STRING

enum class Access : std::uint8_t { unknown, read_only, read_write, write_only };

/// The condition under which the drive accepts a write (column: "when"). The drive itself only says that the
/// tag is read only or the value out of range (EI-ASCII reference, section 4; access errors 3 and 4 of
/// HA463561U002).
enum class WritableWhen : std::uint8_t {
    not_said,
    stopped,       ///< "stopped": the drive does not run
    configuration, ///< "configuration": it is in configuration mode
};

/// A name for one value (value=label) or for one bit (bitN=label).
struct Label {
    bool is_bit = false;
    std::uint16_t number = 0; ///< the value, or the number of the bit
    std::string text;
    friend bool operator==(const Label&, const Label&) = default;
};

/// One row of the table.
struct Tag {
    std::uint16_t number = 0;
    std::string name;
    TagType type = TagType::number;
    /// True for a floating value (REAL) of the instrument, which its IEEE area has as a single. Otherwise the
    /// number is a whole number or a time, which are no singles there (2000 series; EI-ASCII reference,
    /// section 5).
    bool is_real = false;
    std::uint8_t decimals = 0;    ///< 0..4, of a number
    bool decimals_known = true;   ///< false: a number, and the table does not say its decimals
    bool confirmed = true;        ///< false: a survey made the row, and it is not confirmed yet
    bool follows_display = false; ///< `decimals` are those of the instrument's display (column: "display")
    /// A floating value that the instrument sends as a scaled integer, and nothing says with how many
    /// decimals (mark_counts): it is shown in counts, never in its unit.
    bool in_counts = false;
    bool is_unsigned = false;
    std::optional<std::int32_t> min; ///< in counts: displayed value x 10^decimals
    std::optional<std::int32_t> max;
    Access access = Access::unknown;
    WritableWhen when = WritableWhen::not_said;
    /// A write counts: each word goes out once, whatever is heard of it.
    bool once = false;
    std::string mnemonic; ///< two characters; empty = by the profile's rule
    /// None = the tag's number. Registers from 8000h on are the IEEE area of the 2000 series: two registers,
    /// IEEE single.
    std::optional<std::uint16_t> modbus_register;
    std::vector<Label> labels;
    std::string section;
    std::string notes;
    std::vector<std::string> aliases; ///< further names of the same tag
    /// False: in no table. Over EI-ASCII its type is what the drive's answer shows.
    bool listed = true;
    std::size_t position = 0; ///< of its row in the table, from 0
    friend bool operator==(const Tag&, const Tag&) = default;
};

/// Returns the type of this row as spelled in the table's column: REAL differs from INT.
std::string_view type_name(const Tag& tag) noexcept;
/// "stopped", "configuration"; empty where nothing is said.
std::string_view text(WritableWhen when) noexcept;

/// The row of a tag that is in no table: a WORD without a name. If `decimals` is given, a number as an answer
/// over EI-ASCII has this scale (unlisted_decimals).
Tag unlisted_tag(std::uint16_t number);
Tag unlisted_tag(std::uint16_t number, std::uint8_t decimals);

/// Marks the rows whose decimals the table does not give, for a device that sends floating values as scaled
/// integers in its normal registers.
void mark_counts(std::vector<Tag>& tags);

/// Returns false if an answer of the drive that is a number has no scale by this row: it is in no table,
/// without decimals, or not confirmed. Do not ask it for a protocol that transports 16 bits (Modbus).
bool has_scale(const Tag& tag) noexcept;

/// Displayed form of the 16 bits: "-327.68", ">1A2B", "1 (Running)" where a label is known, ">0101 (ready,
/// running)" where labels of bits that are set are known, "412 counts" of a row in counts.
std::string displayed(const Tag& tag, std::uint16_t word);

/// The 16 bits of a displayed value, with the table's decimals, limits and labels.
/// Accepts "12.5", ">1A2B", "0x1A2B", a label of a value (any case). A WORD takes only the hexadecimal forms
/// and one single digit: "0203" could mean 203 or 0203h. A row in counts also takes "412 counts".
struct ParsedValue {
    std::uint16_t word = 0;
    AccessError error = AccessError::none; ///< out_of_range, value_not_encoded or unsupported_type
};
ParsedValue parse_value(const Tag& tag, std::string_view text);

/// Limits in counts, both included: displayed value x 10^decimals.
struct Limits {
    std::int32_t min = 0, max = 0;
    friend bool operator==(const Limits&, const Limits&) = default;
};
/// The limits that two displayed values of the row state. None: one of them is no value of the row, or min is
/// above max.
std::optional<Limits> limits_of(const Tag& tag, std::string_view min, std::string_view max);

/// Within the type and the limits of the row.
bool is_within_limits(const Tag& tag, std::uint16_t word);

/// Both rows ask the drive the same and make the same word of its answer: what differs is text only, or
/// a limit.
bool is_same_value(const Tag& a, const Tag& b);

class TagTable {
public:
    TagTable() = default;
    /// Rows in any order; numbers are unique (the reader has joined aliases).
    explicit TagTable(std::vector<Tag> tags);

    const Tag* find(std::uint16_t number) const;                 ///< nullptr = not in the table
    std::vector<const Tag*> search(std::string_view name) const; ///< part of a name or alias, any case
    const std::vector<Tag>& all() const { return tags_; }        ///< ascending by number
    /// Returns the rows in the order of the table, which is that of the manual's chapter (C-048); valid as
    /// long as this.
    std::vector<const Tag*> in_table_order() const;
    friend bool operator==(const TagTable&, const TagTable&) = default;

private:
    std::vector<Tag> tags_;
};

/// The rule by which a drive family makes the two-character mnemonic of a tag (EI-ASCII reference, section
/// 3).
enum class MnemonicRule : std::uint8_t {
    none,       ///< only the table's own mnemonics
    dc_590plus, ///< "590plus"
    ac,         ///< "ac"
    pno,        ///< "pno": the PNO in hexadecimal. Tags 1000..1127 are PNO 0..127, and so are tags 0..127
};
struct NamedRule {
    std::string_view name; ///< as a profile spells it
    MnemonicRule rule;
};
/// All of them.
inline constexpr std::array kMnemonicRules{
    NamedRule{"590plus", MnemonicRule::dc_590plus}, NamedRule{"ac", MnemonicRule::ac},
    NamedRule{"pno", MnemonicRule::pno}, NamedRule{"none", MnemonicRule::none}};
std::optional<MnemonicRule> mnemonic_rule_of(std::string_view name);

std::string_view text(MnemonicRule rule) noexcept; ///< as a profile spells it

/// Source: EI-ASCII reference, section 3. PNO: the 590+ parameters that PROFIBUS numbers 1000 + PNO
/// (HA463561U002). 590 and 590SP name parameters by their PNO too; that a tag below 128 is its PNO has no
/// source, and an answer of the drive is no proof of it. The mnemonic of `tag`: of the table if it has one,
/// else by the rule; nothing if neither gives one.
std::optional<std::array<char, 2>> mnemonic_of(const Tag& tag, MnemonicRule rule);
std::optional<std::array<char, 2>> mnemonic_by_rule(std::uint16_t number, MnemonicRule rule);

} // namespace dpslave::drive
