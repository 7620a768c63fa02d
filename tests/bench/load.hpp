// SPDX-License-Identifier: Apache-2.0
/// What needs the machine beside the bus: callers of the daemon, or strangers that need as much.
#pragma once

#include "responder.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <thread>
#include <vector>

namespace dpslave::bench {

/// Who calls: the words of dpctl.
struct CallerPlan {
    std::vector<std::vector<const char*>> follow; ///< each runs all the time
    const char* ask = nullptr;                    ///< once in each period, each time a new process
    std::chrono::milliseconds period{};
};

class Callers {
public:
    /// The first `ask` comes half a period behind the start.
    Callers(const std::filesystem::path& dpctl, const std::filesystem::path& socket, const CallerPlan& plan);

    /// Of all of them up to now.
    std::chrono::nanoseconds cpu() const;

private:
    void ask(const std::stop_token& stop, const std::filesystem::path& dpctl,
             const std::filesystem::path& socket, const CallerPlan& plan);

    std::vector<Child> followers_;
    std::atomic<std::int64_t> asked_{0}; ///< ns that `ask` has needed
    std::jthread asks_;
};

/// Five processes that wake ten times a second, go over 256 KiB of memory again and again, and need
/// `share` of one processor together.
class Strangers {
public:
    explicit Strangers(double share);

    std::chrono::nanoseconds cpu() const;

private:
    std::vector<Child> processes_;
};

} // namespace dpslave::bench
