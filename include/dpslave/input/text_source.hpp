// SPDX-License-Identifier: Apache-2.0
/// The source of the text of a file: a disk, or memory if there is no file system.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/unreadable.hpp"
#include "dpslave/input/fault.hpp"

#include <functional>
#include <string>
#include <string_view>

namespace dpslave::input {

/// Spreadsheet programs put it in front of a table in UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// The octets of the file `name`, or why there are none: a clause without the name. io::read_regular_file is
/// one.
using TextSource = std::function<Result<std::string, Unreadable>(const std::string& name)>;

/// The text of `name` without a byte order mark at the start.
Result<std::string, Fault> read_text(const TextSource& source, const std::string& name);

/// The path of `name` beside the file or folder `path`: "tags/a.csv" beside "config/profiles/" is
/// "config/tags/a.csv".
std::string beside(const std::string& path, const std::string& name);

} // namespace dpslave::input
