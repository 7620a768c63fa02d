// SPDX-License-Identifier: Apache-2.0
// The new style of user parameters: definitions, references to them, and where they lie.
#include "check_parts.hpp"
#include "parameters.hpp"
#include "text.hpp"

#include <map>
#include <set>

namespace dpslave::gsd {
namespace {

struct Definition {
    unsigned line = 0;
    std::optional<ParameterType> type; ///< nullopt: it was not understood
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
        const auto number = reference_of(block);
        if (!number)
            return error(block.line,
                         "ExtUserPrmData has no number: write ExtUserPrmData = 1 \"name\" and the like.");
        Definition found;
        found.line = block.line;
        for (const Entry& entry : block.body) {
            if (entry.keyword.empty() && !found.type) found.type = type_line(entry);
            if (same_any_case(entry.keyword, "Prm_Text_Ref") &&
                !texts_.contains(parse_number(entry.value).value_or(0)))
                error(entry.line,
                      "there is no PrmText " + entry.value + " before this line: define it above.");
        }
        if (!found.type)
            error(
                block.line,
                "this ExtUserPrmData has no line with type, default and range that can be understood: write Unsigned8 0 0-255 and the like.");
        if (!definitions_.try_emplace(*number, found).second)
            error(block.line,
                  "ExtUserPrmData " + std::to_string(*number) + " is there already: take another number.");
    }

    std::optional<ParameterType> type_line(const Entry& entry)
    {
        const auto type = parameter_type(entry);
        if (type && !type->value_is_legal)
            error(entry.line, "the default " + std::to_string(type->value) +
                                  " is not among the legal values: correct one of the two.");
        return type;
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
                if (!known->second.type) continue;
                octets = known->second.type->octets;
                if (overlaps(taken, *entry.index, *known->second.type))
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
                         const ParameterType& type)
    {
        bool overlap = false;
        for (std::size_t i = 0; i < type.octets; ++i) {
            std::uint8_t& bits = taken[std::uint64_t{offset} + i];
            overlap = overlap || (bits & type.bits) != 0;
            bits = static_cast<std::uint8_t>(bits | type.bits);
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
