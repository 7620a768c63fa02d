// SPDX-License-Identifier: Apache-2.0
/// A whole text file in memory, or a fault that says why not.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/profile/fault.hpp"

#include <filesystem>
#include <string>

namespace dpslave::profile {

/// Files of people are small; more than this is a wrong path, not a table.
inline constexpr std::size_t kMaxFileSize = 8U * 1024U * 1024U;

/// Without a byte order mark at the start.
Result<std::string, Fault> read_text_file(const std::filesystem::path& file);

} // namespace dpslave::profile
