// SPDX-License-Identifier: Apache-2.0
/// The configuration file (config/dpslaved.toml shows every key), judged whole before anything starts.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/profile/fault.hpp"
#include "dpslave/profile/profile.hpp"

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

struct BusConfig {
    std::string port;
    Baud baud = Baud::k187_5;
    std::uint32_t max_tsdr = 0; ///< T_bit, 0 = the profile's
    unsigned port_line = 0;     ///< where the key stands, for a message when the port cannot be opened
};

struct RealtimeConfig {
    int priority = 80;
    int cpu = -1;
    bool lock_memory = true;
};

struct ControlConfig {
    std::filesystem::path socket = "/run/dpslaved/control.sock";
    std::string operator_group = "dpslaved";
};

/// Character format of a drive line.
struct LineFormat {
    int data_bits = 7;
    char parity = 'E'; ///< 'N', 'E', 'O'
    int stop_bits = 1;
};

struct LineConfig {
    std::string name;
    std::string port;
    std::string protocol; ///< "ei-ascii"
    std::uint32_t baud = 9600;
    LineFormat format;
    std::chrono::milliseconds timeout{200};
    int retries = 2;
    unsigned port_line = 0;
};

/// One lamp of a station and where it shines.
struct LedConfig {
    std::string lamp; ///< "red", "green"
    std::string sink; ///< "gpio:23", "led:dpslaved-green"
};

struct StationConfig {
    std::string name;
    std::uint8_t address = 0;
    std::shared_ptr<const profile::Profile> profile;
    std::shared_ptr<const dp::Personality>
        personality; ///< the profile's, with this station's ident, max_tsdr and demand switches
    std::shared_ptr<const drive::TagTable> tags; ///< the profile's or the station's own
    std::string tag_file;
    std::size_t line = 0; ///< index into Config::lines
    drive::UnitAddress unit{};
    std::string unit_text;
    std::chrono::nanoseconds output_refresh = std::chrono::seconds{1};
    drive::OutputLoss output_loss = drive::OutputLoss::zero;
    std::vector<LedConfig> leds;
};

struct Config {
    std::filesystem::path file;
    BusConfig bus;
    RealtimeConfig realtime;
    std::filesystem::path sysfs = "/sys";
    ControlConfig control;
    std::vector<LineConfig> lines;
    std::vector<StationConfig> stations;
    std::vector<profile::Fault>
        warnings; ///< said in the log at start: address 0..2, unknown operator group, tags without mnemonic
};

/// Reads and judges `file`; all faults of it, of the profiles and of the tag tables in one list.
Result<Config, profile::Faults> load_config(const std::filesystem::path& file,
                                            const std::filesystem::path& profiles);

} // namespace dpslave::app
