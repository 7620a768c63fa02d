// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/notify.hpp"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <string>

namespace dpslave::io {
namespace {

/// STATUS= is one line of a list of assignments: a line break would begin the next one.
std::string status_line(std::string_view text)
{
    std::string line = "STATUS=";
    line += text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

/// An error is ignored: without a service manager there is nothing to notify.
void send(const std::string& state)
{
    static_cast<void>(::sd_notify(0, state.c_str()));
}

} // namespace

void Notifier::ready(std::string_view status)
{
    send("READY=1\n" + status_line(status));
}
void Notifier::reloading(Instant now)
{
    const auto at = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
    send("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(at));
}
void Notifier::status(std::string_view text)
{
    send(status_line(text));
}
void Notifier::watchdog()
{
    send("WATCHDOG=1");
}
void Notifier::stopping()
{
    send("STOPPING=1");
}

std::optional<std::chrono::microseconds> Notifier::watchdog_interval() const
{
    std::uint64_t interval = 0;
    if (::sd_watchdog_enabled(0, &interval) <= 0) return std::nullopt;
    return std::chrono::microseconds{interval};
}

} // namespace dpslave::io
