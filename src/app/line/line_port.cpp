// SPDX-License-Identifier: Apache-2.0
#include "line_port.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace dpslave::app {

LinePort::LinePort(FirstPort first, const LineBackend::Listeners& listeners) : listeners_(listeners)
{
    begin(std::move(first));
}

/// A port that another line still has is no fault; one that is missing was named already.
void LinePort::begin(FirstPort first)
{
    backend_ = std::move(first.backend);
    awaited_until_ = first.is_missing ? Instant{} : io::monotonic_now() + kPatience;
    failure_logged_ = first.is_missing;
    listeners_.is_open.store(!first.is_missing, std::memory_order_relaxed);
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
    auto opened = LineBackend::open(line, listeners_);
    if (!opened && is_awaited(now)) return false;
    next_open_ = now + kOpenAgainAfter;
    if (!opened) {
        listeners_.is_open.store(false, std::memory_order_relaxed);
        if (!std::exchange(failure_logged_, true))
            listeners_.happenings.tell(
                Severity::error, 0, fmt::format("line {}: {}; it is tried again", line.name, opened.error()),
                LineHappenings::Kind::port_missing);
        return false;
    }
    backend_ = std::move(*opened);
    listeners_.is_open.store(true, std::memory_order_relaxed);
    backend_->set_units(units_);
    listeners_.happenings.tell(Severity::info, 0, fmt::format("line {}: {} is open", line.name, line.port));
    log_driver(line);
    return true;
}

void LinePort::log_driver(const config::LineConfig& line) const
{
    if (!backend_) return;
    if (const std::string driver = backend_->driver_in_words(); !driver.empty())
        spdlog::info("line {}: {}: {}", line.name, line.port, driver);
}

void LinePort::exchange(FirstPort next)
{
    close(); // first: the next one may need the same port
    begin(std::move(next));
}

void LinePort::close()
{
    backend_.reset();
    next_open_ = {};
}

} // namespace dpslave::app
