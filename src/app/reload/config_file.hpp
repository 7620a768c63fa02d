// SPDX-License-Identifier: Apache-2.0
/// The configuration file on the disk. No call of the control interface reads it but Reload. Main thread
/// only.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/config/config.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace dpslave::app {

class ConfigFile {
public:
    /// `present`: what was read from it at the start, before `now`.
    ConfigFile(const config::Config& present, std::filesystem::path profiles, Instant now);

    const std::filesystem::path& path() const { return file_; }
    /// Reads and judges the whole of it.
    Result<config::Config, input::Faults> load();
    /// Loads it when it has changed; looks once a second at most.
    void on_time(Instant now);
    /// The address of a station in it, as of the last load() or on_time(): what a restart would bring
    /// . Nothing: it has no such station, or it has faults.
    std::optional<std::uint8_t> address_of(const std::string& station) const;

private:
    void note(const config::Config& read);

    std::filesystem::path file_, profiles_;
    Instant next_look_;
    std::filesystem::file_time_type written_{}; ///< when on_time() read it; the first look reads it
    std::map<std::string, std::uint8_t, std::less<>> addresses_;
};

} // namespace dpslave::app
