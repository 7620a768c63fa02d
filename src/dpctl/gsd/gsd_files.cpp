// SPDX-License-Identifier: Apache-2.0
#include "gsd_files.hpp"

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
    return {"it is there already: choose another name, or replace it with --force"};
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

std::optional<FileError> write_file(const std::filesystem::path& file, std::string_view content, bool replace)
{
    struct stat there {};
    if (!replace && ::lstat(file.c_str(), &there) == 0) return is_there();

    std::string temporary = file.string() + ".XXXXXX";
    Descriptor descriptor{::mkostemp(temporary.data(), O_CLOEXEC)};
    if (descriptor.number() < 0) return last_error();
    const mode_t mask = ::umask(0); // readable as any other file of this user; mkostemp gives 0600
    ::umask(mask);
    const bool written = write_all(descriptor.number(), content) &&
                         ::fchmod(descriptor.number(), 0666 & ~mask) == 0 && descriptor.close();
    const int error = written ? put_in_place(temporary.c_str(), file, replace) : errno;
    if (error == 0) return std::nullopt;
    ::unlink(temporary.c_str());
    if (error == EEXIST) return is_there();
    return FileError{std::system_category().message(error)};
}

} // namespace dpslave::dpctl
