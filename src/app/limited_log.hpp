// SPDX-License-Identifier: Apache-2.0
/// The log for lines that may come endlessly: equal ones are one line with a count every 10 s. For one
/// thread.
#pragma once

#include "dpslave/base/repeated_lines.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::app {

class LimitedLog {
public:
    enum class Level : std::uint8_t { info, warning, error };

    /// `key`: what makes lines equal, whatever values are in `text`.
    void say(Level level, std::string_view key, std::string text, Instant now);
    /// Lines that are equal when their texts are.
    void say(Level level, std::string text, Instant now);
    /// Says what has been held back for long enough. To be called now and then.
    void on_time(Instant now);

private:
    RepeatedLines lines_;
};

} // namespace dpslave::app
