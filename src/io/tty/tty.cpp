// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/tty.hpp"

#include "io/loop/timespec.hpp"
#include "kept_settings.hpp"
#include "parity_marks.hpp"
#include "tty_settings.hpp"
#include "uart.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <thread>

namespace dpslave::io {
namespace {

std::error_code last_error()
{
    return {errno, std::system_category()};
}

/// Waits for `events` or a hang-up. False too where the thread has stalled, or its waits have ended.
bool wait_for(int fd, short events, std::chrono::nanoseconds timeout)
{
    constexpr std::chrono::hours kLongest{24 * 365};
    const Instant end = monotonic_now() + std::min<std::chrono::nanoseconds>(timeout, kLongest);
    pollfd waiting{.fd = fd, .events = events, .revents = 0};
    for (;;) {
        const Instant until = std::min(end, waits_of_this_thread_end());
        const timespec limit = to_timespec(std::clamp<std::chrono::nanoseconds>(
            until - monotonic_now(), std::chrono::nanoseconds{0}, ThreadSign::kSlice));
        const bool is_ready = ::ppoll(&waiting, 1, &limit, nullptr) > 0;
        give_sign();
        if (this_thread_stalled()) return false;
        if (is_ready || monotonic_now() >= until) return is_ready;
    }
}

std::string why_not_opened(const std::string& path, int error)
{
    switch (error) {
        case ENOENT:
        case ENOTDIR:
            return path + " is not there: check `port` in the configuration, and the cable of a USB adapter";
        case EACCES:
        case EPERM:
            return path +
                   ": this user may not open it: add the user to the group that owns the device (dialout on Debian)";
        case EBUSY:
        case EWOULDBLOCK:
            return path + " is used by another program: stop that one first (`fuser " + path +
                   "` shows which it is)";
        case ENXIO:
        case ENODEV:
        case EIO:
            return path +
                   ": there is no device behind it: check `port` in the configuration, and that the UART is there";
        default:
            return path + " cannot be opened (" + std::system_category().message(error) +
                   "): check `port` in the configuration";
    }
}

std::string no_serial_port(const std::string& path)
{
    return path + " is no serial port (no tty): check `port` in the configuration";
}

} // namespace

std::optional<std::string> port_trouble(const std::string& path)
{
    struct stat what {};
    if (::stat(path.c_str(), &what) < 0) return why_not_opened(path, errno);
    if (S_ISREG(what.st_mode)) return no_serial_port(path);
    if (::access(path.c_str(), R_OK | W_OK) < 0) return why_not_opened(path, errno);
    return std::nullopt;
}

namespace {

/// No other program reads these octets or writes between them. The lock ends with its owner, however that
/// ends. The exclusive mode of the tty refuses programs that use no locks, but root ignores it, and on
/// a pty it stays after its owner as long as the other end is open: there only the lock is used.
int claim(int fd, bool pty)
{
    if (::flock(fd, LOCK_EX | LOCK_NB) < 0) return errno;
    if (pty) return 0;
    int exclusive = 0;
    if (::ioctl(fd, TIOCGEXCL, &exclusive) == 0 && exclusive != 0) return EBUSY;
    return ::ioctl(fd, TIOCEXCL) < 0 ? errno : 0;
}

} // namespace

struct Tty::Marked {
    std::array<std::uint8_t, 1024> raw{};
    std::size_t begin = 0;
    std::size_t end = 0;
    bool filled = false; // there may be more where they came from
    ParityMarks marks;
};

Tty::Tty(Fd fd, const TtySettings& settings, std::unique_ptr<Uart> uart)
    : fd_(std::move(fd)),
      settings_(settings),
      uart_(std::move(uart)),
      kept_(std::make_unique<KeptSettings>()),
      character_(character_time(settings)),
      marked_(settings.mark_errors ? std::make_unique<Marked>() : nullptr)
{
    kept_->note(fd_.get());
}

Tty::Tty(Tty&&) noexcept = default;
Tty& Tty::operator=(Tty&&) noexcept = default;
Tty::~Tty()
{
    if (!fd_) return;
    const InCall close{PortCall::close};
    // Else the port stays exclusive as long as another program has it open, and cannot be opened again.
    if (!uart_->pty) ::ioctl(fd_.get(), TIOCNXCL);
    fd_.reset();
}

Result<Tty, std::string> Tty::open(const std::string& path, const TtySettings& settings,
                                   const std::filesystem::path& sysfs)
{
    const InCall open{PortCall::open};
    const int mode = settings.receive_only ? O_RDONLY : O_RDWR;
    Fd fd{::open(path.c_str(), mode | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    if (!fd) return Failure{why_not_opened(path, errno)};
    if (::isatty(fd.get()) == 0) return Failure{no_serial_port(path)};
    auto uart = std::make_unique<Uart>(look_at(fd.get(), sysfs));
    if (const int error = claim(fd.get(), uart->pty); error != 0) return Failure{why_not_opened(path, error)};
    if (const std::string trouble = apply(fd.get(), settings, *uart); !trouble.empty())
        return Failure{path + ": " + trouble};
    Tty tty{std::move(fd), settings, std::move(uart)};
    if (settings.prompt) tty.warnings_ = set_prompt(*tty.uart_);
    note_triggers(*tty.uart_);
    return tty;
}

bool Tty::is_pty() const
{
    return uart_->pty;
}

std::chrono::nanoseconds Tty::hold_back() const
{
    return io::hold_back(*uart_, std::chrono::nanoseconds{std::nano::den / std::max(settings_.baud, 1U)});
}

std::optional<std::string> Tty::set_baud(std::uint32_t baud)
{
    std::string trouble = change_rate(fd(), baud, *uart_);
    kept_->note(fd());
    if (!trouble.empty()) return trouble;
    settings_.baud = baud;
    character_ = character_time(settings_);
    std::this_thread::sleep_for(2 * character_);
    static_cast<void>(discard_input()); // a port that has gone meanwhile says so when it is read
    return std::nullopt;
}

TtyBauds Tty::bauds()
{
    TtyBauds found;
    std::string missing;
    for (const Baud baud : kBauds) {
        const auto rate = static_cast<std::uint32_t>(baud);
        if (change_rate(fd(), rate, *uart_).empty())
            found.can.set(index_of(baud));
        else if (baud != Baud::k45_45)
            missing += (missing.empty() ? "" : ", ") + std::to_string(rate);
    }
    static_cast<void>(change_rate(fd(), settings_.baud, *uart_)); // it was possible before
    kept_->note(fd());
    static_cast<void>(discard_input());
    if (!missing.empty())
        found.why_not =
            "this UART cannot do " + missing + " bit/s, which are not searched: " + rate_remedy(*uart_);
    return found;
}

void Tty::keep_rs485_mode() const noexcept
{
    kept_->note_rs485(fd());
}

std::optional<ChangedSettings> Tty::changed_settings() const noexcept
{
    const InCall look{PortCall::set};
    return kept_->changed(fd());
}

std::error_code Tty::set_again(const ChangedSettings& changed) noexcept
{
    const InCall set{PortCall::set};
    if (const auto error = kept_->set_again(fd(), settings_.baud)) return error;
    return changed.harms_octets ? discard_input() : std::error_code{};
}

/// Returns the number of octets that came. Reading with VMIN 0 gives 0 if nothing is there, and also if the
/// line was hung up.
Result<std::size_t, std::error_code> Tty::fetch(std::span<std::uint8_t> out)
{
    const ssize_t got = ::read(fd(), out.data(), out.size());
    if (got > 0) return static_cast<std::size_t>(got);
    if (got < 0 && errno != EAGAIN && errno != EINTR) return Failure{last_error()};
    if (got == 0 && hung_up()) return Failure{std::make_error_code(std::errc::io_error)};
    return std::size_t{0};
}

Result<Chunk, std::error_code> Tty::read(std::span<std::uint8_t> out)
{
    if (marked_) return read_marked(out);
    const auto got = fetch(out);
    if (!got) return Failure{got.error()};
    return Chunk{.octets = out.first(*got), .more = *got == out.size()};
}

Result<Chunk, std::error_code> Tty::read_marked(std::span<std::uint8_t> out)
{
    Marked& m = *marked_;
    if (m.begin == m.end) {
        m.filled = false;
        const auto got = fetch(m.raw);
        if (!got) return Failure{got.error()};
        if (*got == 0) return Chunk{};
        m.begin = 0;
        m.end = *got;
        m.filled = m.end == m.raw.size();
    }
    const auto step = m.marks.undo(Bytes{m.raw}.subspan(m.begin, m.end - m.begin), out);
    m.begin += step.used;
    return Chunk{.octets = out.first(step.octets),
                 .bad_character = step.bad_character,
                 .more = m.filled || m.begin != m.end};
}

std::error_code Tty::write(Bytes octets)
{
    const auto limit =
        2 * character_ * static_cast<std::int64_t>(octets.size()) + std::chrono::milliseconds{20};
    std::optional<Instant>
        give_up; // asked for only when the driver does not take all at once, which it nearly always does
    while (!octets.empty()) {
        const ssize_t taken = [&] {
            const InCall write{PortCall::write};
            return ::write(fd(), octets.data(), octets.size());
        }();
        if (taken < 0 && errno != EAGAIN && errno != EINTR) return last_error();
        if (taken > 0) octets = octets.subspan(static_cast<std::size_t>(taken));
        if (octets.empty()) break;

        const Instant now = monotonic_now();
        if (!give_up) give_up = now + limit;
        if (now >= *give_up) return std::make_error_code(std::errc::timed_out);
        wait_for(fd(), POLLOUT, *give_up - now);
        if (this_thread_stalled()) return std::make_error_code(std::errc::timed_out);
    }
    return {};
}

std::error_code Tty::send(Bytes telegram)
{
    const ssize_t taken = ::write(fd(), telegram.data(), telegram.size());
    if (taken == static_cast<ssize_t>(telegram.size())) return {};
    if (taken < 0 && errno != EAGAIN && errno != EINTR) return last_error();
    flush_output(fd());
    return std::make_error_code(std::errc::no_buffer_space);
}

bool Tty::discard_unsent()
{
    const InCall flush{PortCall::set};
    if (!has_unsent(fd())) return false;
    flush_output(fd());
    return true;
}

void Tty::discard_output()
{
    const InCall flush{PortCall::set};
    flush_output(fd());
}

std::error_code Tty::discard_input()
{
    const InCall flush{PortCall::set};
    if (marked_) {
        marked_->begin = marked_->end = 0;
        marked_->filled = false;
        marked_->marks.reset();
    }
    return flush_input(fd()) ? std::error_code{} : last_error();
}

bool Tty::wait_readable(std::chrono::nanoseconds timeout)
{
    if (marked_ && marked_->begin != marked_->end) return true;
    return wait_for(fd(), POLLIN, timeout);
}

std::optional<bool> Tty::transmitter_empty() const
{
    if (!reports_empty_) return std::nullopt;
    const auto empty = io::transmitter_empty(fd());
    if (!empty) reports_empty_ = errno != ENOTTY && errno != EINVAL && errno != EOPNOTSUPP;
    return empty;
}

bool Tty::hung_up() const
{
    pollfd asked{.fd = fd(), .events = 0, .revents = 0};
    return ::poll(&asked, 1, 0) > 0;
}

} // namespace dpslave::io
