// SPDX-License-Identifier: Apache-2.0
/// A pty has no RTS and no shift register. In this program it has: ioctl() is answered here for what a pty
/// refuses, and every edge of RTS is written down. Any thread may call; nothing allocates.
#pragma once

#include "dpslave/base/units.hpp"

#include <cstddef>
#include <vector>

namespace dpslave::test::uart {

struct Edge {
    bool active = false;
    Instant at{};
};

enum class Shift { unknown, empty, busy }; ///< what TIOCSERGETLSR says; unknown: ENOTTY, as a pty does

/// Inactive, no edge yet, the shift register unknown, nothing refused.
void reset();
void refuse_edges(bool refuse); ///< EIO, as of a device that has gone
/// busy: until then, from there on empty.
void shift_register(Shift says, Instant until = kNever);
/// TIOCOUTQ says so until they are flushed, or gone by `until`; 0: as the pty.
void hold_back(int octets, Instant until = kNever);
unsigned flushes(); ///< of what was held back
bool is_active();
std::vector<Edge> edges(); ///< changes of the level, in order

} // namespace dpslave::test::uart
