// SPDX-License-Identifier: Apache-2.0
/// A tag table. Judged: faults lie in the text and are printable; the rows of a table that is accepted are
/// distinct and keep their limits; what is displayed of a value is read as this value; a survey that saw
/// nothing changes no row.
#include "faults.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/text_source.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/profile/survey.hpp"

#include <array>
#include <set>

namespace {

using namespace dpslave;
using drive::Tag;
using drive::TagType;
using fuzz::demand;

void judge_row(const Tag& tag)
{
    demand(tag.decimals <= 4, "a row has at most four decimals");
    demand(tag.mnemonic.empty() || tag.mnemonic.size() == 2, "a mnemonic has two characters");
    demand(!tag.min || !tag.max || *tag.min <= *tag.max, "the least value is not above the greatest");
    if (tag.type == TagType::string || !tag.labels.empty() || !tag.decimals_known) return;
    constexpr std::array<std::uint16_t, 7> words{0, 1, 0x7FFF, 0x8000, 0xFFFF, 0x00FF, 0x1B0B};
    for (const std::uint16_t word : words) {
        const drive::ParsedValue read = drive::parse_value(tag, drive::displayed(tag, word));
        if (drive::is_within_limits(tag, word))
            demand(read.error == AccessError::none && read.word == word,
                   "what is displayed of a value is read as this value");
        else
            demand(read.error != AccessError::none || read.word == word, "no other value is read");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzz::text_of(data, size);
    const auto table = profile::read_tags(text, "a.csv");
    const auto merged = profile::merge_survey(text, "a.csv", {});
    if (!table) {
        demand(!table.error().empty(), "a table that is refused has a fault");
        fuzz::judge_faults(text, table.error());
        demand(text.empty() || text == input::kByteOrderMark || !merged, "a survey refuses what is no table");
        return 0;
    }
    // Rows that are not changed keep their octets: what is no UTF-8 is judged once more as it is.
    demand(merged || utf8(text) != text, "a survey takes every table in UTF-8");
    if (!merged) return 0;
    const auto after = profile::read_tags(merged->text, "a.csv");
    demand(after && *after == *table, "a survey that saw nothing changes no row");
    std::set<std::uint16_t> numbers;
    for (const Tag& tag : table->all()) {
        demand(numbers.insert(tag.number).second, "a number stands once");
        demand(table->find(tag.number) == &tag, "a row is found by its number");
        judge_row(tag);
    }
    demand(table->in_table_order().size() == table->all().size(), "the order of the table has each row");
    return 0;
}
