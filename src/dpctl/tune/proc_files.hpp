// SPDX-License-Identifier: Apache-2.0
/// Small files of /proc and /sys, and the threads that /proc shows.
#pragma once

#include "machine.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::io {

/// The text without its last line end; nothing if the file cannot be read.
std::optional<std::string> file_text(const std::filesystem::path& path);
/// The number it begins with, decimal.
std::optional<long> file_number(const std::filesystem::path& path);
/// The value of a line "NAME: value"; empty = there is none.
std::string line_value(std::string_view text, std::string_view name);
/// Names in a folder, sorted; none if it cannot be read.
std::vector<std::string> names_in(const std::filesystem::path& folder);
/// The numbers among them: processes of /proc, threads of a task folder.
std::vector<int> numbers_in(const std::filesystem::path& folder);

/// The thread of this folder (/proc/PID or /proc/PID/task/TID); nothing if it has gone.
std::optional<ThreadFacts> read_thread(const std::filesystem::path& folder);

} // namespace dpslave::io
