// SPDX-License-Identifier: Apache-2.0
/// What an update has changed in a running plant, said at the first start with it.
#pragma once

#include "dpslave/config/config.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace dpslave::app {

/// What the plant has to know of the new default of when_drive_lost; nothing: it was said before, no
/// station has the default, or there is no state folder to remember it in (`state` is empty).
std::optional<std::string> first_start_words(const config::Config& config,
                                             const std::filesystem::path& state);

} // namespace dpslave::app
