// SPDX-License-Identifier: Apache-2.0
/// What an update has changed in a running plant, said at the first start with it.
#pragma once

#include "dpslave/config/config.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace dpslave::app {

/// True: a station has the new default of when_drive_lost.
bool has_new_default(const config::Config& config);
/// What the plant has to know of that default; nothing: it was said before. `state`: the folder where that is
/// remembered. It may block.
std::optional<std::string> first_start_words(const std::filesystem::path& state);

} // namespace dpslave::app
