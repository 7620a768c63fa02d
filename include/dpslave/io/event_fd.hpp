// SPDX-License-Identifier: Apache-2.0
/// A signal from any thread to one that waits in epoll (eventfd(2)).
#pragma once

#include "dpslave/io/fd.hpp"

namespace dpslave::io {

class EventFd {
public:
    /// Throws std::system_error when the system has no descriptor left.
    EventFd();
    int fd() const { return fd_.get(); } ///< readable from ring() to clear()

    /// Any thread may call it; it never waits. Two calls before clear() count as one.
    void ring() noexcept;
    void clear() noexcept;

private:
    Fd fd_;
};

} // namespace dpslave::io
