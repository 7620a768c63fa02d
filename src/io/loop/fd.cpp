// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/fd.hpp"

#include <unistd.h>

#include <cerrno>

namespace dpslave::io {

void Fd::reset() noexcept
{
    if (fd_ < 0) return;
    const int saved = errno;
    ::close(std::exchange(fd_, -1)); // EINTR too leaves the descriptor closed on Linux: never repeated
    errno = saved;
}

} // namespace dpslave::io
