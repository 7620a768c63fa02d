// SPDX-License-Identifier: Apache-2.0
/// The state of the service for systemd (sd_notify(3)). Without NOTIFY_SOCKET in the environment nothing
/// happens.
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

    /// WatchdogSec= of the unit: watchdog() has to be called more often than this. Nothing: there is no
    /// watchdog.
    std::optional<std::chrono::microseconds> watchdog_interval() const;
};

} // namespace dpslave::io
