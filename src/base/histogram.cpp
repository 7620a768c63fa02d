// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/histogram.hpp"

#include <algorithm>
#include <bit>

namespace dpslave {
namespace {

// The width of the classes changes here: from one value to eighths, and from eighths to quarters, of a power
// of two.
constexpr std::uint32_t kEighthsFrom = 16;
constexpr std::uint32_t kQuartersFrom = 64;
constexpr std::size_t kFirstOfEighths = 16; // class of the value 16
constexpr std::size_t kFirstOfQuarters = 32;

std::size_t class_of(std::uint32_t value)
{
    if (value < kEighthsFrom) return value;
    if (value >= Histogram::kLastLowerEnd) return Histogram::kClasses - 1;
    const std::size_t power = static_cast<std::size_t>(std::bit_width(value)) - 1;
    if (value < kQuartersFrom) return kFirstOfEighths + (power - 4) * 8 + ((value >> (power - 3)) & 7);
    return kFirstOfQuarters + (power - 6) * 4 + ((value >> (power - 2)) & 3);
}

} // namespace

void Histogram::add(std::uint32_t value) noexcept
{
    ++counts_[class_of(value)];
    ++count_;
    sum_ += value;
    highest_ = std::max(highest_, value);
}

std::uint32_t Histogram::quantile(double share) const noexcept
{
    if (count_ == 0) return 0;
    const double wanted = std::clamp(share, 0.0, 1.0) * static_cast<double>(count_);
    auto rank = static_cast<std::uint64_t>(wanted);
    if (static_cast<double>(rank) < wanted || rank == 0) ++rank; // the first value counts, not the zeroth

    std::uint64_t seen = 0;
    for (std::size_t n = 0; n + 1 < kClasses; ++n) {
        seen += counts_[n];
        if (seen >= rank) return std::min(lower_end(n + 1) - 1, highest_);
    }
    return highest_;
}

std::uint32_t Histogram::lower_end(std::size_t n) noexcept
{
    if (n < kFirstOfEighths) return static_cast<std::uint32_t>(n);
    if (n < kFirstOfQuarters) {
        const std::size_t place = n - kFirstOfEighths;
        return static_cast<std::uint32_t>((8 + place % 8) << (place / 8 + 1));
    }
    const std::size_t place = n - kFirstOfQuarters;
    return static_cast<std::uint32_t>((4 + place % 4) << (place / 4 + 4));
}

} // namespace dpslave
