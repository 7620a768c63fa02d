// SPDX-License-Identifier: Apache-2.0
/// Work that may block, one piece at a time, on a thread beside the main thread. The thread begins with the
/// first piece and then waits for the next one. For the main thread.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace dpslave::app {

class SideJob {
public:
    /// Done on the main thread when the work is over.
    using Then = std::function<void()>;
    using Work = std::function<Then()>;

    /// `thread`: its name, of at most 15 characters. `what`: the work, where the log says that it has failed.
    SideJob(const char* thread, std::string what) : name_(thread), what_(std::move(what)) {}
    ~SideJob(); ///< waits for the work, unless leave() was called
    SideJob(const SideJob&) = delete;
    SideJob& operator=(const SideJob&) = delete;

    /// False: the work before still runs, or the system gives no thread.
    bool start(Work work);
    /// After the work is over: does what is to be done then. True: nothing runs.
    bool is_idle();
    /// As is_idle(), after a wait of at most `limit`.
    bool wait(std::chrono::milliseconds limit);
    /// Whatever runs is left to itself, and nothing is done when it is over. So the work may use only what it
    /// owns. This object is idle then, and starts nothing any more.
    void leave();

private:
    struct Shared;
    static void serve(const std::shared_ptr<Shared>& shared, const char* name, const std::string& what);

    const char* name_;
    std::string what_;
    bool is_busy_ = false; ///< until is_idle() has found that the work is over
    bool is_left_ = false;
    std::shared_ptr<Shared> shared_; ///< of both threads
    std::thread thread_;
};

} // namespace dpslave::app
