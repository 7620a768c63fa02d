// SPDX-License-Identifier: Apache-2.0
#include "driver_guard.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/realtime.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace dpslave::app {

void DriverGuard::start(int watched)
{
    if (!driver_.by_hand()) return;
    constexpr int kHighest = 99;
    const int priority = watched == 0 ? 0 : std::min(watched + 1, kHighest);
    thread_ = std::jthread([this, priority](const std::stop_token& stop) { watch(stop, priority); });
}

void DriverGuard::watch(const std::stop_token& stop, int priority)
{
    io::name_thread("guard");
    for (const std::string& refused : io::enter_realtime(priority, -1))
        spdlog::warn("guard of the driver enable: {}", refused);
    const auto count = [](std::atomic<std::uint64_t>& one, std::atomic<std::uint64_t>* total) {
        one.fetch_add(1, std::memory_order_relaxed);
        if (total != nullptr) total->fetch_add(1, std::memory_order_relaxed);
    };
    for (unsigned looks = 0; !stop.stop_requested(); ++looks) {
        std::this_thread::sleep_for(kLook);
        if (driver_.drop_if_stuck(io::monotonic_now(), limit_()))
            count(dropped_, total_ != nullptr ? &total_->guarded : nullptr);
        if (looks % kRaisedLook == 0 && driver_.release_if_raised())
            count(raised_, total_ != nullptr ? &total_->raised : nullptr);
    }
}

} // namespace dpslave::app
