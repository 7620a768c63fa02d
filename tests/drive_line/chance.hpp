// SPDX-License-Identifier: Apache-2.0
/// What happens by chance on a simulated line: everything comes from one seed, so a finding can be repeated.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

namespace dpslave::drive_line {

using namespace std::chrono_literals;
using Time = std::chrono::nanoseconds;

/// SplitMix64: the same numbers on every machine.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next()
    {
        std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return z ^ (z >> 31U);
    }
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(next() % limit); }
    bool one_in(std::size_t n) { return below(n) == 0; }
    /// True in `part` of 10000 cases.
    bool happens(unsigned part) { return part != 0 && below(10'000) < part; }
    Time between(Time from, Time to)
    {
        return from +
               Time{static_cast<std::int64_t>(next() % static_cast<std::uint64_t>((to - from).count() + 1))};
    }

private:
    std::uint64_t state_;
};

} // namespace dpslave::drive_line
