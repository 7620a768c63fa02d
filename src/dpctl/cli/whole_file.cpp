// SPDX-License-Identifier: Apache-2.0
#include "whole_file.hpp"

#include "dpslave/io/file.hpp"

#include <fcntl.h>
#include <stdio.h> // renameat2
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace dpslave::dpctl {
namespace {

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    bool close()
    {
        const int number = std::exchange(number_, -1);
        return number < 0 || ::close(number) == 0;
    }

private:
    int number_;
};

FileError last_error()
{
    return {std::system_category().message(errno)};
}

bool write_all(int descriptor, std::string_view content)
{
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return ::fsync(descriptor) == 0;
}

FileError is_there()
{
    return {"it exists already: choose another name, or replace it with --force"};
}

/// Where a link leads, also where there is no file yet. A ring of links stays as it is: writing fails then.
std::filesystem::path target_of(std::filesystem::path file)
{
    constexpr int kMostLinks = 40;
    std::error_code failed;
    for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(file, failed); ++i)
        file = file.parent_path() / std::filesystem::read_symlink(file, failed);
    return file;
}

/// As the file that is replaced; a new one is readable as any other of this user.
bool set_permissions(int descriptor, const std::filesystem::path& file)
{
    struct stat there {};
    if (::stat(file.c_str(), &there) == 0) {
        if (::fchown(descriptor, there.st_uid, there.st_gid) != 0 && errno != EPERM) return false;
        return ::fchmod(descriptor, there.st_mode & 0777) == 0;
    }
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return ::fchmod(descriptor, 0666 & ~mask) == 0;
}

/// 0, or errno.
int put_in_place(const char* temporary, const std::filesystem::path& file, bool replace)
{
    if (!replace) {
        if (::renameat2(AT_FDCWD, temporary, AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) return 0;
        if (errno != EINVAL && errno != ENOSYS) return errno;
        std::error_code ignored; // a file system that cannot do it in one step
        if (std::filesystem::exists(file, ignored)) return EEXIST;
    }
    return ::rename(temporary, file.c_str()) == 0 ? 0 : errno;
}

} // namespace

Result<std::string, FileError> read_file(const std::filesystem::path& file)
{
    auto content = io::read_regular_file(file.string());
    if (!content) return Failure{FileError{content.error().why}};
    return *std::move(content);
}

std::optional<FileError> write_file(const std::filesystem::path& name, std::string_view content, bool replace)
{
    struct stat there {};
    if (!replace && ::lstat(name.c_str(), &there) == 0) return is_there();
    const std::filesystem::path file = replace ? target_of(name) : name;

    std::string temporary = file.string() + ".XXXXXX";
    Descriptor descriptor{::mkostemp(temporary.data(), O_CLOEXEC)};
    if (descriptor.number() < 0) return last_error();
    const bool written = write_all(descriptor.number(), content) &&
                         set_permissions(descriptor.number(), file) && descriptor.close();
    const int error = written ? put_in_place(temporary.c_str(), file, replace) : errno;
    if (error == 0) return std::nullopt;
    ::unlink(temporary.c_str());
    if (error == EEXIST) return is_there();
    return FileError{std::system_category().message(error)};
}

} // namespace dpslave::dpctl
