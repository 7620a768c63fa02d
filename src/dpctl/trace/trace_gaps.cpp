// SPDX-License-Identifier: Apache-2.0
#include "trace_gaps.hpp"

#include <algorithm>

namespace dpslave::dpctl {

std::vector<std::uint64_t> losses_before(const std::vector<std::uint64_t>& numbers, std::uint64_t lost)
{
    std::vector<std::uint64_t> losses(numbers.size());
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        if (numbers[i] <= numbers[i - 1]) continue;
        losses[i] = std::min(numbers[i] - numbers[i - 1] - 1, lost);
        lost -= losses[i];
    }
    if (!losses.empty()) losses[0] = lost;
    return losses;
}

} // namespace dpslave::dpctl
