// SPDX-License-Identifier: Apache-2.0
/// The last guard of the driver enable while the program runs: a thread that does nothing else, so neither a
/// bus thread that hangs nor the main thread's files delay it. Source: row A-027.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/io/driver_enable.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace dpslave::app {

class DriverGuard {
public:
    /// How often it looks: a line that is stuck is active for twice the longest telegram and this, at most.
    static constexpr std::chrono::milliseconds kLook{10};

    /// `baud`: the rate that replies have now. Both outlive the guard, which does nothing before start().
    DriverGuard(io::DriverEnable& driver, const std::atomic<Baud>& baud) : driver_(driver), baud_(baud) {}

    /// Runs until the end of the object, if the driver is switched by the program at all. `bus_priority`: of
    /// the bus thread, 0..99; the guard has one more, or as much if that is 99, so that a bus thread that
    /// spins does not keep it off the processor.
    void start(int bus_priority);

    /// How often it made the driver enable inactive. Any thread may ask.
    std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }

private:
    void watch(const std::stop_token& stop, int priority);

    io::DriverEnable& driver_;
    const std::atomic<Baud>& baud_;
    std::atomic<std::uint64_t> dropped_{0};
    std::jthread thread_;
};

} // namespace dpslave::app
