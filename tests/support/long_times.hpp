// SPDX-License-Identifier: Apache-2.0
/// Moments at which a number that holds a time is full: for tests that live across them.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <ostream>

namespace test {

struct LongTime {
    const char* name;
    std::chrono::nanoseconds since_start;

    dpslave::Instant instant() const { return dpslave::Instant{since_start}; }
    friend std::ostream& operator<<(std::ostream& out, const LongTime& time) { return out << time.name; }
};

/// The clock of the machine begins at its start, so all of them come on a machine that is not switched off:
/// 36 minutes, 72 minutes, 25 days, 50 days, 104 days.
inline constexpr std::array kLongTimes{
    LongTime{"us_of_31_bits", std::chrono::microseconds{std::int64_t{1} << 31}},
    LongTime{"us_of_32_bits", std::chrono::microseconds{std::int64_t{1} << 32}},
    LongTime{"ms_of_31_bits", std::chrono::milliseconds{std::int64_t{1} << 31}},
    LongTime{"ms_of_32_bits", std::chrono::milliseconds{std::int64_t{1} << 32}},
    LongTime{"ns_of_53_bits", std::chrono::nanoseconds{std::int64_t{1} << 53}},
};

inline constexpr std::chrono::days kSixtyDays{60};

} // namespace test
