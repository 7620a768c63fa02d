// SPDX-License-Identifier: Apache-2.0
/// One row of a tag table on its way to a drive::Tag.
#pragma once

#include "csv.hpp"

#include "dpslave/drive/tag.hpp"
#include "dpslave/input/document.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::profile {

enum Column : std::size_t {
    kTag,
    kName,
    kType,
    kDecimals,
    kMin,
    kMax,
    kAccess,
    kWhen,
    kMnemonic,
    kRegister,
    kValues,
    kSection,
    kNotes,
    kConfirmed,
    kOnce,
    kColumns,
};
constexpr std::array<std::string_view, kColumns> kColumnNames{
    "tag",      "name",     "type",   "decimals", "min",   "max",       "access", "when",
    "mnemonic", "register", "values", "section",  "notes", "confirmed", "once"};

/// The column that `name` nearly is: other letters large or small, other signs between them, a letter wrong
/// ("Decimals", "min.", "decimal"). It is empty if it is one, or none is near.
std::string_view nearly_a_column(std::string_view name);

/// Says which cell of a row belongs to which column.
struct Columns {
    static constexpr std::size_t kAbsent = static_cast<std::size_t>(-1);
    std::array<std::size_t, kColumns> index = absent();
    std::size_t width = 0; ///< cells of every row

    /// Empty where the table has no such column.
    std::string_view text(const Row& row, Column column) const;
    input::Place place(const Row& row, Column column) const;

private:
    static constexpr std::array<std::size_t, kColumns> absent()
    {
        std::array<std::size_t, kColumns> all{};
        all.fill(kAbsent);
        return all;
    }
};

/// The row as a tag; nothing, and the reasons in `faults`, if a cell is wrong.
std::optional<drive::Tag> read_tag(const Row& row, const Columns& columns, const std::string& file,
                                   input::Faults& faults);

/// The row says nothing but a name of its tag.
bool is_name_only(const Row& row, const Columns& columns);

/// The first column in which `row`, read as `tag`, says something else than `known`; an empty cell
/// contradicts nothing.
std::optional<Column> contradiction(const drive::Tag& known, const drive::Tag& tag, const Row& row,
                                    const Columns& columns);

} // namespace dpslave::profile
