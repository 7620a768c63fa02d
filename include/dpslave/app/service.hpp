// SPDX-License-Identifier: Apache-2.0
/// What a service manager asks beside the daemon itself (systemd/dpslaved.service.in).
#pragma once

#include "dpslave/config/config.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

/// True: `file` is a TOML file in which there is neither [bus] nor [[line]] nor [[station]], as it is
/// shipped. False also for a file that is missing or faulty: load_config() reports it.
bool is_unconfigured(const std::filesystem::path& file);

/// The folder that the service manager gives this service while it runs (systemd.exec(5),
/// RUNTIME_DIRECTORY); empty = it was started by hand.
std::filesystem::path runtime_folder();
/// Likewise the one for what outlives the program (StateDirectory=).
std::filesystem::path state_folder();

/// What enables an RS-485 driver, and where.
struct DriverInUse {
    io::DriverEnableSettings settings;
    std::string port; ///< the tty of the bus or of a drive line
    friend bool operator==(const DriverInUse&, const DriverInUse&) = default;
};
/// That of the bus, then those of the drive lines whose transceivers do not switch by themselves.
std::vector<DriverInUse> drivers_of(const config::Config& config);
/// Writes them down in `runtime` for the time after the daemon's end: the configuration may be another one
/// then, or a faulty one. An empty `runtime`: nothing is done. The error is a sentence.
std::optional<std::string> keep(const std::vector<DriverInUse>& drivers,
                                const std::filesystem::path& runtime);
/// Nothing: nothing was kept there.
std::optional<std::vector<DriverInUse>> kept_drivers(const std::filesystem::path& runtime);

/// For the time after the daemon's end, however it came: makes the line that enables the RS-485 driver
/// inactive, where nothing else does that (see dpslave/io/driver_enable.hpp). A line that another process
/// holds stays as it is; this and any other failure is a sentence.
std::optional<std::string> release(const DriverInUse& driver);

} // namespace dpslave::app
