// SPDX-License-Identifier: Apache-2.0
/// The level of the log: info, or debug for a while. Pure: the owner sets the logger. Main thread only.
#pragma once

#include "dpslave/base/units.hpp"

#include <optional>

namespace dpslave::app {

class LogLevel {
public:
    /// Debug until `ends`, whatever was asked before.
    void set_debug(Instant ends) { ends_ = ends; }
    void set_info() { ends_.reset(); }
    bool is_debug() const { return ends_.has_value(); }
    /// When debug ends; nothing: the level is info.
    std::optional<Instant> ends() const { return ends_; }
    /// True: debug has just ended.
    bool falls_back(Instant now)
    {
        if (!ends_ || now < *ends_) return false;
        ends_.reset();
        return true;
    }

private:
    std::optional<Instant> ends_;
};

} // namespace dpslave::app
