// SPDX-License-Identifier: Apache-2.0
// The new style of user parameters: definitions, references to them, and where they lie.
#include "check_parts.hpp"
#include "text.hpp"

#include <map>
#include <set>

namespace dpslave::gsd {
namespace {

/// `Unsigned16 100 0-1000`: type, default and legal values of one ExtUserPrmData.
struct Definition {
    unsigned line = 0;
    std::size_t octets = 0;   ///< 0: the type was not understood
    std::uint8_t bits = 0xFF; ///< that it takes of its octet, where it takes one
};

struct Type {
    std::string_view name;
    std::size_t octets;
    std::int64_t min, max;
};
constexpr Type kTypes[] = {
    {"Unsigned8", 1, 0, 0xFF}, {"Unsigned16", 2, 0, 0xFFFF},   {"Unsigned32", 4, 0, 0xFFFFFFFF},
    {"Signed8", 1, -128, 127}, {"Signed16", 2, -32768, 32767}, {"Signed32", 4, -2147483648LL, 2147483647},
};

class ParameterCheck {
public:
    explicit ParameterCheck(Judge& judge) : judge_(judge) {}

    void run()
    {
        for (const Block& block : judge_.document.blocks) {
            if (block.kind == "ExtUserPrmData") definition(block);
            if (block.kind == "PrmText") text(block);
        }
        for (const Block& block : judge_.document.blocks)
            if (block.kind == "Module") {
                std::optional<std::uint32_t> length;
                for (const Entry& entry : block.body)
                    if (same_any_case(entry.keyword, "Ext_Module_Prm_Data_Len"))
                        length = parse_number(entry.value);
                area(block.body, length, "Ext_Module_Prm_Data_Len");
            }
        area(judge_.document.keywords, judge_.document.number("Max_User_Prm_Data_Len"),
             "Max_User_Prm_Data_Len");
    }

private:
    void error(unsigned line, std::string what) { judge_.say(line, Weight::error, std::move(what)); }

    void text(const Block& block)
    {
        const auto number = parse_number(block.head);
        if (!number) return error(block.line, "PrmText has no number: write PrmText = 1 and the like.");
        if (!texts_.insert(*number).second)
            error(block.line, "PrmText " + block.head + " is there already: take another number.");
    }

    void definition(const Block& block)
    {
        const auto space = block.head.find_first_of(" \t\"");
        const auto number = parse_number(std::string_view{block.head}.substr(0, space));
        if (!number)
            return error(block.line,
                         "ExtUserPrmData has no number: write ExtUserPrmData = 1 \"name\" and the like.");
        Definition found;
        found.line = block.line;
        for (const Entry& entry : block.body) {
            if (entry.keyword.empty() && found.octets == 0) found = type_line(entry, block.line);
            if (same_any_case(entry.keyword, "Prm_Text_Ref") &&
                !texts_.contains(parse_number(entry.value).value_or(0)))
                error(entry.line,
                      "there is no PrmText " + entry.value + " before this line: define it above.");
        }
        if (found.octets == 0)
            error(block.line, "this ExtUserPrmData has no line with type, default and range that can be "
                              "understood: write Unsigned8 0 0-255 and the like.");
        if (!definitions_.try_emplace(*number, found).second)
            error(block.line,
                  "ExtUserPrmData " + std::to_string(*number) + " is there already: take another number.");
    }

    /// `type default [range]`; octets = 0 where it is none.
    Definition type_line(const Entry& entry, unsigned line)
    {
        Definition found;
        found.line = line;
        const std::string_view all = entry.value;
        const auto close = all.find(')');
        const auto end_of_type =
            all.find_first_of(" \t", all.find('(') < close && close != all.npos ? close : 0);
        const std::string_view name = all.substr(0, end_of_type);
        const std::string_view rest =
            end_of_type == all.npos ? std::string_view{} : trimmed(all.substr(end_of_type));
        const auto end_of_default = rest.find_first_of(" \t");
        const auto value = parse_signed(rest.substr(0, end_of_default));
        const std::string_view legal =
            end_of_default == rest.npos ? std::string_view{} : trimmed(rest.substr(end_of_default));

        std::int64_t min = 0, max = 0;
        for (const Type& type : kTypes)
            if (same_any_case(type.name, name)) {
                found.octets = type.octets;
                min = type.min;
                max = type.max;
            }
        if (const auto bits = bits_of(name)) {
            found.octets = 1;
            found.bits =
                static_cast<std::uint8_t>(((1U << (bits->second - bits->first + 1)) - 1U) << bits->first);
            max = (std::int64_t{1} << (bits->second - bits->first + 1)) - 1;
        }
        if (found.octets == 0 || !value) return {line, 0, 0xFF};
        if (*value < min || *value > max || !is_legal(legal, *value))
            error(entry.line, "the default " + std::to_string(*value) +
                                  " is not among the legal values: correct one of the two.");
        return found;
    }

    /// Bit(3) or BitArea(4-6): the first and the last bit.
    static std::optional<std::pair<unsigned, unsigned>> bits_of(std::string_view name)
    {
        const auto open = name.find('(');
        if (open == name.npos || name.back() != ')') return std::nullopt;
        const std::string_view inside = name.substr(open + 1, name.size() - open - 2);
        const bool area = same_any_case(name.substr(0, open), "BitArea");
        if (!area && !same_any_case(name.substr(0, open), "Bit")) return std::nullopt;
        const auto dash = area ? inside.find('-') : inside.npos;
        const auto first = parse_number(trimmed(inside.substr(0, dash)));
        const auto last = dash == inside.npos ? first : parse_number(trimmed(inside.substr(dash + 1)));
        if (!first || !last || *first > *last || *last > 7) return std::nullopt;
        return std::pair{static_cast<unsigned>(*first), static_cast<unsigned>(*last)};
    }

    /// `0-1000` or `0,1,2,5`; nothing said allows everything.
    static bool is_legal(std::string_view legal, std::int64_t value)
    {
        if (legal.empty()) return true;
        if (const auto dash = legal.find('-', 1); dash != legal.npos) {
            const auto min = parse_signed(trimmed(legal.substr(0, dash)));
            const auto max = parse_signed(trimmed(legal.substr(dash + 1)));
            return !min || !max || (value >= *min && value <= *max);
        }
        for (const std::string_view part : split(legal, ','))
            if (parse_signed(part) == value) return true;
        return false;
    }

    /// The constants and references of the device or of one module.
    void area(const std::vector<Entry>& entries, std::optional<std::uint32_t> length,
              std::string_view length_keyword)
    {
        std::map<std::uint64_t, std::uint8_t> taken; ///< offset: bits
        for (const Entry& entry : entries) {
            const bool constants = same_any_case(entry.keyword, "Ext_User_Prm_Data_Const");
            if ((!constants && !same_any_case(entry.keyword, "Ext_User_Prm_Data_Ref")) || !entry.index)
                continue;
            std::size_t octets = 0;
            if (constants) {
                octets = parse_octets(entry.value).value_or(std::vector<std::uint8_t>{}).size();
            } else {
                const auto known = definitions_.find(parse_number(entry.value).value_or(0x10000));
                if (known == definitions_.end() || known->second.line > entry.line) {
                    error(entry.line, "there is no ExtUserPrmData " + entry.value +
                                          " before this line: define it above.");
                    continue;
                }
                octets = known->second.octets;
                if (overlaps(taken, *entry.index, known->second))
                    judge_.say(
                        entry.line, kLivesInTheField,
                        "this parameter lies on bits that another one has already: correct its offset.");
            }
            if (!length)
                judge_.say(entry.line, kLivesInTheField,
                           std::string{length_keyword} + " is missing: add the length in octets.");
            else if (std::uint64_t{*entry.index} + octets > *length)
                error(entry.line, "this reaches beyond " + std::string{length_keyword} + " = " +
                                      std::to_string(*length) + ": correct one of the two.");
        }
    }

    static bool overlaps(std::map<std::uint64_t, std::uint8_t>& taken, std::uint32_t offset,
                         const Definition& definition)
    {
        bool overlap = false;
        for (std::size_t i = 0; i < definition.octets; ++i) {
            std::uint8_t& bits = taken[std::uint64_t{offset} + i];
            overlap = overlap || (bits & definition.bits) != 0;
            bits = static_cast<std::uint8_t>(bits | definition.bits);
        }
        return overlap;
    }

    Judge& judge_;
    std::set<std::uint32_t> texts_;
    std::map<std::uint32_t, Definition> definitions_;
};

} // namespace

void check_parameters(Judge& judge)
{
    ParameterCheck{judge}.run();
}

} // namespace dpslave::gsd
