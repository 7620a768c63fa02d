// SPDX-License-Identifier: Apache-2.0
#include "dpslave/toml/text_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace dpslave::toml {
namespace {

struct OpenFile {
    int number = -1;
    explicit OpenFile(int n) : number(n) {}
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    ~OpenFile()
    {
        if (number >= 0) ::close(number);
    }
};

Failure<Unreadable> last_error()
{
    return Failure{Unreadable{std::system_category().message(errno)}};
}

Failure<Unreadable> too_large()
{
    return Failure{Unreadable{"it is larger than 1 MiB; check the path"}};
}

Failure<Unreadable> no_file(mode_t mode)
{
    if (S_ISDIR(mode)) return Failure{Unreadable{"it is a folder; name a file in it"}};
    return Failure{Unreadable{"it is no regular file but a device, a pipe or a socket; check the path"}};
}

} // namespace

Result<std::string, Unreadable> read_regular_file(const std::filesystem::path& file)
{
    struct stat status {};
    // Asked first, since the mere opening of a device may do something; and again of what was opened.
    if (::stat(file.c_str(), &status) != 0) return last_error();
    if (!S_ISREG(status.st_mode)) return no_file(status.st_mode);
    const OpenFile open{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
    if (open.number < 0 || ::fstat(open.number, &status) != 0) return last_error();
    if (!S_ISREG(status.st_mode)) return no_file(status.st_mode);
    if (status.st_size > static_cast<off_t>(kMaxFileSize)) return too_large();

    std::string content;
    std::array<char, 16384> part{};
    for (;;) {
        const ssize_t got = ::read(open.number, part.data(), part.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return last_error();
        if (got == 0) return content;
        content.append(part.data(), static_cast<std::size_t>(got));
        if (content.size() > kMaxFileSize) return too_large(); // it grows, or its size is not told (/proc)
    }
}

Result<std::string, Fault> read_text_file(const std::filesystem::path& file)
{
    auto content = read_regular_file(file);
    if (!content) {
        const std::string& why = content.error().why;
        return Failure{Fault{file.string(), 0, 0, "the file cannot be read: " + why + "."}};
    }
    if (content->starts_with(kByteOrderMark)) content->erase(0, kByteOrderMark.size());
    return *std::move(content);
}

} // namespace dpslave::toml
