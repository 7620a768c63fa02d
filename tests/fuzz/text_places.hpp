// SPDX-License-Identifier: Apache-2.0
/// Whether a place that a message names is in the text.
#pragma once

#include "input.hpp"

#include "dpslave/toml/fault.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

namespace fuzz {

/// Octets of each line, without its end.
inline std::vector<std::size_t> lines_of(std::string_view text)
{
    std::vector<std::size_t> lengths;
    while (true) {
        const auto end = text.find('\n');
        lengths.push_back(std::min(end, text.size()));
        if (end == std::string_view::npos) return lengths;
        text.remove_prefix(end + 1);
    }
}

/// There are faults, not too many, each with a sentence and a place in the text. The end of a line, and the
/// line behind the last one, are places too.
inline void demand_places(const dpslave::toml::Faults& faults, std::string_view text)
{
    const auto lines = lines_of(text);
    demand(faults.size() <= dpslave::toml::kMaxFaults + 1, "not more faults than the limit");
    for (const auto& fault : faults) {
        demand(!fault.what.empty(), "a fault has a sentence");
        demand(fault.line <= lines.size() + 1, "the line of a fault is in the text");
        if (fault.line >= 1 && fault.line <= lines.size())
            demand(fault.column <= lines[fault.line - 1] + 2, "the column of a fault is in its line");
        const std::string shown = to_string(fault);
        demand(std::ranges::none_of(shown, [](char c) { return static_cast<unsigned char>(c) < 0x20; }),
               "a fault as it is shown has no control characters");
    }
}

} // namespace fuzz
