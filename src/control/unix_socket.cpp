// SPDX-License-Identifier: Apache-2.0
#include "unix_socket.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace dpslave::control {
namespace {

/// A user with many connections at once does not fill it; net.core.somaxconn is above it since Linux 5.4.
constexpr int kBacklog = 1024;

bool make_address(const std::filesystem::path& path, sockaddr_un& address)
{
    address = {};
    address.sun_family = AF_UNIX;
    const std::string& text = path.native();
    if (text.empty() || text.size() >= sizeof address.sun_path) return false;
    std::memcpy(address.sun_path, text.data(), text.size());
    return true;
}

const sockaddr* generic(const sockaddr_un& address)
{
    const void* any = &address;
    return static_cast<const sockaddr*>(any);
}

/// Removes a socket at `path` on which no process answers. The reason of a failure is a sentence.
Result<bool, std::string> remove_stale(const std::filesystem::path& path)
{
    struct stat status {};
    if (::lstat(path.c_str(), &status) < 0) {
        if (errno == ENOENT) return true;
        return Failure{fmt::format("{}: {}", path.native(), error_text(errno))};
    }
    if (!S_ISSOCK(status.st_mode))
        return Failure{fmt::format("{}: exists and is not a socket; remove it or name another control.socket",
                                   path.native())};
    const auto answered = connect_to(path, std::chrono::milliseconds{200});
    if (answered || answered.error() == EAGAIN)
        return Failure{fmt::format("{}: another dpslaved is running and answers here", path.native())};
    if (answered.error() != ECONNREFUSED)
        return Failure{fmt::format("{}: {}", path.native(), error_text(answered.error()))};
    if (::unlink(path.c_str()) < 0 && errno != ENOENT)
        return Failure{
            fmt::format("{}: cannot remove the stale socket: {}", path.native(), error_text(errno))};
    return true;
}

} // namespace

std::string error_text(int error)
{
    return std::error_code{error, std::system_category()}.message();
}

Result<ListeningSocket, std::string> ListeningSocket::open(const std::filesystem::path& path)
{
    sockaddr_un address;
    if (!make_address(path, address))
        return Failure{fmt::format("'{}': the path of a socket has 1 to {} characters", path.native(),
                                   sizeof address.sun_path - 1)};
    io::Fd fd{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
    if (!fd) return Failure{fmt::format("control socket: {}", error_text(errno))};
    if (const auto free = remove_stale(path); !free) return Failure{free.error()};
    if (::bind(fd.get(), generic(address), sizeof address) < 0)
        return Failure{fmt::format("{}: cannot be made: {}", path.native(), error_text(errno))};

    ListeningSocket result{std::move(fd), path}; // from here on this object removes the file
    struct stat status {};
    if (::lstat(path.c_str(), &status) < 0 || ::chmod(path.c_str(), 0666) < 0 ||
        ::listen(result.fd(), kBacklog) < 0)
        return Failure{fmt::format("{}: {}", path.native(), error_text(errno))};
    result.device_ = status.st_dev;
    result.inode_ = status.st_ino;
    return result;
}

ListeningSocket::~ListeningSocket()
{
    struct stat status {};
    if (fd_ && ::lstat(path_.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_)
        ::unlink(path_.c_str());
}

Result<io::Fd, int> connect_to(const std::filesystem::path& path, std::chrono::milliseconds timeout)
{
    sockaddr_un address;
    if (!make_address(path, address)) return Failure{ENAMETOOLONG};
    io::Fd fd{::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)};
    if (!fd) return Failure{errno};
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(timeout);
    timeval wait{};
    wait.tv_sec = seconds.count();
    wait.tv_usec = std::chrono::microseconds{timeout - seconds}.count();
    if (::setsockopt(fd.get(), SOL_SOCKET, SO_SNDTIMEO, &wait, sizeof wait) < 0) return Failure{errno};
    while (::connect(fd.get(), generic(address), sizeof address) < 0)
        if (errno != EINTR) return Failure{errno};
    return fd;
}

Caller peer_of(int fd)
{
    Caller caller;
    ucred credentials{};
    socklen_t size = sizeof credentials;
    if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &credentials, &size) < 0) return caller;
    caller.uid = credentials.uid;
    caller.gid = credentials.gid;
    caller.pid = credentials.pid;

    // The kernel gives the needed size with ERANGE; NGROUPS_MAX bounds it to 65536 groups.
    size = 0;
    if (::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, nullptr, &size) < 0 && errno == ERANGE) {
        caller.groups.resize(size / sizeof(gid_t));
        if (::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, caller.groups.data(), &size) < 0) size = 0;
        caller.groups.resize(size / sizeof(gid_t));
    }
    return caller;
}

} // namespace dpslave::control
