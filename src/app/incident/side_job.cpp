// SPDX-License-Identifier: Apache-2.0
#include "side_job.hpp"

#include "dpslave/io/realtime.hpp"

#include <spdlog/spdlog.h>

#include <exception>
#include <system_error>
#include <utility>

namespace dpslave::app {

SideJob::~SideJob()
{
    if (thread_.joinable()) thread_.join();
}

bool SideJob::start(Work work)
{
    if (!is_idle()) return false;
    auto shared = std::make_shared<Shared>();
    try {
        thread_ = std::thread{[shared, work = std::move(work)] {
            io::name_thread("disk");
            io::unlock_deep_stack();
            try {
                shared->then = work();
            } catch (const std::exception& error) { // no memory left
                spdlog::error("work on files of incidents: {}", error.what());
            }
            shared->is_done.store(true, std::memory_order_release);
        }};
    } catch (const std::system_error&) {
        return false;
    }
    shared_ = std::move(shared);
    return true;
}

bool SideJob::is_idle()
{
    if (!shared_) return true;
    if (!shared_->is_done.load(std::memory_order_acquire)) return false;
    thread_.join();
    const auto over = std::exchange(shared_, nullptr);
    if (over->then) over->then();
    return !shared_;
}

bool SideJob::wait(std::chrono::milliseconds limit)
{
    constexpr std::chrono::milliseconds kStep{1};
    for (; !is_idle(); limit -= kStep) {
        if (limit <= std::chrono::milliseconds{0}) return false;
        std::this_thread::sleep_for(kStep);
    }
    return true;
}

} // namespace dpslave::app
