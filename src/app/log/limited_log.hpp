// SPDX-License-Identifier: Apache-2.0
/// The log for lines that may come endlessly: equal ones are one line with a count every 10 s. For one
/// thread.
#pragma once

#include "severity.hpp"

#include "dpslave/base/repeated_lines.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::app {

void write_line(Severity severity, std::string_view text); ///< at once

class LimitedLog {
public:
    /// `key`: what makes lines equal, whatever values are in `text`.
    void say(Severity severity, std::string_view key, std::string text, Instant now);
    /// Says what has been held back for long enough. To be called now and then.
    void on_time(Instant now);
    /// Says all that is held back still: the program ends.
    void end(Instant now) { on_time(now + RepeatedLines::kQuiet); }

private:
    RepeatedLines lines_;
};

} // namespace dpslave::app
