// SPDX-License-Identifier: Apache-2.0
#include "line_happenings.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {
namespace {

/// What is too long is cut, in whole characters; a NUL stays at the end.
template <std::size_t N>
void store(std::string_view text, std::array<char, N>& into)
{
    std::size_t end = 0;
    while (end < text.size()) {
        const std::size_t next = end + std::max<std::size_t>(1, character_length(text.substr(end)));
        if (next > N - 1) break;
        end = next;
    }
    text.copy(into.data(), end);
}

} // namespace

void LineHappenings::tell(Severity severity, std::uint32_t station, std::string_view text, Kind kind,
                          std::string_view key)
{
    if (lost_ != 0) {
        LineHappening loss{.severity = Severity::warning};
        store(fmt::format("{} things that happened at a drive line were not told", lost_), loss.text);
        if (ring_.push(loss)) lost_ = 0;
    }
    LineHappening happening{.kind = kind, .severity = severity, .station = station};
    store(key, happening.key);
    store(text, happening.text);
    if (!ring_.push(happening)) ++lost_;
}

} // namespace dpslave::app
