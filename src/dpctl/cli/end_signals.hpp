// SPDX-License-Identifier: Apache-2.0
/// The wish of a person that a command that runs on shall end.
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
