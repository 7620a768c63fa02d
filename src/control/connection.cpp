// SPDX-License-Identifier: Apache-2.0
#include "connection.hpp"

#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace dpslave::control {

void Connection::receive()
{
    std::array<char, 16 * 1024> chunk;
    while (!dead_ && !ended_ && in.room() > 0) {
        const auto got = ::recv(fd(), chunk.data(), std::min(chunk.size(), in.room()), MSG_DONTWAIT);
        if (got > 0) {
            in.feed({chunk.data(), static_cast<std::size_t>(got)});
        } else if (got == 0) {
            ended_ = true;
        } else if (errno != EINTR) {
            if (errno != EAGAIN) dead_ = true;
            return;
        }
    }
}

void Connection::flush()
{
    std::size_t sent = 0;
    while (!dead_ && sent < out_.size()) {
        const auto n = ::send(fd(), out_.data() + sent, out_.size() - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (n >= 0) {
            sent += static_cast<std::size_t>(n);
        } else if (errno != EINTR) {
            if (errno != EAGAIN) dead_ = true;
            break;
        }
    }
    out_.erase(0, sent);
    if (out_.empty()) drop_output(); // all memory is locked: a large reply does not keep its room
}

void Connection::cut()
{
    kill();
    drop_output();
    ::shutdown(fd(), SHUT_RDWR);
}

bool Connection::send(std::string_view message, std::size_t limit)
{
    if (message.size() > limit - std::min(limit, out_.size())) return false;
    out_.append(message);
    flush();
    return true;
}

std::uint32_t Connection::wanted_events() const noexcept
{
    std::uint32_t events = 0; // EPOLLHUP and EPOLLERR come unasked
    if (!out_.empty()) events |= EPOLLOUT;
    // A call is in the buffer already: its turn comes as soon as a reply to it could be sent.
    if (idle() && holds_calls) events |= EPOLLOUT;
    if (idle() && !holds_calls && !ended_) events |= EPOLLIN;
    return events;
}

} // namespace dpslave::control
