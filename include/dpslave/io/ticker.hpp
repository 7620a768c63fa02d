// SPDX-License-Identifier: Apache-2.0
/// A periodic timer for an epoll. A loop which waits thousands of times a second for octets need not arm
/// and cancel a timer each time.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/io/fd.hpp"

#include <chrono>

namespace dpslave::io {

class Ticker {
public:
    /// Throws std::system_error when the system has no timer left.
    explicit Ticker(std::chrono::nanoseconds period);
    int fd() const { return fd_.get(); } ///< readable after each period until clear()

    /// To be called after each tick: the next one comes only then. How long ago the first one since the last
    /// call was due: so long may the caller have stood still. 0: none was.
    std::chrono::nanoseconds clear(Instant now) noexcept;

private:
    Fd fd_;
    std::chrono::nanoseconds period_;
    Instant due_; ///< of the next tick
};

} // namespace dpslave::io
