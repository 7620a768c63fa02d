// SPDX-License-Identifier: Apache-2.0
/// What every list of faults in a text has to be, for the targets that read a text.
#pragma once

#include "input.hpp"

#include "dpslave/input/fault.hpp"

namespace fuzz {

inline void judge_faults(std::string_view text, const dpslave::input::Faults& faults)
{
    const auto lines = static_cast<std::size_t>(
        1 + std::ranges::count_if(text, [](char c) { return c == '\n' || c == '\r'; }));
    demand(faults.size() <= dpslave::input::kMaxFaults + 1, "the list of faults has its length");
    for (const auto& fault : faults) {
        demand(!fault.what.empty() && !fault.file.empty(), "a fault says where and what");
        demand(fault.line <= lines, "a fault has its line in the text");
        const std::string said = to_string(fault);
        demand(said.size() < 8192, "a fault has its length");
        demand(std::ranges::all_of(said, [](char c) { return static_cast<unsigned char>(c) >= 0x20; }),
               "a fault is one printable line");
    }
}

} // namespace fuzz
