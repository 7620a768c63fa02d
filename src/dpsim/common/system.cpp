// SPDX-License-Identifier: Apache-2.0
#include "system.hpp"

#include <asm/termbits.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace dpslave::sim {
namespace {

std::string why()
{
    return std::system_category().message(errno);
}

timespec to_timespec(std::chrono::nanoseconds t)
{
    return {static_cast<time_t>(t.count() / 1'000'000'000), static_cast<long>(t.count() % 1'000'000'000)};
}

bool make_raw(int fd, std::uint32_t baud, Format format)
{
    termios2 t{};
    t.c_iflag = INPCK; // a character with wrong parity is read as NUL and spoils its message
    t.c_cflag = BOTHER | CREAD | CLOCAL | (format == Format::bits8 ? 0U : PARENB) |
                (format == Format::bits7_even ? CS7 : CS8);
    t.c_ispeed = t.c_ospeed = baud;
    t.c_cc[VMIN] = 1; // without octets read() says EAGAIN, so that 0 means that the line is closed
    return ::ioctl(fd, TCSETSF2, &t) == 0;
}

} // namespace

Fd& Fd::operator=(Fd&& other) noexcept
{
    std::swap(fd_, other.fd_);
    return *this;
}

Fd::~Fd()
{
    if (fd_ >= 0) ::close(fd_);
}

Instant monotonic_now()
{
    timespec t{};
    ::clock_gettime(CLOCK_MONOTONIC, &t);
    return Instant{std::chrono::seconds{t.tv_sec} + std::chrono::nanoseconds{t.tv_nsec}};
}

void sleep_until(Instant when)
{
    const timespec t = to_timespec(when.time_since_epoch());
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
}

void be_prompt()
{
    ::prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
    ::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), -15);
}

Result<Fd, std::string> open_tty(const std::string& path, std::uint32_t baud, Format format)
{
    Fd fd{::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    if (fd.get() < 0) return Failure{fmt::format("{} cannot be opened: {}", path, why())};
    if (!make_raw(fd.get(), baud, format))
        return Failure{fmt::format("{} is no tty that can run at {} bit/s: {}", path, baud, why())};
    return fd;
}

Result<Pty, std::string> open_pty(std::uint32_t baud)
{
    Pty pty;
    pty.master = Fd{::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    std::array<char, 128> name{};
    if (pty.master.get() < 0 || ::grantpt(pty.master.get()) != 0 || ::unlockpt(pty.master.get()) != 0 ||
        ::ptsname_r(pty.master.get(), name.data(), name.size()) != 0)
        return Failure{fmt::format("no pty can be made: {}", why())};
    pty.path = name.data();
    auto slave = open_tty(pty.path, baud, Format::bits8_even);
    if (!slave) return Failure{slave.error()};
    pty.slave = std::move(*slave);
    return pty;
}

std::uint32_t rate_of(const Pty& pty)
{
    termios2 t{};
    return ::ioctl(pty.master.get(), TCGETS2, &t) == 0 ? t.c_ospeed : 0;
}

void discard_unread(const Pty& pty)
{
    ::ioctl(pty.slave.get(), TCFLSH, TCIFLUSH);
}

std::optional<Octets> read_some(int fd)
{
    std::array<std::uint8_t, 4096> buffer{};
    const ssize_t got = ::read(fd, buffer.data(), buffer.size());
    if (got > 0) return Octets(buffer.begin(), buffer.begin() + got);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return Octets{};
    return std::nullopt;
}

std::size_t write_all(int fd, Bytes octets, std::chrono::milliseconds longest)
{
    std::size_t done = 0;
    while (done < octets.size()) {
        const ssize_t put = ::write(fd, octets.data() + done, octets.size() - done);
        if (put > 0) {
            done += static_cast<std::size_t>(put);
            continue;
        }
        if (errno == EINTR) continue;
        pollfd space{fd, POLLOUT, 0};
        if (errno != EAGAIN || ::poll(&space, 1, static_cast<int>(longest.count())) != 1) break;
    }
    return done;
}

Result<Symlink, std::string> Symlink::make(const std::string& path, const std::string& target)
{
    struct stat there {};
    if (::lstat(path.c_str(), &there) == 0) {
        std::array<char, 256> old{};
        const bool link = S_ISLNK(there.st_mode) && ::readlink(path.c_str(), old.data(), old.size() - 1) > 0;
        if (!link || !std::string_view{old.data()}.starts_with("/dev/pts/"))
            return Failure{fmt::format(
                "{} exists and is no link of a simulated line: remove it, or choose another path", path)};
        ::unlink(path.c_str());
    }
    if (::symlink(target.c_str(), path.c_str()) != 0)
        return Failure{fmt::format("{} cannot be made: {}", path, why())};
    return Symlink{path, target};
}

Symlink::~Symlink()
{
    if (path_.empty()) return;
    std::array<char, 256> now{};
    if (::readlink(path_.c_str(), now.data(), now.size() - 1) > 0 && target_ == now.data())
        ::unlink(path_.c_str());
}

Signals::Signals()
{
    sigset_t ends;
    ::sigemptyset(&ends);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ends, signal);
    ::sigprocmask(SIG_BLOCK, &ends, nullptr);
    for (const int signal : {SIGPIPE, SIGTTIN}) std::signal(signal, SIG_IGN);
    fd_ = Fd{::signalfd(-1, &ends, SFD_CLOEXEC | SFD_NONBLOCK)};
}

void LineReader::read()
{
    std::array<char, 1024> part{};
    const ssize_t got = ::read(fd_, part.data(), part.size());
    if (got > 0) {
        buffer_.append(part.data(), static_cast<std::size_t>(got));
    } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        open_ = false;
        closed_ = got == 0;
        if (!buffer_.empty() && buffer_.back() != '\n') buffer_ += '\n';
    }
}

std::optional<std::string> LineReader::take()
{
    const auto end = buffer_.find('\n');
    if (end == std::string::npos) return std::nullopt;
    std::string line = buffer_.substr(0, end);
    buffer_.erase(0, end + 1);
    return line;
}

void wait_readable(std::initializer_list<int> fds, Instant deadline)
{
    std::array<pollfd, 8> polled{};
    std::size_t count = 0;
    for (const int fd : fds) polled[count++] = {fd, POLLIN, 0};
    const timespec wait = to_timespec(std::max(deadline - monotonic_now(), std::chrono::nanoseconds{0}));
    ::ppoll(polled.data(), count, deadline == kNever ? nullptr : &wait, nullptr);
}

bool readable(int fd)
{
    pollfd one{fd, POLLIN, 0};
    return fd >= 0 && ::poll(&one, 1, 0) == 1;
}

void print_line(const std::string& line)
{
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fputc('\n', stdout);
    std::fflush(stdout);
}

void print_error(const std::string& sentence)
{
    fmt::print(stderr, "dpsim: {}\n", sentence);
}

} // namespace dpslave::sim
