// SPDX-License-Identifier: Apache-2.0
// Stands before read(2) and write(2) of the daemon (LD_PRELOAD). It shares nothing with the program that it
// judges: not its clock reading, not its arithmetic of windows.
#include "record.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace dpslave::reply_watch {
namespace {

Record* record_of_this_process()
{
    const char* const path = std::getenv(kVariable);
    const int fd = path != nullptr ? ::open(path, O_RDWR | O_CLOEXEC) : -1;
    if (fd < 0) return nullptr;
    void* const place = ::mmap(nullptr, sizeof(Record), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    ::close(fd);
    return place != MAP_FAILED ? static_cast<Record*>(place) : nullptr;
}

Record* const record = record_of_this_process();

bool is_port(int fd)
{
    struct stat port {};
    struct stat there {};
    return ::fstat(fd, &there) == 0 && S_ISCHR(there.st_mode) && ::stat(record->port.data(), &port) == 0 &&
           port.st_rdev == there.st_rdev;
}

std::int64_t now()
{
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
}

void note_reply()
{
    const std::int64_t took = now() - record->read_at;
    ++record->replies;
    if (took > record->window) ++record->late;
    if (took > record->slowest) record->slowest = took;
}

} // namespace
} // namespace dpslave::reply_watch

namespace watch = dpslave::reply_watch;

extern "C" [[gnu::visibility("default")]] ssize_t read(int fd, void* octets, size_t count)
{
    using Read = ssize_t (*)(int, void*, size_t);
    static const Read next = reinterpret_cast<Read>(::dlsym(RTLD_NEXT, "read"));
    const ssize_t got = next(fd, octets, count);
    if (got > 0 && watch::record != nullptr && watch::is_port(fd)) watch::record->read_at = watch::now();
    return got;
}

extern "C" [[gnu::visibility("default")]] ssize_t write(int fd, const void* octets, size_t count)
{
    using Write = ssize_t (*)(int, const void*, size_t);
    static const Write next = reinterpret_cast<Write>(::dlsym(RTLD_NEXT, "write"));
    if (watch::record != nullptr && watch::is_port(fd)) watch::note_reply();
    return next(fd, octets, count);
}
