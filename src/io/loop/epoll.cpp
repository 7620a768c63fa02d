// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/epoll.hpp"

#include "timespec.hpp"

#include <cerrno>
#include <system_error>

namespace dpslave::io {

Epoll::Epoll() : fd_(::epoll_create1(EPOLL_CLOEXEC))
{
    if (!fd_) throw std::system_error{errno, std::system_category(), "epoll_create1"};
    epoll_event event{};
    wait({&event, 1},
         {}); // a kernel or a sandbox without epoll_pwait2 says so now and not in the middle of service
}

void Epoll::add(int fd, std::uint32_t events, std::uint64_t key)
{
    control(EPOLL_CTL_ADD, fd, events, key);
}

void Epoll::remove(int fd)
{
    control(EPOLL_CTL_DEL, fd, 0, 0);
}

void Epoll::control(int operation, int fd, std::uint32_t events, std::uint64_t key)
{
    epoll_event event{};
    event.events = events;
    event.data.u64 = key;
    if (::epoll_ctl(fd_.get(), operation, fd, &event) < 0)
        throw std::system_error{errno, std::system_category(), "epoll_ctl"};
}

std::span<epoll_event> Epoll::wait(std::span<epoll_event> events, std::chrono::nanoseconds timeout)
{
    const timespec limit = to_timespec(timeout);
    const bool for_ever = timeout == std::chrono::nanoseconds::max();
    const int ready = ::epoll_pwait2(fd_.get(), events.data(), static_cast<int>(events.size()),
                                     for_ever ? nullptr : &limit, nullptr);
    if (ready >= 0) return events.first(static_cast<std::size_t>(ready));
    if (errno != EINTR) throw std::system_error{errno, std::system_category(), "epoll_pwait2"};
    return {};
}

} // namespace dpslave::io
