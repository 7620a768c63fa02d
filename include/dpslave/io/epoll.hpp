// SPDX-License-Identifier: Apache-2.0
/// Waits for several descriptors and a deadline with the resolution of a nanosecond.
#pragma once

#include "dpslave/io/fd.hpp"

#include <sys/epoll.h>

#include <chrono>
#include <cstdint>
#include <span>

namespace dpslave::io {

/// Errors here (a descriptor that cannot be waited for, none left) are faults of the program or
/// of the system: std::system_error.
class Epoll {
public:
    Epoll();
    int fd() const { return fd_.get(); }

    /// `key` comes back in epoll_event::data.u64. `events`: EPOLLIN ..., level-triggered unless EPOLLET is
    /// among them.
    void add(int fd, std::uint32_t events, std::uint64_t key);
    /// Call it before the descriptor is closed.
    void remove(int fd);

    /// Returns the events that are ready, at the beginning of `events` (which has at least one). It is empty
    /// if `timeout` is over, or a signal interrupted. A timeout of zero or less looks without waiting;
    /// nanoseconds::max() waits for ever.
    std::span<epoll_event> wait(std::span<epoll_event> events, std::chrono::nanoseconds timeout);

private:
    void control(int operation, int fd, std::uint32_t events, std::uint64_t key);
    Fd fd_;
};

} // namespace dpslave::io
