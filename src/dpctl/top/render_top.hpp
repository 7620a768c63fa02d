// SPDX-License-Identifier: Apache-2.0
/// The screen of `dpctl top` as lines. Pure.
#pragma once

#include "dpctl/cli/table.hpp"
#include "top_state.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// Of a terminal, in characters.
struct ScreenSize {
    std::size_t columns = 80, rows = 24;
};

/// How top is to look.
struct TopLook {
    Look look{};
    bool blocks = false; ///< the terminal shows the block elements of Unicode
};

/// One screen: not more lines than `size` has rows, none wider than its columns. The selected station with
/// its values; of lists that are too long a part.
std::vector<std::string> render_top(const TopState& state, ScreenSize size, const TopLook& look);

/// Everything, for a pipe: all stations, the values of each, the last events. Each line ended.
std::string render_top_whole(const TopState& state, const TopLook& look);

} // namespace dpslave::dpctl
