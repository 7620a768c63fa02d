// SPDX-License-Identifier: Apache-2.0
/// A wait for what another thread does.
#pragma once

#include <chrono>
#include <thread>

namespace dpslave::test {

/// False: `condition` has not become true within a minute.
template <class Condition>
bool eventually(Condition condition, std::chrono::nanoseconds within = std::chrono::minutes{1})
{
    const auto limit = std::chrono::steady_clock::now() + within;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > limit) return false;
        std::this_thread::yield();
    }
    return true;
}

} // namespace dpslave::test
