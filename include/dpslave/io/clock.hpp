// SPDX-License-Identifier: Apache-2.0
/// The only now() of the project.
#pragma once

#include "dpslave/base/units.hpp"

namespace dpslave::io {

/// CLOCK_MONOTONIC: the time line of the bus.
Instant monotonic_now() noexcept;

/// The calling thread sleeps until then; not at all if that has passed.
void sleep_until(Instant when) noexcept;

/// CLOCK_REALTIME, since 1970: only to name a moment to people and files. It can jump.
std::chrono::nanoseconds unix_now() noexcept;

} // namespace dpslave::io
