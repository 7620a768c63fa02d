// SPDX-License-Identifier: Apache-2.0
/// Reads regular files: complete, bounded, never waiting.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/unreadable.hpp"

#include <string>
#include <vector>

namespace dpslave::io {

/// The limit in octets. Configuration files are small; more than this is a wrong path.
inline constexpr std::size_t kMaxFileSize = 1024U * 1024U;

/// Returns the content of `file`, octet by octet. It never waits: a file that is not regular (a pipe, a
/// terminal, a device) or is longer than kMaxFileSize is refused. The reason is a clause without the file's
/// name.
Result<std::string, Unreadable> read_regular_file(const std::string& file);

/// The names of the files NAME`extension` in `folder`, without the extension, sorted; none if it cannot be
/// read.
std::vector<std::string> names_in(const std::string& folder, const std::string& extension);

} // namespace dpslave::io
