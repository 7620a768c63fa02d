// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/typed.hpp"

#include "dpslave/base/number.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

namespace dpslave {
namespace {

constexpr std::string_view kBlanks = " \t";

struct Unit {
    std::string_view name;
    std::int64_t factor;
};

constexpr std::int64_t kSecond = 1'000'000'000;
/// A unit stands before those that its name ends with.
constexpr std::array kTimeUnits = std::to_array<Unit>({
    {"ms", 1'000'000},
    {"us", 1'000},
    {"s", kSecond},
    {"m", 60 * kSecond},
    {"h", 3600 * kSecond},
    {"d", 24 * 3600 * kSecond},
});
constexpr std::array kRateUnits = std::to_array<Unit>({{"k", 1'000}, {"M", 1'000'000}});

bool is_digits(std::string_view text)
{
    return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Reads "12.5" and multiplies it by `factor`. Returns nullopt if it is no such number, is above `most`, or
/// no whole multiple.
std::optional<std::int64_t> scaled(std::string_view text, std::int64_t factor, std::int64_t most)
{
    constexpr std::size_t kMostDecimals = 9;
    const auto point = text.find('.');
    const std::string_view whole = text.substr(0, point);
    const std::string_view decimals =
        point == std::string_view::npos ? std::string_view{} : text.substr(point + 1);
    if (!is_digits(whole) || decimals.size() > kMostDecimals) return std::nullopt;
    if (point != std::string_view::npos && !is_digits(decimals)) return std::nullopt;
    const auto before = read_number(whole, 0, most / factor);
    if (!before) return std::nullopt;
    std::int64_t total = *before * factor;
    for (const char digit : decimals) {
        if (digit != '0' && factor % 10 != 0) return std::nullopt;
        factor /= 10;
        total += (digit - '0') * factor;
    }
    return total <= most ? std::optional{total} : std::nullopt;
}

/// Reads a number with one of `units` after it; without one `factor` counts.
template <std::size_t N>
std::optional<std::int64_t> with_unit(std::string_view text, const std::array<Unit, N>& units,
                                      std::int64_t factor, std::int64_t most)
{
    for (const Unit& unit : units) {
        if (!text.ends_with(unit.name)) continue;
        return scaled(text.substr(0, text.size() - unit.name.size()), unit.factor, most);
    }
    return scaled(text, factor, most);
}

std::string quoted(std::string_view text)
{
    return '"' + std::string{text} + '"';
}

constexpr std::int64_t kLastTag = 0xFFFF;
constexpr const char* kWriteATag = ": write a tag from 0 to 65535, or a name";

/// Returns whether `text` can only be meant as a number: digits, perhaps after a minus.
bool looks_like_number(std::string_view text)
{
    if (text.starts_with('-')) text.remove_prefix(1);
    return is_digits(text) || read_number(text);
}

bool looks_like_span(std::string_view text)
{
    const auto dash = text.find('-', 1);
    if (dash == std::string_view::npos) return looks_like_number(text);
    return looks_like_number(text.substr(0, dash)) && looks_like_number(text.substr(dash + 1));
}

/// `text` looks like a span; `advice` says what to write when it is none of tags.
Result<TagSpan, std::string> span_of(std::string_view text, const char* advice)
{
    const auto dash = text.find('-', 1);
    const auto first = read_number(text.substr(0, dash), 0, kLastTag);
    const auto last =
        dash == std::string_view::npos ? first : read_number(text.substr(dash + 1), 0, kLastTag);
    if (!first || !last) return Failure{quoted(text) + advice};
    if (*first > *last) return Failure{quoted(text) + ": the first tag is above the last one: swap them"};
    return TagSpan{static_cast<std::uint16_t>(*first), static_cast<std::uint16_t>(*last)};
}

} // namespace

std::optional<std::chrono::nanoseconds> read_duration(std::string_view text)
{
    constexpr std::int64_t kLongest = 365 * 24 * 3600 * kSecond;
    const auto time = with_unit(text, kTimeUnits, kSecond, kLongest);
    return time ? std::optional{std::chrono::nanoseconds{*time}} : std::nullopt;
}

std::optional<std::chrono::nanoseconds> read_duration(std::string_view text, std::chrono::nanoseconds least,
                                                      std::chrono::nanoseconds most)
{
    const auto time = read_duration(text);
    return time && *time >= least && *time <= most ? time : std::nullopt;
}

std::string duration_text(std::chrono::nanoseconds time)
{
    constexpr std::array kLargestFirst =
        std::to_array<std::size_t>({5, 4, 3, 2, 0, 1}); // d h m s ms us of kTimeUnits
    if (time.count() == 0) return "0s";
    for (const std::size_t i : kLargestFirst)
        if (time.count() % kTimeUnits[i].factor == 0)
            return std::to_string(time.count() / kTimeUnits[i].factor) + std::string{kTimeUnits[i].name};
    return std::to_string(time.count()) + "ns";
}

std::optional<std::uint32_t> read_rate(std::string_view text)
{
    const auto rate = with_unit(text, kRateUnits, 1, std::numeric_limits<std::uint32_t>::max());
    return rate && *rate > 0 ? std::optional{static_cast<std::uint32_t>(*rate)} : std::nullopt;
}

std::vector<std::string_view> comma_items(std::string_view text)
{
    std::vector<std::string_view> items;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        std::string_view item = text.substr(at, end - at);
        item.remove_prefix(std::min(item.find_first_not_of(kBlanks), item.size()));
        items.push_back(item.substr(0, item.find_last_not_of(kBlanks) + 1));
        at = end + 1;
    }
    return items;
}

std::vector<std::string_view> blank_words(std::string_view text)
{
    std::vector<std::string_view> words;
    for (std::size_t at = text.find_first_not_of(kBlanks); at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = text.find_first_not_of(kBlanks, end);
    }
    return words;
}

Result<std::vector<TypedTag>, std::string> read_tags(std::string_view text)
{
    std::vector<TypedTag> tags;
    for (const std::string_view item : comma_items(text)) {
        if (item.empty()) return Failure{quoted(text) + kWriteATag};
        const auto words = blank_words(item);
        if (!std::all_of(words.begin(), words.end(), looks_like_span)) {
            if (item.front() == '-') return Failure{quoted(item) + kWriteATag};
            tags.push_back({{}, std::string{item}});
            continue;
        }
        for (const std::string_view word : words) {
            const auto span = span_of(word, kWriteATag);
            if (!span) return Failure{span.error()};
            tags.push_back({*span, {}});
        }
    }
    return tags;
}

Result<std::vector<TagSpan>, std::string> read_tag_spans(std::string_view text)
{
    constexpr const char* kWriteTags = ": write tags from 0 to 65535, as in 1-600,1000-1127";
    std::vector<TagSpan> spans;
    for (const std::string_view item : comma_items(text)) {
        const auto words = blank_words(item);
        if (words.empty() || !std::all_of(words.begin(), words.end(), looks_like_span))
            return Failure{quoted(text) + kWriteTags};
        for (const std::string_view word : words) {
            const auto span = span_of(word, kWriteTags);
            if (!span) return Failure{span.error()};
            spans.push_back(*span);
        }
    }
    std::sort(spans.begin(), spans.end(), [](TagSpan a, TagSpan b) { return a.first < b.first; });
    std::vector<TagSpan> joined;
    for (const TagSpan span : spans) {
        if (!joined.empty() && span.first <= std::uint32_t{joined.back().last} + 1)
            joined.back().last = std::max(joined.back().last, span.last);
        else
            joined.push_back(span);
    }
    return joined;
}

} // namespace dpslave
