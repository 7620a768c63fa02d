// SPDX-License-Identifier: Apache-2.0
/// Global_Control: what two octets order. Source: wire reference 4.10.
#pragma once

#include "dpslave/dp/process_data.hpp"

#include <cstdint>

namespace dpslave::dp {

struct GlobalCommand {
    bool clear{};  ///< carried out before the others
    Switch sync{}; ///< on again while on: take the outputs received meanwhile
    Switch freeze{};
    std::uint8_t groups{}; ///< Group_Select; 0 = all slaves

    /// Is a slave with this Group_Ident meant?
    bool selects(std::uint8_t group_ident) const { return groups == 0 || (groups & group_ident) != 0; }
};

/// Precondition: data.size() == 2.
constexpr GlobalCommand global_command(Bytes data)
{
    constexpr auto pair = [](unsigned bits, unsigned set, unsigned undo) { // the un-function has priority
        if ((bits & undo) != 0) return Switch::off;
        return (bits & set) != 0 ? Switch::on : Switch::keep;
    };
    return {.clear = (data[0] & 0x02) != 0,
            .sync = pair(data[0], 0x20, 0x10),
            .freeze = pair(data[0], 0x08, 0x04),
            .groups = data[1]};
}

} // namespace dpslave::dp
