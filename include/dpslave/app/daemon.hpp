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
    device_not_opened = 3, ///< the bus port, its driver enable or the socket
};

/// Opens the devices and the socket, serves until SIGTERM or SIGINT, leaves the bus and puts the outputs
/// into their safe state. Either the bus is served, or nothing was started; a drive port that is missing is
/// opened when it appears. Logs through spdlog's default logger.
ExitStatus run_daemon(const config::Config& config, const std::filesystem::path& profiles);

} // namespace dpslave::app
