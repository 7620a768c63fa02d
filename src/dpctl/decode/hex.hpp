// SPDX-License-Identifier: Apache-2.0
/// Numbers of 16 bits as the tools of the masters want them (HA389815 app. C; HA463561U002, hex table and
/// "Data encoding"). Computed, because the printed tables have errors (rows X-29).
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

struct Number16 {
    std::string text; ///< as it was written
    std::uint16_t word = 0;
};

/// What one argument says: 288, -300.00 (the point is not transmitted), 0x120, >120, 120h, or 0-559, which is
/// many numbers. -32768 to 65535; otherwise a sentence.
Result<std::vector<Number16>, std::string> read_numbers(std::string_view argument);

Json hex_json(const std::vector<Number16>& numbers);
/// Single numbers, a line each.
std::string render_numbers(const std::vector<Number16>& numbers, Look look);
/// Adjoining numbers, ten in a line, as the manuals print them.
std::string render_range(const std::vector<Number16>& numbers, Look look);

} // namespace dpslave::dpctl
