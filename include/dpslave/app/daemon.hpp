// SPDX-License-Identifier: Apache-2.0
/// The whole daemon from a judged configuration to its end.
#pragma once

#include "dpslave/config/config.hpp"

#include <filesystem>

namespace dpslave::app {

/// Exit status of `dpslaved` (config/dpslaved.toml, head).
enum class ExitStatus : int {
    ended_by_signal = 0,
    configuration_refused = 1,
    usage = 2,
    device_not_opened = 3, ///< a device or the socket
};

/// Opens every device and the socket, serves until SIGTERM or SIGINT, leaves the bus and puts the outputs
/// into their safe state. Either everything runs, or nothing was started. Logs through spdlog's default
/// logger.
ExitStatus run_daemon(const config::Config& config, const std::filesystem::path& profiles);

} // namespace dpslave::app
