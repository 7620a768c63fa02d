// SPDX-License-Identifier: Apache-2.0
#include "parameters.hpp"

#include "text.hpp"

#include <utility>

namespace dpslave::gsd {
namespace {

struct Type {
    std::string_view name;
    std::size_t octets;
    std::int64_t min, max;
};
constexpr Type kTypes[] = {
    {"Unsigned8", 1, 0, 0xFF}, {"Unsigned16", 2, 0, 0xFFFF},   {"Unsigned32", 4, 0, 0xFFFFFFFF},
    {"Signed8", 1, -128, 127}, {"Signed16", 2, -32768, 32767}, {"Signed32", 4, -2147483648LL, 2147483647},
};

/// Bit(3) or BitArea(4-6): the first and the last bit.
std::optional<std::pair<unsigned, unsigned>> bits_of(std::string_view name)
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
bool is_legal(std::string_view legal, std::int64_t value)
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

} // namespace

std::optional<ParameterType> parameter_type(const Entry& line)
{
    const std::string_view all = line.value;
    const auto close = all.find(')');
    const auto end_of_type = all.find_first_of(" \t", all.find('(') < close && close != all.npos ? close : 0);
    const std::string_view name = all.substr(0, end_of_type);
    const std::string_view rest =
        end_of_type == all.npos ? std::string_view{} : trimmed(all.substr(end_of_type));
    const auto end_of_default = rest.find_first_of(" \t");
    const auto value = parse_signed(rest.substr(0, end_of_default));
    const std::string_view legal =
        end_of_default == rest.npos ? std::string_view{} : trimmed(rest.substr(end_of_default));

    ParameterType found{.octets = 0, .value = value.value_or(0)};
    std::int64_t min = 0, max = 0;
    for (const Type& type : kTypes)
        if (same_any_case(type.name, name)) {
            found.octets = type.octets;
            min = type.min;
            max = type.max;
        }
    if (const auto bits = bits_of(name)) {
        found.octets = 1;
        found.shift = bits->first;
        max = (std::int64_t{1} << (bits->second - bits->first + 1)) - 1;
        found.bits = static_cast<std::uint8_t>(max << bits->first);
    }
    if (found.octets == 0 || !value) return std::nullopt;
    found.value_is_legal = *value >= min && *value <= max && is_legal(legal, *value);
    return found;
}

std::optional<std::uint32_t> reference_of(const Block& block)
{
    const std::string_view head = block.head;
    return parse_number(head.substr(0, head.find_first_of(" \t\"")));
}

std::map<std::uint32_t, ParameterType> parameter_types(const Document& document)
{
    std::map<std::uint32_t, ParameterType> types;
    for (const Block& block : document.blocks) {
        const auto number = block.kind == "ExtUserPrmData" ? reference_of(block) : std::nullopt;
        if (!number) continue;
        for (const Entry& entry : block.body) {
            const auto type = entry.keyword.empty() ? parameter_type(entry) : std::nullopt;
            if (!type) continue;
            types.try_emplace(*number, *type);
            break;
        }
    }
    return types;
}

} // namespace dpslave::gsd
