// SPDX-License-Identifier: Apache-2.0
#include "text_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <system_error>

namespace dpslave::profile {
namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

Failure<Fault> unreadable(const std::filesystem::path& file, const std::string& why)
{
    return Failure{Fault{file.string(), 0, 0, "the file cannot be read: " + why + "."}};
}

} // namespace

Result<std::string, Fault> read_text_file(const std::filesystem::path& file)
{
    const std::unique_ptr<std::FILE, CloseFile> stream{std::fopen(file.c_str(), "rbe")};
    if (!stream) return unreadable(file, std::system_category().message(errno));

    std::string content;
    std::array<char, 16384> part{};
    while (const std::size_t got = std::fread(part.data(), 1, part.size(), stream.get())) {
        content.append(part.data(), got);
        if (content.size() > kMaxFileSize) return unreadable(file, "it is larger than 8 MiB; check the path");
    }
    if (std::ferror(stream.get()) != 0) return unreadable(file, std::system_category().message(errno));

    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (content.starts_with(mark)) content.erase(0, mark.size());
    return content;
}

} // namespace dpslave::profile
