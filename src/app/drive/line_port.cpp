// SPDX-License-Identifier: Apache-2.0
#include "line_port.hpp"

#include "dpslave/io/clock.hpp"

#include <spdlog/spdlog.h>

#include <utility>

namespace dpslave::app {

LinePort::LinePort(std::unique_ptr<LineBackend> backend, std::atomic<bool>& is_open,
                   drive::FrameListener& frames)
    : backend_(std::move(backend)), is_open_(is_open), frames_(frames)
{
    is_open_.store(true, std::memory_order_relaxed);
    if (!backend_) awaited_until_ = io::monotonic_now() + kPatience;
}

void LinePort::set_units(std::vector<DriveUnit> units)
{
    units_ = std::move(units);
    if (backend_) backend_->set_units(units_);
}

bool LinePort::open(const config::LineConfig& line)
{
    if (backend_) return true;
    const Instant now = io::monotonic_now();
    if (now < next_open_) return false;
    auto opened = LineBackend::open(line, is_open_, frames_);
    if (!opened && is_awaited(now)) return false;
    next_open_ = now + kOpenAgainAfter;
    if (!opened) {
        is_open_.store(false, std::memory_order_relaxed);
        if (!std::exchange(failure_logged_, true))
            spdlog::error("line {}: {}; it is tried again", line.name, opened.error());
        return false;
    }
    backend_ = std::move(*opened);
    is_open_.store(true, std::memory_order_relaxed);
    backend_->set_units(units_);
    spdlog::info("line {}: {} is open", line.name, line.port);
    return true;
}

void LinePort::exchange(std::unique_ptr<LineBackend> backend)
{
    close(); // first: the next one may need the same port
    backend_ = std::move(backend);
    awaited_until_ = io::monotonic_now() + kPatience;
    failure_logged_ = false;
    is_open_.store(true, std::memory_order_relaxed); // a moment without it is no fault
}

void LinePort::close()
{
    backend_.reset();
    next_open_ = {};
}

} // namespace dpslave::app
