// SPDX-License-Identifier: Apache-2.0
/// Where in the records of a reply others are missing. Pure.
#pragma once

#include <cstdint>
#include <vector>

namespace dpslave::dpctl {

/// How many are missing before each record, by the numbers of the records; `lost` is the sum that the daemon
/// counted. What no number shows is missing before the first one.
std::vector<std::uint64_t> losses_before(const std::vector<std::uint64_t>& numbers, std::uint64_t lost);

} // namespace dpslave::dpctl
