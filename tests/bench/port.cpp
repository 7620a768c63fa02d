// SPDX-License-Identifier: Apache-2.0
#include "port.hpp"

#include "dpslave/io/clock.hpp"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace dpslave::bench {
namespace {

[[noreturn]] void fail(const char* what)
{
    throw std::system_error{errno, std::system_category(), what};
}

bool wait_readable(int fd, std::chrono::nanoseconds time)
{
    if (time.count() <= 0) return false;
    const timespec limit{.tv_sec = time.count() / 1'000'000'000, .tv_nsec = time.count() % 1'000'000'000};
    pollfd waiting{.fd = fd, .events = POLLIN, .revents = 0};
    return ::ppoll(&waiting, 1, &limit, nullptr) > 0;
}

} // namespace

Port::Port() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC))
{
    char name[64] = {};
    if (!master_ || ::grantpt(master_.get()) != 0 || ::unlockpt(master_.get()) != 0 ||
        ::ptsname_r(master_.get(), name, sizeof name) != 0)
        fail("pty");
    path_ = name;
    keeps_open_ = io::Fd{::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC)};
    termios settings{};
    if (!keeps_open_ || ::tcgetattr(keeps_open_.get(), &settings) != 0) fail(name);
    ::cfmakeraw(&settings); // before the responder opens it an echo would come back as an answer
    ::cfsetspeed(&settings, B1500000);
    if (::tcsetattr(keeps_open_.get(), TCSANOW, &settings) != 0) fail(name);
}

void Port::send(const Octets& telegram)
{
    if (::write(master_.get(), telegram.data(), telegram.size()) != static_cast<ssize_t>(telegram.size()))
        fail("write");
}

std::optional<Port::Answer> Port::exchange(const Octets& request, std::chrono::nanoseconds slot)
{
    const Instant start = io::monotonic_now();
    send(request);
    std::size_t have = 0;
    while (wait_readable(master_.get(), start + slot - io::monotonic_now())) {
        const ssize_t got = ::read(master_.get(), room_.data() + have, room_.size() - have);
        if (got <= 0) continue;
        have += static_cast<std::size_t>(got);
        const std::span<const std::uint8_t> frame = std::span{room_}.first(have);
        const std::size_t length = length_of(frame);
        if (length != 0 && have >= length) return Answer{.frame = frame, .time = io::monotonic_now() - start};
        if (have == room_.size()) break;
    }
    return std::nullopt;
}

void Port::drain()
{
    while (::read(master_.get(), room_.data(), room_.size()) > 0) {
    }
}

} // namespace dpslave::bench
