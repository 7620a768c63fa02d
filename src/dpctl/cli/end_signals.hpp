// SPDX-License-Identifier: Apache-2.0
/// SIGINT, SIGTERM or SIGHUP (the terminal was closed): the end of a command that runs on.
#pragma once

#include <csignal>

namespace dpslave::dpctl {

/// All three as a descriptor: the end is something to read, and no moment is lost before the wait.
class EndSignals {
public:
    EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;
    ~EndSignals();

    int fd() const { return fd_; } ///< readable as soon as one has come

private:
    sigset_t before_{};
    int fd_ = -1;
};

/// Waits at most this long until `fd` is readable; -1 never is.
bool becomes_readable(int fd, int milliseconds);

} // namespace dpslave::dpctl
