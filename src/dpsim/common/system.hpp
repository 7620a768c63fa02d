// SPDX-License-Identifier: Apache-2.0
/// All that the simulators ask of Linux: ttys, ptys, the clock, signals, lines of commands.
#pragma once

#include "telegram.hpp"

#include "dpslave/base/units.hpp"

#include <atomic>
#include <system_error>

namespace dpslave::sim {

/// A file descriptor that is closed with its owner.
class Fd {
public:
    Fd() = default;
    explicit Fd(int fd) : fd_(fd) {}
    Fd(Fd&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Fd& operator=(Fd&& other) noexcept;
    ~Fd();
    int get() const { return fd_; }

private:
    int fd_ = -1;
};

Instant monotonic_now();
/// Waits until `when` by the absolute clock; returns earlier if a signal comes.
void sleep_until(Instant when);
/// Makes the sleeps of the calling thread end as exactly as the hardware can (the default slack is 50 us),
/// and, if the user may, lets it go before other programs: a line that a compiler slows down proves nothing.
void be_prompt();

/// Character format of a tty. A pty takes only the speed.
enum class Format : std::uint8_t { bits8_even, bits7_even, bits8 }; ///< 8E1, 7E1, 8N1

/// Opens a tty raw, without echo, at any speed, reading without waiting; octets that waited in it are
/// dropped.
Result<Fd, std::string> open_tty(const std::string& path, std::uint32_t baud, Format format);

/// A new pty; `path` names its slave. One slave descriptor stays open: else closing the far end would be an
/// error here.
struct Pty {
    Fd master;
    Fd slave;
    std::string path;
};
Result<Pty, std::string> open_pty(std::uint32_t baud);
/// The rate that the slave's side is set to, bit/s; 0 = none.
std::uint32_t rate_of(const Pty& pty);
/// Drops what was not read at the slave's side.
void discard_unread(const Pty& pty);

/// Returns the octets that are there now; empty if there are none, nullopt if the other side is closed.
std::optional<Octets> read_some(int fd);
/// Writes all, waiting at most `longest` for space; how many octets went out.
std::size_t write_all(int fd, Bytes octets, std::chrono::milliseconds longest);

/// A symbolic link that is removed with its owner, unless it was replaced.
class Symlink {
public:
    /// Refuses a path that exists, unless it is a link to a pty, left by a run before.
    static Result<Symlink, std::string> make(const std::string& path, const std::string& target);
    Symlink(Symlink&& other) noexcept
        : path_(std::exchange(other.path_, {})), target_(std::move(other.target_))
    {}
    Symlink& operator=(Symlink&&) = delete;
    ~Symlink();

private:
    Symlink(std::string path, std::string target) : path_(std::move(path)), target_(std::move(target)) {}
    std::string path_, target_;
};

/// SIGINT, SIGTERM and SIGHUP become readable here; SIGPIPE and SIGTTIN are ignored. Make it before any
/// thread.
class Signals {
public:
    Signals();
    int fd() const { return fd_.get(); }

private:
    Fd fd_;
};

/// Lines from a descriptor, as they come.
class LineReader {
public:
    explicit LineReader(int fd) : fd_(fd) {}
    int fd() const { return open_ ? fd_ : -1; } ///< -1 once it has ended: poll() ignores it
    bool ended() const { return !open_; }       ///< no more lines will come
    /// Ended by Ctrl-D or at the end of the file, not because this program runs in the background.
    bool closed() const { return closed_; }
    void read(); ///< call when poll() says so
    std::optional<std::string> take();

private:
    int fd_;
    bool open_ = true, closed_ = false;
    std::string buffer_;
};

/// Waits until one of `fds` (-1 = none) is readable or `deadline` has come.
void wait_readable(std::initializer_list<int> fds, Instant deadline);
bool readable(int fd);

/// One line to standard output, at once.
void print_line(const std::string& line);
/// "dpsim: ..." to standard error.
void print_error(const std::string& sentence);

} // namespace dpslave::sim
