// SPDX-License-Identifier: Apache-2.0
/// The only now() of the project.
#pragma once

#include "dpslave/base/units.hpp"

namespace dpslave::io {

/// CLOCK_MONOTONIC: the time line of the bus.
Instant monotonic_now() noexcept;

} // namespace dpslave::io
