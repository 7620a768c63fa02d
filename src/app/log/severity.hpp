// SPDX-License-Identifier: Apache-2.0
/// How much a line of the log matters.
#pragma once

#include <cstdint>

namespace dpslave::app {

enum class Severity : std::uint8_t { info, warning, error };

} // namespace dpslave::app
