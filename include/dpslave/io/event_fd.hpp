// SPDX-License-Identifier: Apache-2.0
/// A bell between threads: rung in one, seen by epoll in the other.
#pragma once

#include "dpslave/io/fd.hpp"

namespace dpslave::io {

class EventFd {
public:
    /// Throws std::system_error when the system has no descriptor left.
    EventFd();
    int fd() const { return fd_.get(); } ///< readable from ring() to clear()

    /// From any thread; never waits. Rung twice before it is cleared is rung once.
    void ring() noexcept;
    void clear() noexcept;

private:
    Fd fd_;
};

} // namespace dpslave::io
