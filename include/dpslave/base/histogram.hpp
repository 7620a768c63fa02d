// SPDX-License-Identifier: Apache-2.0
/// Counts of values in classes that grow with the value, small enough to be copied between threads. No
/// allocation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace dpslave {

/// One class per value below 16; from there to 64 eight classes to the power of two, above four: a class is
/// never wider than a quarter of its smallest value, so a figure read from it is at most that wrong. Unit:
/// whatever the caller counts (us, T_bit). Source: wire reference 11.6, which asks for the maximum as well as
/// for the shape.
class Histogram {
public:
    static constexpr std::size_t kClasses = 64;
    /// The last class holds everything from its lower end up.
    static constexpr std::uint32_t kLastLowerEnd = 14'336;

    void add(std::uint32_t value) noexcept;
    std::uint64_t count() const noexcept { return count_; }
    std::uint32_t highest() const noexcept { return highest_; }
    std::uint64_t sum() const noexcept { return sum_; } ///< of all values
    /// The value below or at which `share` (0..1) of all values lie: the upper end of its class, at most
    /// highest(). 0: none was counted.
    std::uint32_t quantile(double share) const noexcept;

    /// Smallest value of class `n`. Precondition, here and below: n < kClasses.
    static std::uint32_t lower_end(std::size_t n) noexcept;
    /// Returns the number of values in class `n`.
    std::uint64_t in_class(std::size_t n) const noexcept { return counts_[n]; }

private:
    std::array<std::uint64_t, kClasses> counts_{};
    std::uint64_t count_ = 0;
    std::uint64_t sum_ = 0;
    std::uint32_t highest_ = 0;
};

} // namespace dpslave
