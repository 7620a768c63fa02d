// SPDX-License-Identifier: Apache-2.0
/// Tells systemd the state of the service (sd_notify(3)). It does nothing without NOTIFY_SOCKET in the
/// environment.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <optional>
#include <string_view>

namespace dpslave::io {

class Notifier {
public:
    void ready(std::string_view status); ///< READY=1 and what `systemctl status` shows
    void reloading(Instant now); ///< the configuration is read again; ready() is to come when that is over
    void status(std::string_view text); ///< one line; a line break in it becomes a blank
    void watchdog();                    ///< WATCHDOG=1
    void stopping();

    /// WatchdogSec= of the unit: watchdog() has to be called more often than this. It is nullopt if there is
    /// no watchdog.
    std::optional<std::chrono::microseconds> watchdog_interval() const;
};

} // namespace dpslave::io
