// SPDX-License-Identifier: Apache-2.0
/// A whole file of a person in memory, or why not.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/toml/fault.hpp"

#include <filesystem>
#include <string>
#include <string_view>

namespace dpslave::toml {

/// In octets. Files of people are small; more than this is a wrong path.
inline constexpr std::size_t kMaxFileSize = 1024U * 1024U;

/// Spreadsheet programs put it in front of a table in UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// What stands in `file`, octet by octet. Never waits: what is no regular file (a pipe, a terminal, a
/// device) or is longer than kMaxFileSize is refused. The reason is a clause without the file's name.
struct Unreadable {
    std::string why;
};
Result<std::string, Unreadable> read_regular_file(const std::filesystem::path& file);

/// The same without a byte order mark at the start.
Result<std::string, Fault> read_text_file(const std::filesystem::path& file);

} // namespace dpslave::toml
