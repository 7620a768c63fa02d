// SPDX-License-Identifier: Apache-2.0
/// Small files read whole and written whole or not at all.
#pragma once

#include "dpslave/base/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

/// The reason of a failure, without the file's name.
struct FileError {
    std::string why;
};

/// A regular file of at most 1 MiB, octet by octet.
Result<std::string, FileError> read_file(const std::filesystem::path& file);

/// Under a temporary name beside `file`, then renamed: it is whole at every moment. `replace` = false: a file
/// that is there already is left alone, and that is the error. `replace` = true: a link stays, and the file
/// where it leads is written; owner and permissions stay.
std::optional<FileError> write_file(const std::filesystem::path& file, std::string_view content,
                                    bool replace);

} // namespace dpslave::dpctl
