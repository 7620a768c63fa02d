// SPDX-License-Identifier: Apache-2.0
/// When a counter of faults grows fast. Pure.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace dpslave::app {

class Burst {
public:
    /// So many within kWithin are a burst, which lasts until a whole kWithin without any.
    static constexpr std::uint64_t kLeast = 10;
    static constexpr std::chrono::seconds kWithin{1};

    /// The counter as it is now. True: a burst has begun.
    bool count(std::uint64_t total, Instant now);

private:
    std::optional<std::uint64_t> at_begin_; ///< of the present second
    std::uint64_t newest_ = 0;
    Instant begin_{}, looked_at_{}, grew_at_{};
    bool lasts_ = false;
};

} // namespace dpslave::app
