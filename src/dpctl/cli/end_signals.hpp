// SPDX-License-Identifier: Apache-2.0
/// SIGINT or SIGTERM: the end of a command that runs on.
#pragma once

#include <csignal>

namespace dpslave::dpctl {

/// SIGINT and SIGTERM as a descriptor: the end is something to read, and no moment is lost before the wait.
class EndSignals {
public:
    EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;
    ~EndSignals();

    int fd() const { return fd_; } ///< readable as soon as one has come
    /// Waits at most this long. True: one has come.
    bool within(int milliseconds) const;

private:
    sigset_t before_{};
    int fd_ = -1;
};

} // namespace dpslave::dpctl
