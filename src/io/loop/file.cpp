// SPDX-License-Identifier: Apache-2.0
#include "dpslave/io/file.hpp"

#include "dpslave/io/fd.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace dpslave::io {
namespace {

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

Result<std::string, Unreadable> read_regular_file(const std::string& file)
{
    struct stat status {};
    // Asked first, since the mere opening of a device may do something; and again of what was opened.
    if (::stat(file.c_str(), &status) != 0) return last_error();
    if (!S_ISREG(status.st_mode)) return no_file(status.st_mode);
    const Fd open{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)};
    if (!open || ::fstat(open.get(), &status) != 0) return last_error();
    if (!S_ISREG(status.st_mode)) return no_file(status.st_mode);
    if (status.st_size > static_cast<off_t>(kMaxFileSize)) return too_large();

    std::string content;
    std::array<char, 16384> part{};
    for (;;) {
        const ssize_t got = ::read(open.get(), part.data(), part.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return last_error();
        if (got == 0) return content;
        content.append(part.data(), static_cast<std::size_t>(got));
        if (content.size() > kMaxFileSize) return too_large(); // it grows, or its size is not known (/proc)
    }
}

std::vector<std::string> names_in(const std::string& folder, const std::string& extension)
{
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator entry{folder, error}, end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == extension) names.push_back(entry->path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace dpslave::io
