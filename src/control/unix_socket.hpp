// SPDX-License-Identifier: Apache-2.0
/// Unix stream sockets: listening at a path, connecting to it, the credentials of the other end.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/control/server.hpp"
#include "dpslave/io/fd.hpp"

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>

namespace dpslave::control {

/// A listening socket and the file that stands for it. The file is removed at the end, if it is still this
/// one.
class ListeningSocket {
public:
    /// Mode 0666: every user may look. What else a caller may do follows from peer_of().
    static Result<ListeningSocket, std::string> open(const std::filesystem::path& path);
    ListeningSocket(ListeningSocket&&) noexcept = default;
    ListeningSocket& operator=(ListeningSocket&&) = delete;
    ~ListeningSocket();

    int fd() const noexcept { return fd_.get(); }

private:
    ListeningSocket(io::Fd fd, std::filesystem::path path) : fd_(std::move(fd)), path_(std::move(path)) {}
    io::Fd fd_;
    std::filesystem::path path_;
    dev_t device_ = 0;
    ino_t inode_ = 0;
};

/// A blocking socket connected to `path`, whose waits in the kernel last at most `timeout`. The reason is an
/// errno.
Result<io::Fd, int> connect_to(const std::filesystem::path& path, std::chrono::milliseconds timeout);

/// The credentials of the other end of a connected socket. Unknown to the kernel: a caller without any right.
Caller peer_of(int fd);

/// "connection refused" and the like, of an errno.
std::string error_text(int error);

} // namespace dpslave::control
