// SPDX-License-Identifier: Apache-2.0
#include "values.hpp"

#include <fmt/format.h>

#include <charconv>

namespace dpslave::sim {
namespace {

template <class T>
std::optional<T> whole(std::string_view text, int base)
{
    T value{};
    const auto* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value, base);
    if (error != std::errc{} || stop != end || text.empty()) return std::nullopt;
    return value;
}

} // namespace

std::vector<std::string> words_of(std::string_view line)
{
    std::vector<std::string> words;
    std::size_t at = 0;
    while (true) {
        at = line.find_first_not_of(" \t\r", at);
        if (at == std::string_view::npos || line[at] == '#') return words;
        const auto end = std::min(line.find_first_of(" \t\r", at), line.size());
        words.emplace_back(line.substr(at, end - at));
        at = end;
    }
}

std::optional<std::int64_t> number_of(std::string_view text)
{
    if (text.starts_with("0x") || text.starts_with("0X")) {
        if (text.size() > 2 && text[2] == '-') return std::nullopt;
        return whole<std::int64_t>(text.substr(2), 16);
    }
    return whole<std::int64_t>(text, 10);
}

std::optional<std::int64_t> number_of(std::string_view text, std::int64_t least, std::int64_t most)
{
    const auto number = number_of(text);
    return number && *number >= least && *number <= most ? number : std::nullopt;
}

std::optional<std::int64_t> number_at(const std::vector<std::string>& words, std::size_t at,
                                      std::int64_t least, std::int64_t most)
{
    return at < words.size() ? number_of(words[at], least, most) : std::nullopt;
}

std::string rest_of(const std::vector<std::string>& words, std::size_t from)
{
    std::string rest;
    for (std::size_t i = from; i < words.size(); ++i) rest += (rest.empty() ? "" : " ") + words[i];
    return rest;
}

std::optional<bool> switch_at(const std::vector<std::string>& words, std::size_t at)
{
    if (words.size() != at + 1 || (words[at] != "on" && words[at] != "off")) return std::nullopt;
    return words[at] == "on";
}

std::optional<std::chrono::nanoseconds> duration_of_text(std::string_view text)
{
    std::int64_t unit = 1'000'000'000;
    if (text.ends_with("ms"))
        unit = 1'000'000;
    else if (!text.ends_with("s"))
        return std::nullopt;
    text.remove_suffix(unit == 1'000'000 ? 2 : 1);
    const auto point = text.find('.');
    const auto before = whole<std::uint32_t>(text.substr(0, point), 10);
    if (!before) return std::nullopt;
    std::int64_t total = std::int64_t{*before} * unit;
    if (point != std::string_view::npos) {
        const auto digits = text.substr(point + 1);
        const auto after = whole<std::uint32_t>(digits, 10);
        if (!after || digits.size() > 6) return std::nullopt;
        std::int64_t fraction = std::int64_t{*after} * unit;
        for (std::size_t i = 0; i < digits.size(); ++i) fraction /= 10;
        total += fraction;
    }
    return std::chrono::nanoseconds{total};
}

Result<Octets, std::string> octets_of(std::string_view text)
{
    std::string digits;
    for (const char c : text) {
        if (c == ' ' || c == '\t' || c == ',') continue;
        digits += c;
    }
    if (digits.size() % 2 != 0)
        return Failure{fmt::format("'{}' has an odd number of hexadecimal digits", text)};
    Octets octets;
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        const auto octet = whole<std::uint8_t>(std::string_view{digits}.substr(i, 2), 16);
        if (!octet) return Failure{fmt::format("'{}' is no hexadecimal octet", digits.substr(i, 2))};
        octets.push_back(*octet);
    }
    return octets;
}

std::string show_word(std::uint16_t word)
{
    return fmt::format("{} (0x{:04X})", static_cast<std::int16_t>(word), word);
}

} // namespace dpslave::sim
