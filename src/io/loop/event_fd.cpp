// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/event_fd.hpp"

#include <sys/eventfd.h>

#include <cerrno>
#include <system_error>

namespace dpslave::io {

EventFd::EventFd() : fd_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC))
{
    if (!fd_) throw std::system_error{errno, std::system_category(), "eventfd"};
}

// Both can fail in one way only, EAGAIN: it is readable already, or is not readable. Either way all is as it
// should be.
void EventFd::ring() noexcept
{
    static_cast<void>(::eventfd_write(fd_.get(), 1));
}

void EventFd::clear() noexcept
{
    eventfd_t count = 0;
    static_cast<void>(::eventfd_read(fd_.get(), &count));
}

} // namespace dpslave::io
