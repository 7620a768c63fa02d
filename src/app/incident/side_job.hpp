// SPDX-License-Identifier: Apache-2.0
/// Work that may block, one piece at a time, on a thread that ends with it. For the main thread.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

namespace dpslave::app {

class SideJob {
public:
    /// Done on the main thread when the work is over.
    using Then = std::function<void()>;
    using Work = std::function<Then()>;

    SideJob() = default;
    ~SideJob(); ///< waits for the work
    SideJob(const SideJob&) = delete;
    SideJob& operator=(const SideJob&) = delete;

    /// False: the work before still runs, or the system gives no thread.
    bool start(Work work);
    /// After the work is over: does what is to be done then. True: nothing runs.
    bool is_idle();
    /// As is_idle(), after a wait of at most `limit`.
    bool wait(std::chrono::milliseconds limit);

private:
    struct Shared {
        std::atomic<bool> is_done{false};
        Then then;
    };
    std::shared_ptr<Shared> shared_; ///< none: nothing runs
    std::thread thread_;
};

} // namespace dpslave::app
