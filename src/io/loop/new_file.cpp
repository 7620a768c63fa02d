// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/new_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace dpslave::io {

NewFile::NewFile(std::filesystem::path path)
    : path_(std::move(path)), unfinished_(path_.string() + kUnfinished)
{
    constexpr int kMode = 0640;
    fd_ = Fd{::open(unfinished_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC,
                    kMode)};
    if (!fd_) note_failure();
}

NewFile::~NewFile()
{
    if (fd_ && !is_in_place_) ::unlink(unfinished_.c_str());
}

void NewFile::note_failure()
{
    if (!failure_) failure_ = path_.string() + " cannot be written: " + std::system_category().message(errno);
}

void NewFile::write(Bytes octets)
{
    while (!failure_ && !octets.empty()) {
        const ssize_t written = ::write(fd_.get(), octets.data(), octets.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return note_failure();
        octets = octets.subspan(static_cast<std::size_t>(written));
    }
}

/// The folder is synchronised too: else a loss of power may take the new name with it.
std::optional<std::string> NewFile::finish()
{
    if (!failure_ && ::fsync(fd_.get()) != 0) note_failure();
    if (!failure_ && ::rename(unfinished_.c_str(), path_.c_str()) != 0) note_failure();
    if (failure_) return failure_;
    is_in_place_ = true;
    const Fd folder{::open(path_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    if (folder) ::fsync(folder.get());
    return std::nullopt;
}

} // namespace dpslave::io
