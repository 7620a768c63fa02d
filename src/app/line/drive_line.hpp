// SPDX-License-Identifier: Apache-2.0
/// A drive line as the main thread has it: its keys, its link and its thread. Main thread only.
#pragma once

#include "app/links/links.hpp"
#include "drive_thread.hpp"

#include "dpslave/base/sign_of_life.hpp"
#include "dpslave/config/config.hpp"
#include "dpslave/io/event_fd.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dpslave::app {

/// Its thread ends with it.
struct DriveLine {
    DriveLine(config::LineConfig line, const config::TraceConfig& trace)
        : config(std::move(line)),
          link(std::size_t{trace.drive_kib} * 1024, std::size_t{trace.samples_kib} * 1024)
    {}
    /// The safe state is written until `ends_by` at most, kNever: for DriveThread::kSafeStateLimit. An answer
    /// that is waited for may come a moment longer.
    void request_stop(Instant now, Instant ends_by)
    {
        link.ends_by.store(ends_by, std::memory_order_relaxed);
        thread.request_stop();
        link.sign->end_waits(now +
                             DriveThread::kLastAnswer); // last: the thread may end its own limit until then
        wake.ring();
    }

    /// For how long it has given no sign, as the main thread has lived it. At least every
    /// Silence::kLongestLook.
    std::chrono::nanoseconds look(Instant now) { return silent_for = silence.look(link.sign->last(), now); }

    config::LineConfig config;
    LineLink link;
    Silence silence;
    std::chrono::nanoseconds silent_for{}; ///< of the last look()
    std::unique_ptr<DriveThread> work;
    io::EventFd wake;
    std::uint32_t changes_offered = 0;
    std::jthread thread; ///< last: it ends before what it uses is destroyed
};
using DriveLines = std::vector<std::shared_ptr<DriveLine>>;

/// "line p3 has stalled in write for 12.0 s".
std::string stall_words(const DriveLine& line, std::chrono::nanoseconds length);

} // namespace dpslave::app
