// SPDX-License-Identifier: Apache-2.0
/// The signals a daemon listens to, as a descriptor instead of handlers.
#pragma once

#include "dpslave/io/fd.hpp"

#include <optional>

namespace dpslave::io {

class Signals {
public:
    /// Blocks SIGTERM, SIGINT and SIGHUP in the calling thread and in every thread that it starts from now
    /// on: make it first of all. SIGPIPE is ignored: a peer that went away is an error of write(2), not the
    /// end. The signals stay blocked when this goes, so that a second SIGTERM does not cut the leaving short.
    /// Throws std::system_error when the system has no descriptor left.
    Signals();
    int fd() const { return fd_.get(); }

    /// The next signal that came (SIGTERM ...), if one did. It never waits.
    std::optional<int> take();

private:
    Fd fd_;
};

} // namespace dpslave::io
