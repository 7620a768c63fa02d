// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dpslave/base/process_image.hpp"

#include <cstdint>

namespace dpslave::drive {

/// Generations count up and may pass through 0xFFFFFFFF.
constexpr bool is_newer(Generation a, Generation b)
{
    return static_cast<std::int32_t>(a - b) > 0;
}

} // namespace dpslave::drive
