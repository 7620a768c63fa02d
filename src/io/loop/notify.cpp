// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/notify.hpp"

#include "dpslave/io/fd.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <utility>

namespace dpslave::io {
namespace {

constexpr std::string_view kStatus = "STATUS=";

/// STATUS= is one line of a list of assignments: a line break would begin the next one.
std::string status_line(std::string_view text)
{
    std::string line{kStatus};
    line += text;
    std::replace(line.begin(), line.end(), '\n', ' ');
    return line;
}

/// One datagram. sd_notify(3) would wait until the manager has read what fills its socket. False: it is full
/// now. Any other error is none: without a service manager there is nothing to notify.
bool send(const std::string& state)
{
    const char* const path = std::getenv("NOTIFY_SOCKET");
    if (path == nullptr) return true;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string_view name = path;
    if (name.empty() || name.size() >= sizeof address.sun_path) return true;
    name.copy(address.sun_path, name.size());
    if (name.front() == '@') address.sun_path[0] = '\0'; // an abstract name
    const Fd socket{::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
    if (!socket) return true;
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    return ::sendto(socket.get(), state.data(), state.size(), MSG_NOSIGNAL,
                    reinterpret_cast<const sockaddr*>(&address), length) >= 0 ||
           errno != EAGAIN;
}

} // namespace

void Notifier::tell(std::string state)
{
    constexpr std::size_t kMost = 16; // a manager that has read nothing for so long needs the newest only
    send_rest();
    if (unsent_.empty() && send(state)) return;
    const bool is_newer_status =
        state.starts_with(kStatus) && !unsent_.empty() && unsent_.back().starts_with(kStatus);
    if (is_newer_status || unsent_.size() == kMost)
        unsent_.erase(is_newer_status ? unsent_.end() - 1 : unsent_.begin());
    unsent_.push_back(std::move(state));
}
void Notifier::send_rest()
{
    while (!unsent_.empty() && send(unsent_.front())) unsent_.erase(unsent_.begin());
}

void Notifier::ready(std::string_view status)
{
    tell("READY=1\n" + status_line(status));
}
void Notifier::reloading(Instant now)
{
    const auto at = std::chrono::duration_cast<std::chrono::microseconds>(now.time_since_epoch()).count();
    tell("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(at));
}
void Notifier::status(std::string_view text)
{
    tell(status_line(text));
}
void Notifier::watchdog()
{
    send_rest();
    if (unsent_.empty()) static_cast<void>(send("WATCHDOG=1"));
}
void Notifier::stopping()
{
    tell("STOPPING=1");
}

std::optional<std::chrono::microseconds> Notifier::watchdog_interval() const
{
    std::uint64_t interval = 0;
    if (::sd_watchdog_enabled(0, &interval) <= 0) return std::nullopt;
    return std::chrono::microseconds{interval};
}

} // namespace dpslave::io
