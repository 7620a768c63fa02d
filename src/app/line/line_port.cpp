// SPDX-License-Identifier: Apache-2.0
#include "line_port.hpp"

#include "app/links/port_words.hpp"

#include "dpslave/io/clock.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

namespace dpslave::app {

LinePort::LinePort(bool is_held, const LineBackend::Listeners& listeners) : listeners_(listeners)
{
    begin(is_held);
}

/// A port that another line still has is no fault.
void LinePort::begin(bool is_held)
{
    awaited_until_ = is_held ? io::monotonic_now() + kPatience : Instant{};
    failure_told_ = false;
    listeners_.is_open.store(true, std::memory_order_relaxed);
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
        if (!std::exchange(failure_told_, true))
            listeners_.happenings.tell(
                Severity::error, 0,
                fmt::format("line {}: {}; its drives count as silent until it can be opened", line.name,
                            opened.error()),
                LineHappenings::Kind::port_missing);
        return false;
    }
    backend_ = std::move(*opened);
    listeners_.is_open.store(true, std::memory_order_relaxed);
    backend_->set_units(units_);
    if (std::exchange(failure_told_, false))
        listeners_.happenings.tell(Severity::info, 0,
                                   fmt::format("line {}: {} is open", line.name, line.port));
    log_driver(line);
    return true;
}

bool LinePort::settings_hold(const config::LineConfig& line)
{
    const auto changed = backend_->changed_settings();
    if (!changed) return true;
    listeners_.settings_changed.fetch_add(1, std::memory_order_relaxed);
    listeners_.changed_settings.publish(*changed);
    const auto [severity, text] = in_words(*changed, line.port, "What was read is thrown away");
    listeners_.happenings.tell(severity, 0, fmt::format("line {}: {}", line.name, text));
    if (backend_->set_again(*changed)) give_up();
    return !changed->harms_octets && backend_ != nullptr;
}

/// Who switches the transceiver, unless it does so by itself.
void LinePort::log_driver(const config::LineConfig& line) const
{
    if (const std::string driver = backend_->driver_in_words(); !driver.empty())
        spdlog::info("line {}: {}: {}", line.name, line.port, driver);
}

void LinePort::exchange(bool is_held)
{
    close(); // first: the next one may need the same port
    begin(is_held);
}

void LinePort::close()
{
    backend_.reset();
    next_open_ = {};
}

void LinePort::give_up()
{
    close();
    failure_told_ = true;
}

} // namespace dpslave::app
