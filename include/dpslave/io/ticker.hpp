// SPDX-License-Identifier: Apache-2.0
/// A periodic timer for an epoll. A loop which waits thousands of times a second for octets need not arm
/// and cancel a timer each time.
#pragma once

#include "dpslave/io/fd.hpp"

#include <chrono>
#include <cstdint>

namespace dpslave::io {

class Ticker {
public:
    /// Throws std::system_error when the system has no timer left.
    explicit Ticker(std::chrono::nanoseconds period);
    int fd() const { return fd_.get(); } ///< readable after each period until clear()

    /// Call it after each tick: the next one comes only then. Returns how many there were.
    std::uint64_t clear() noexcept;

private:
    Fd fd_;
};

} // namespace dpslave::io
