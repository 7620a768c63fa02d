// SPDX-License-Identifier: Apache-2.0
/// A drive line as the main thread has it: its keys, its link and its thread. Main thread only.
#pragma once

#include "app/links/links.hpp"
#include "drive_thread.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/io/event_fd.hpp"

#include <cstdint>
#include <memory>
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
    void request_stop()
    {
        thread.request_stop();
        wake.ring();
    }

    config::LineConfig config;
    LineLink link;
    std::unique_ptr<DriveThread> work;
    io::EventFd wake;
    std::uint32_t changes_offered = 0;
    std::jthread thread; ///< last: it ends before what it uses is destroyed
};
using DriveLines = std::vector<std::shared_ptr<DriveLine>>;

} // namespace dpslave::app
