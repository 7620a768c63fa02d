// SPDX-License-Identifier: Apache-2.0
/// Where a log is written: a pipe, the journal, a terminal. Others may share it, and may have stopped to read
/// it. Nobody waits for them.
#pragma once

#include "dpslave/io/fd.hpp"

#include <cstddef>
#include <string_view>

namespace dpslave::io {

class LogStream {
public:
    /// `fd` is not closed, and outlives this object. It stays blocking, for O_NONBLOCK would be that of the
    /// others too.
    explicit LogStream(int fd);
    /// Returns how many octets were taken; fewer than there are: there is no room now. A file on a disk that
    /// does not answer is waited for: Linux says of each file that it can be written.
    std::size_t put(std::string_view text);

private:
    Fd own_; ///< of a terminal: a description of its own, which does not block
    int fd_;
};

} // namespace dpslave::io
