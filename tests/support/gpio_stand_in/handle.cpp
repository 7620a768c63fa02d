// SPDX-License-Identifier: Apache-2.0
#include "handle.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <ctime>
#include <new>

namespace dpslave::stand_in {
namespace {

std::int64_t now()
{
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

bool lock(int fd, unsigned line, short type)
{
    struct flock lock {};
    lock.l_type = type;
    lock.l_whence = SEEK_SET;
    lock.l_start = kLocks + line;
    lock.l_len = 1;
    return ::fcntl(fd, F_OFD_SETLK, &lock) == 0;
}

bool is_active(const Line& line)
{
    return (line.level.high != 0) != (line.active_low != 0);
}

/// The last chip in which a line was taken: does it watch a port?
std::atomic<Chip*> watched{nullptr};

bool is_watched_port(const Chip& chip, int fd)
{
    struct stat port {};
    struct stat there {};
    return chip.watch.port[0] != '\0' && ::stat(chip.watch.port.data(), &port) == 0 &&
           S_ISCHR(port.st_mode) && ::fstat(fd, &there) == 0 && port.st_rdev == there.st_rdev;
}

void note_write(Chip& chip, std::size_t octets)
{
    Watch& watch = chip.watch;
    ++watch.writes;
    if (!is_active(chip.line[watch.line])) ++watch.writes_while_inactive;
    watch.octets = static_cast<std::uint32_t>(octets);
    watch.written_at = now();
}

void note_release(Watch& watch)
{
    const std::int64_t written_at = watch.written_at.exchange(0);
    if (written_at == 0) return;
    const std::int64_t character = std::int64_t{11'000'000'000} / watch.baud;
    const std::int64_t late = now() - written_at - watch.octets * character;
    ++watch.releases;
    if (late < 0) ++watch.releases_early;
    if (late >= 0 && late <= character) ++watch.releases_in_time;
}

} // namespace

Handle::Handle(int fd, Chip* chip) noexcept : fd_(fd), chip_(chip), generation_(chip->generation) {}

Handle* Handle::open(const char* path) noexcept
{
    const int fd = ::open(path, O_RDWR | O_CLOEXEC);
    if (fd < 0) return nullptr;
    struct stat file {};
    void* place = MAP_FAILED;
    int error = ENOTTY;
    if (::fstat(fd, &file) == 0 && S_ISREG(file.st_mode) && file.st_size >= static_cast<off_t>(sizeof(Chip)))
        place = ::mmap(nullptr, sizeof(Chip), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (place != MAP_FAILED) {
        Chip* const chip = static_cast<Chip*>(place);
        if (chip->magic == kMagic && chip->gone == 0)
            if (auto* const handle = new (std::nothrow) Handle{fd, chip}) return handle;
        if (chip->magic == kMagic && chip->gone != 0) error = ENOENT;
        ::munmap(place, sizeof(Chip));
    }
    ::close(fd);
    errno = error;
    return nullptr;
}

Handle* Handle::again() const noexcept
{
    const int fd = ::fcntl(fd_, F_DUPFD_CLOEXEC, 0);
    void* const place = ::mmap(nullptr, sizeof(Chip), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    return fd < 0 || place == MAP_FAILED ? nullptr : new (std::nothrow) Handle{fd, static_cast<Chip*>(place)};
}

Handle::~Handle()
{
    ::close(fd_); // the mapping stays: another thread may be in write() and look at it
}

bool Handle::take(unsigned line, bool active_low, const char* consumer, bool active) noexcept
{
    if (line >= chip_->lines) {
        errno = EINVAL;
        return false;
    }
    if (!lock(fd_, line, F_WRLCK)) {
        errno = EBUSY;
        return false;
    }
    Line& one = chip_->line[line];
    one.active_low = active_low ? 1 : 0;
    ++one.requests;
    one.consumer.fill('\0');
    std::strncpy(one.consumer.data(), consumer, one.consumer.size() - 1);
    watched = chip_;
    return pin(line, active != active_low);
}

bool Handle::set(unsigned line, bool active) noexcept
{
    return pin(line, active != (chip_->line[line].active_low != 0));
}

void Handle::give_back(unsigned line) noexcept
{
    chip_->line[line].consumer.fill('\0');
    lock(fd_, line, F_UNLCK);
}

bool Handle::pin(unsigned line, bool high) noexcept
{
    if (chip_->gone != 0 || chip_->generation != generation_) {
        errno = ENODEV;
        return false;
    }
    if (chip_->edge_us != 0) ::usleep(chip_->edge_us);
    Line& one = chip_->line[line];
    const bool was = one.level.high != 0;
    const std::uint32_t level[3]{high ? 1U : 0U, one.level.rises + (high && !was ? 1U : 0U),
                                 one.level.falls + (!high && was ? 1U : 0U)};
    static_assert(sizeof level == sizeof(Level));
    const auto place = reinterpret_cast<const char*>(&one.level) - reinterpret_cast<const char*>(chip_);
    ++one.edges;
    if (::pwrite(fd_, level, sizeof level, place) != static_cast<ssize_t>(sizeof level)) return false;
    if (line == chip_->watch.line && !is_active(one)) note_release(chip_->watch);
    return true;
}

} // namespace dpslave::stand_in

/// The port's write(2) goes through here, to see whether the line was active by then. Any other one just
/// passes.
extern "C" [[gnu::visibility("default")]] ssize_t write(int fd, const void* octets, size_t count)
{
    using Write = ssize_t (*)(int, const void*, size_t);
    static const Write next = reinterpret_cast<Write>(::dlsym(RTLD_NEXT, "write"));
    dpslave::stand_in::Chip* const chip = dpslave::stand_in::watched;
    if (chip != nullptr && dpslave::stand_in::is_watched_port(*chip, fd))
        dpslave::stand_in::note_write(*chip, count);
    return next(fd, octets, count);
}
