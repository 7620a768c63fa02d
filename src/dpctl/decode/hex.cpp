// SPDX-License-Identifier: Apache-2.0
#include "hex.hpp"

#include "dpctl/cli/table.hpp"

#include "dpslave/base/bytes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace dpslave::dpctl {
namespace {

constexpr std::int32_t kTooLarge = 1'000'000;

/// Digits of `base` and nothing else.
std::optional<std::int32_t> digits(std::string_view text, int base)
{
    std::int32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (text.empty() || text.front() == '-' || end != text.data() + text.size()) return std::nullopt;
    if (error == std::errc::result_out_of_range) return kTooLarge;
    return error == std::errc{} ? std::optional{std::min(value, kTooLarge)} : std::nullopt;
}

std::optional<std::int32_t> read_hexadecimal(std::string_view text)
{
    if (text.starts_with("0x") || text.starts_with("0X")) return digits(text.substr(2), 16);
    if (text.starts_with('>')) return digits(text.substr(1), 16);
    if (text.ends_with('h') || text.ends_with('H')) return digits(text.substr(0, text.size() - 1), 16);
    return std::nullopt;
}

/// With sign and point; the point is left out.
std::optional<std::int32_t> read_decimal(std::string_view text)
{
    const bool negative = text.starts_with('-');
    if (negative || text.starts_with('+')) text.remove_prefix(1);
    std::string bare{text};
    if (const auto point = bare.find('.'); point != std::string::npos) bare.erase(point, 1);
    const auto value = digits(bare, 10);
    return value && negative ? std::optional{-*value} : value;
}

std::optional<std::int32_t> read_one(std::string_view text)
{
    const auto value = read_hexadecimal(text);
    return value ? value : read_decimal(text);
}

bool fits(std::int32_t value)
{
    return value >= -32768 && value <= 65535;
}

Failure<std::string> no_fit(std::string_view text)
{
    return Failure{fmt::format("{} does not fit into 16 bits: -32768 to 65535", text)};
}

std::int16_t as_signed(std::uint16_t word)
{
    return static_cast<std::int16_t>(word);
}

} // namespace

Result<std::vector<Number16>, std::string> read_numbers(std::string_view argument)
{
    if (const auto value = read_one(argument)) {
        if (!fits(*value)) return no_fit(argument);
        return std::vector<Number16>{{std::string{argument}, static_cast<std::uint16_t>(*value)}};
    }
    const std::size_t dash = argument.find('-', 1);
    const auto first = dash < argument.size() ? read_one(argument.substr(0, dash)) : std::nullopt;
    const auto last = dash < argument.size() ? read_one(argument.substr(dash + 1)) : std::nullopt;
    if (!first || !last || *first < 0 || argument.find('.') != std::string_view::npos)
        return Failure{
            fmt::format("'{}' is no number: write 288, -300.00, 0x120, >120, 120h or 0-559", argument)};
    if (!fits(*last)) return no_fit(argument);
    if (*first > *last)
        return Failure{fmt::format("'{}': the first number must not be above the last", argument)};
    std::vector<Number16> numbers;
    for (std::int32_t value = *first; value <= *last; ++value)
        numbers.push_back({std::to_string(value), static_cast<std::uint16_t>(value)});
    return numbers;
}

Json hex_json(const std::vector<Number16>& numbers)
{
    Json list = Json::array();
    for (const Number16& n : numbers)
        list.push_back({{"text", n.text},
                        {"value", n.word},
                        {"signed", as_signed(n.word)},
                        {"hex", fmt::format("{:04X}", n.word)},
                        {"octets", {high(n.word), low(n.word)}}});
    return {{"numbers", list}};
}

std::string render_numbers(const std::vector<Number16>& numbers, Look look)
{
    Table table({">NUMBER", ">DECIMAL", ">SIGNED", "HEX", "OCTETS"});
    for (const Number16& n : numbers)
        table.add({n.text, std::to_string(n.word), std::to_string(as_signed(n.word)),
                   fmt::format("{:04X}", n.word), fmt::format("{:02X} {:02X}", high(n.word), low(n.word))});
    return table.str(look);
}

std::string render_range(const std::vector<Number16>& numbers, Look look)
{
    Table table({">", ">0", ">1", ">2", ">3", ">4", ">5", ">6", ">7", ">8", ">9"});
    std::vector<Cell> line;
    for (const Number16& n : numbers) {
        if (line.empty()) {
            line.emplace_back(std::to_string(n.word / 10 * 10), Tone::strong);
            line.resize(1U + n.word % 10U, Cell{""});
        }
        line.emplace_back(fmt::format("{:04X}", n.word));
        if (line.size() == 11) {
            table.add(std::move(line));
            line.clear();
        }
    }
    if (!line.empty()) table.add(std::move(line));
    return table.str(look);
}

} // namespace dpslave::dpctl
