// SPDX-License-Identifier: Apache-2.0
// Preloaded into the daemon: a call of a tty does not come back while a file is there, as a USB control
// transfer that is not answered. The environment says which: STALLED_PORT the tty (a symbolic link),
// STALLED_CALL the call (open, close, read, write, ioctl), STALLED_WHILE the file. STALLED_NOTE is a file
// that the call makes when it begins to wait. STALLED_CALL log: the write of the log, as on a disk that does
// not answer.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <climits>
#include <cstdarg>
#include <cstdlib>
#include <cstring>

#define EXPORTED extern "C" __attribute__((visibility("default")))

namespace {

template <class Function>
Function* next(const char* name)
{
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_there(const char* file)
{
    return file != nullptr && ::access(file, F_OK) == 0;
}

/// Is it the tty, by whatever name?
bool is_port(const char* path)
{
    const char* const port = std::getenv("STALLED_PORT");
    char wanted[PATH_MAX], given[PATH_MAX];
    return port != nullptr && path != nullptr && ::realpath(port, wanted) != nullptr &&
           ::realpath(path, given) != nullptr && std::strcmp(given, wanted) == 0;
}

bool is_port(int fd)
{
    if (fd == STDERR_FILENO) return true; // of the call "log"
    if (fd < 0) return false;
    char name[64];
    return ::ttyname_r(fd, name, sizeof name) == 0 && is_port(name);
}

template <class Port>
void stall(const char* call, Port port)
{
    const char* const wanted = std::getenv("STALLED_CALL");
    const char* const file = std::getenv("STALLED_WHILE");
    if (wanted == nullptr || std::strcmp(call, wanted) != 0 || !is_there(file) || !is_port(port)) return;
    if (const char* const note = std::getenv("STALLED_NOTE"))
        next<int(int)>("close")(::creat(note, 0600)); // not by open() and close(): they may be the call
    while (is_there(file)) ::usleep(5'000);
}

} // namespace

EXPORTED ssize_t write(int fd, const void* octets, size_t count)
{
    static auto* const real = next<ssize_t(int, const void*, size_t)>("write");
    stall(fd == STDERR_FILENO ? "log" : "write", fd);
    return real(fd, octets, count);
}

EXPORTED ssize_t read(int fd, void* octets, size_t count)
{
    static auto* const real = next<ssize_t(int, void*, size_t)>("read");
    stall("read", fd);
    return real(fd, octets, count);
}

EXPORTED int close(int fd)
{
    static auto* const real = next<int(int)>("close");
    stall("close", fd);
    return real(fd);
}

EXPORTED int open(const char* path, int flags, ...)
{
    static auto* const real = next<int(const char*, int, ...)>("open");
    std::va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    stall("open", path);
    return real(path, flags, mode);
}

/// What open() is where the compiler checks its arguments.
EXPORTED int __open_2(const char* path, int flags)
{
    static auto* const real = next<int(const char*, int)>("__open_2");
    stall("open", path);
    return real(path, flags);
}

EXPORTED int ioctl(int fd, unsigned long request, ...)
{
    static auto* const real = next<int(int, unsigned long, ...)>("ioctl");
    std::va_list more;
    va_start(more, request);
    void* const argument = va_arg(more, void*);
    va_end(more);
    if (request != TIOCGWINSZ && request != TCGETS && fd != STDERR_FILENO) stall("ioctl", fd);
    return real(fd, request, argument);
}
