// SPDX-License-Identifier: Apache-2.0
/// The whole daemon from a judged configuration to its end.
#pragma once

#include "dpslave/config/config.hpp"
#include "dpslave/io/log_thread.hpp"

#include <filesystem>

namespace dpslave::app {

/// Exit status of `dpslaved` (config/dpslaved.toml, head).
enum class ExitStatus : int {
    ended_by_signal = 0,
    configuration_refused = 1,
    usage = 2,
    not_served = 3, ///< the control socket could not be opened, or a thread failed or stalled
};

/// Opens the socket and the devices, serves until SIGTERM or SIGINT, leaves the bus and puts the outputs
/// into their safe state. A device that is missing is opened when it appears; while that is the port of the
/// bus or its driver enable, the stations are silent. Logs through spdlog's default logger, which gives its
/// lines to `log`. A thread that hangs in a system call at the end is left behind: then the process ends
/// here.
ExitStatus run_daemon(const config::Config& config, const std::filesystem::path& profiles,
                      io::LogThread& log);

} // namespace dpslave::app
