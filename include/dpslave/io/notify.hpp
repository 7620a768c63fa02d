// SPDX-License-Identifier: Apache-2.0
/// Tells systemd the state of the service, as sd_notify(3) does, but never waits for a manager that does not
/// read. It does nothing without NOTIFY_SOCKET in the environment.
#pragma once

#include "dpslave/base/units.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::io {

class Notifier {
public:
    void ready(std::string_view status); ///< READY=1 and what `systemctl status` shows
    void reloading(Instant now); ///< the configuration is read again; ready() is to come when that is over
    void status(std::string_view text); ///< one line; a line break in it becomes a blank
    void watchdog();                    ///< WATCHDOG=1; dropped if it cannot be sent now
    void stopping();
    /// Sends what could not be sent when it was told, in its order. Of statuses in a row only the newest is
    /// left. Call it now and then.
    void send_rest();

    /// WatchdogSec= of the unit: watchdog() has to be called more often than this. It is nullopt if there is
    /// no watchdog.
    std::optional<std::chrono::microseconds> watchdog_interval() const;

private:
    void tell(std::string state);

    std::vector<std::string> unsent_;
};

} // namespace dpslave::io
