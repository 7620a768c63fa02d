// SPDX-License-Identifier: Apache-2.0
/// What the program can test of itself at the start without anything connected: that its telegram code knows
/// a telegram written down beforehand, and no other, and that the clock of the bus runs. UART and driver
/// enable are tested where they are opened: what was set is read back and the line that enables the driver is
/// moved, to inactive. Where that fails it is FAULT = HARDWARE until it works. Only another station can show
/// that the transceiver sends. Pure. Source: HA463561U002, "Features" (B-006).
#pragma once

#include "dpslave/base/bytes.hpp"
#include "dpslave/base/units.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::app {

/// Slave_Diag request of master 2 to station 5, worked out by hand (wire reference 2).
inline constexpr std::array<std::uint8_t, 11> kKnownTelegram{0x68, 0x05, 0x05, 0x68, 0x85, 0x82,
                                                             0x6D, 0x3C, 0x3E, 0xEE, 0x16};

/// What has failed, each a sentence; empty: passed. `known`: kKnownTelegram, or a telegram that is not to
/// pass. `earlier` and `later`: the clock of the bus, read one after the other.
std::vector<std::string> self_test(Bytes known, Instant earlier, Instant later);

} // namespace dpslave::app
