// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/log_stream.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <string>

namespace dpslave::io {
namespace {

/// A terminal that says that it can be written may have room for one octet, and makes the writer wait for the
/// room of the others. Nothing: `fd` is no terminal, or this user may not open it.
Fd terminal_behind(int fd)
{
    if (::isatty(fd) == 0) return Fd{};
    const std::string path = "/proc/self/fd/" + std::to_string(fd);
    return Fd{::open(path.c_str(), O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
}

} // namespace

LogStream::LogStream(int fd) : own_(terminal_behind(fd)), fd_(own_ ? own_.get() : fd) {}

/// A pipe that can be written takes PIPE_BUF octets without a wait (pipe(7)).
std::size_t LogStream::put(std::string_view text)
{
    std::size_t taken = 0;
    while (taken < text.size()) {
        pollfd there{.fd = fd_, .events = POLLOUT, .revents = 0};
        if (::poll(&there, 1, 0) != 1 || (there.revents & POLLOUT) == 0) break;
        const ssize_t written =
            ::write(fd_, text.data() + taken, std::min<std::size_t>(text.size() - taken, PIPE_BUF));
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) break;
        taken += static_cast<std::size_t>(written);
    }
    return taken;
}

} // namespace dpslave::io
