// SPDX-License-Identifier: Apache-2.0
/// What a service manager asks beside the daemon itself (systemd/dpslaved.service.in).
#pragma once

#include "dpslave/app/config.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace dpslave::app {

/// True: `file` is a TOML file in which there is neither [bus] nor [[line]] nor [[station]], as it is
/// shipped. A file that is missing or faulty is for load_config() to complain of: false.
bool is_unconfigured(const std::filesystem::path& file);

/// For the time after the daemon's end, however it came: makes the line that enables the RS-485 driver
/// inactive, where nobody else does that (dpslave/io/driver_enable.hpp says who). A line that another process
/// holds stays as it is; this and any other failure is a sentence.
std::optional<std::string> release_driver(const BusConfig& bus);

} // namespace dpslave::app
