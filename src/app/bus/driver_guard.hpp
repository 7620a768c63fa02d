// SPDX-License-Identifier: Apache-2.0
/// The last guard of a driver enable, of the bus or of a drive line, while the program runs: a thread that
/// does nothing else, so neither a thread that hangs nor the main thread's files delay it. Source: row A-027.
#pragma once

#include "dpslave/io/driver_enable.hpp"
#include "dpslave/io/switched_port.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

namespace dpslave::app {

class DriverGuard {
public:
    /// How often it looks: a line that is stuck is active for the limit and this, at most.
    static constexpr std::chrono::milliseconds kLook{10};
    /// Each time that it has looked so often it asks the UART whether another program has raised the line.
    static constexpr unsigned kRaisedLook = 10;

    /// For how long the driver may be active now: twice the longest telegram or request.
    using Limit = std::function<std::chrono::nanoseconds()>;
    /// `driver` outlives the guard, which does nothing before start(). `total`: counts as dropped() and
    /// raised() do, over guards that come and go.
    DriverGuard(io::DriverEnable& driver, Limit limit, io::TransceiverCounts* total = nullptr)
        : driver_(driver), limit_(std::move(limit)), total_(total)
    {}

    /// Runs until the end of the object, if the driver is switched by the program at all. `watched`: the
    /// priority of the thread that switches it, 0..99; the guard has one more, or as much if that is 99, so
    /// that a thread that spins does not keep it off the processor.
    void start(int watched);

    /// How often it made the driver enable inactive. Any thread may ask.
    std::uint64_t dropped() const { return dropped_.load(std::memory_order_relaxed); }
    /// How often another program had raised it (DriverEnable::release_if_raised()). Any thread may ask.
    std::uint64_t raised() const { return raised_.load(std::memory_order_relaxed); }

private:
    void watch(const std::stop_token& stop, int priority);

    io::DriverEnable& driver_;
    Limit limit_;
    io::TransceiverCounts* total_;
    std::atomic<std::uint64_t> dropped_{0}, raised_{0};
    std::jthread thread_;
};

} // namespace dpslave::app
