// SPDX-License-Identifier: Apache-2.0
#include "side_job.hpp"

#include "dpslave/io/realtime.hpp"

#include <spdlog/spdlog.h>

#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <utility>

namespace dpslave::app {

/// The mutex is held for moments only, never while work runs.
struct SideJob::Shared {
    std::mutex mutex;
    std::condition_variable changed;
    Work work; ///< to be done; empty: none
    Then then;
    bool is_done = true;
    bool ends = false; ///< the thread, when no work is left
};

SideJob::~SideJob()
{
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{shared_->mutex};
        shared_->ends = true;
    }
    shared_->changed.notify_all();
    thread_.join();
}

void SideJob::leave()
{
    is_left_ = true;
    is_busy_ = false;
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock{shared_->mutex};
        shared_->ends = true;
    }
    shared_->changed.notify_all();
    thread_.detach();
}

/// The thread: `shared` is its own too, for it may outlive the object.
void SideJob::serve(const std::shared_ptr<Shared>& shared, const char* name, const std::string& what)
{
    io::name_thread(name);
    io::unlock_deep_stack(0); // it may wait for a page
    std::unique_lock lock{shared->mutex};
    for (;;) {
        shared->changed.wait(lock, [&shared] { return shared->work || shared->ends; });
        if (!shared->work) return;
        Work work = std::exchange(shared->work, nullptr);
        lock.unlock();
        Then then;
        try {
            then = work();
        } catch (const std::exception& error) { // no memory left
            spdlog::error("{}", what + ": " + error.what());
        }
        work = nullptr; // what it owns is given up here, where that may block
        io::unlock_deep_stack(0);
        lock.lock();
        shared->then = std::move(then);
        shared->is_done = true;
        shared->changed.notify_all();
    }
}

bool SideJob::start(Work work)
{
    if (is_left_ || !is_idle()) return false;
    if (!thread_.joinable()) {
        auto shared = std::make_shared<Shared>();
        try {
            thread_ = std::thread{[shared, name = name_, what = what_] { serve(shared, name, what); }};
        } catch (const std::system_error&) {
            return false;
        }
        shared_ = std::move(shared);
    }
    is_busy_ = true;
    {
        const std::lock_guard lock{shared_->mutex};
        shared_->work = std::move(work);
        shared_->is_done = false;
    }
    shared_->changed.notify_all();
    return true;
}

bool SideJob::is_idle()
{
    if (!is_busy_) return true;
    Then then;
    {
        const std::lock_guard lock{shared_->mutex};
        if (!shared_->is_done) return false;
        then = std::exchange(shared_->then, nullptr);
    }
    is_busy_ = false;
    if (then) then();
    return !is_busy_;
}

bool SideJob::wait(std::chrono::milliseconds limit)
{
    const auto until = std::chrono::steady_clock::now() + limit;
    while (!is_idle()) {
        std::unique_lock lock{shared_->mutex};
        if (!shared_->changed.wait_until(lock, until, [this] { return shared_->is_done; })) return false;
    }
    return true;
}

} // namespace dpslave::app
