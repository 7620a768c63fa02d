// SPDX-License-Identifier: Apache-2.0
/// The readers of times, rates and lists of tags that a person types. All commands and dpsim use them.
#pragma once

#include "dpslave/base/result.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave {

/// Reads "10", "10s", "1.5s", "500ms", "100us", "5m", "1h", "3d": a number alone is seconds. Returns nullopt
/// if it is no such time, or longer than a year.
std::optional<std::chrono::nanoseconds> read_duration(std::string_view text);
/// Reads a time from `least` to `most`; returns nullopt if it lies outside.
std::optional<std::chrono::nanoseconds> read_duration(std::string_view text, std::chrono::nanoseconds least,
                                                      std::chrono::nanoseconds most);
/// Returns a time in the same form, in its largest unit: "1500ms", "10s", "5m".
std::string duration_text(std::chrono::nanoseconds time);

/// Reads a rate in bit/s: "187500", "187.5k", "1.5M". Returns nullopt if it is no such rate, or no whole
/// number of bit/s.
std::optional<std::uint32_t> read_rate(std::string_view text);

/// Tags from `first` to `last`, both included.
struct TagSpan {
    std::uint16_t first = 0, last = 0;
    friend bool operator==(const TagSpan&, const TagSpan&) = default;
};

/// One tag or several, as a person names them: by number, or by a name or a part of one.
struct TypedTag {
    TagSpan span{};
    std::string name{}; ///< empty: `span` counts
    friend bool operator==(const TypedTag&, const TypedTag&) = default;
};

/// "055", "0x37", "55-57,60", "speed feedback": tags in the order in which they were typed, with commas or
/// blanks between them. The blanks of a name belong to it. The error is a sentence.
Result<std::vector<TypedTag>, std::string> read_tags(std::string_view text);

/// "1-600,1000-1127 7" in ascending order; spans that touch or overlap are joined. The error is a sentence.
Result<std::vector<TagSpan>, std::string> read_tag_spans(std::string_view text);

/// The items of a list with commas between them, without the blanks around each. An item may be empty.
std::vector<std::string_view> comma_items(std::string_view text);
/// The words of a text with blanks between them; none is empty.
std::vector<std::string_view> blank_words(std::string_view text);

} // namespace dpslave
