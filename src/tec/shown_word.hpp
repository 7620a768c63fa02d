// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace dpslave::tec {

/// Returns ">6AB5": four digits after the mark of a hexadecimal number.
std::string shown_word(std::uint16_t word);

} // namespace dpslave::tec
