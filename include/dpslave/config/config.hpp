// SPDX-License-Identifier: Apache-2.0
/// The configuration file (config/dpslaved.toml shows every key), judged whole before anything starts.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/line_rules.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/fdl/echo.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/tec/option_block.hpp"
#include "dpslave/toml/document.hpp"
#include "dpslave/toml/fault.hpp"

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::config {

struct BusConfig {
    std::string port;
    std::optional<Baud> baud;   ///< nothing = "auto": searched
    std::uint32_t max_tsdr = 0; ///< T_bit, 0 = the profile's
    io::DriverEnableSettings driver_enable;
    fdl::EchoMode echo = fdl::EchoMode::off;
    bool listen = false; ///< no station, and nothing is ever sent
    friend bool operator==(const BusConfig&, const BusConfig&) = default;
    unsigned port_line = 0; ///< where the key stands, for a message when the port cannot be opened
};

struct RealtimeConfig {
    int priority = 80;
    int cpu = -1;
    bool lock_memory = true;
    friend bool operator==(const RealtimeConfig&, const RealtimeConfig&) = default;
};

struct ControlConfig {
    std::filesystem::path socket = "/run/dpslaved/control.sock";
    std::string operator_group = "dpslaved";
    bool read_only = false; ///< no caller, root included, writes a tag or sets an input of TEC OPTION
    friend bool operator==(const ControlConfig&, const ControlConfig&) = default;
};

struct TraceConfig {
    /// Memory of the recorder, in KiB, which is locked as the rest is; 0 = nothing is recorded.
    std::uint32_t bus_kib = 4096;
    std::uint32_t samples_kib = 256; ///< of each drive line
    bool incidents = true;           ///< what surrounds an incident is written to the state folder
    std::uint32_t drive_kib = 128;   ///< of each drive line
    friend bool operator==(const TraceConfig&, const TraceConfig&) = default;
};

/// Character format of a drive line.
struct LineFormat {
    int data_bits = 7;
    char parity = 'E'; ///< 'N', 'E', 'O'
    int stop_bits = 1;
    friend bool operator==(const LineFormat&, const LineFormat&) = default;
};

/// Protocols of a drive line, as the file spells them.
inline constexpr std::string_view kEiAscii = "ei-ascii";
inline constexpr std::string_view kModbusRtu = "modbus-rtu";

/// How long an answer may take unless the file says otherwise. A 2408f takes up to 500 ms for a block (Modbus
/// reference, section 5).
inline constexpr std::chrono::milliseconds kEiAsciiTimeout{200}, kModbusTimeout{600};

struct LineConfig {
    std::string name;
    std::string port;
    std::string protocol; ///< kEiAscii or kModbusRtu
    std::uint32_t baud = 9600;
    LineFormat format; ///< where the file names none: 7E1, of Modbus RTU 8N1
    std::chrono::milliseconds timeout = kEiAsciiTimeout; ///< kModbusTimeout with Modbus RTU
    int retries = 2;
    std::chrono::milliseconds settle{0}; ///< how late an answer may come; 0 = ten time-outs
    drive::EchoMode echo = drive::EchoMode::off;
    unsigned port_line = 0;
    friend bool operator==(const LineConfig&, const LineConfig&) = default;
};

/// One lamp of a station and its output.
struct LedConfig {
    std::string lamp; ///< "red", "green"; "network", "module", "health", "run"; "rem"
    std::string sink; ///< "gpio:23", "led:dpslaved-green"
    friend bool operator==(const LedConfig&, const LedConfig&) = default;
};

/// [station.tec]: the TEC OPTION function block at the start, and what feeds it.
struct TecConfig {
    tec::Settings start;
    profile::TripSource trip;             ///< of the drive
    std::uint16_t ext_diagnostic_tag = 0; ///< 0 = the value that is set stands
    profile::MirroredLamp health, run;
    friend bool operator==(const TecConfig&, const TecConfig&) = default;
};

struct StationConfig {
    std::string name; ///< letters, digits, "_-.", no "-" first, 32 characters at most; unlike all others
    std::uint8_t address = 0;
    std::shared_ptr<const profile::Profile> profile;
    std::shared_ptr<const dp::Personality>
        personality; ///< the profile's, with this station's ident, max_tsdr and demand switches
    /// The profile's or the station's own, with the decimals of its display and its resolution.
    std::shared_ptr<const drive::TagTable> tags;
    std::string tag_file;
    /// Over EI-ASCII: the decimals of numbers that are in no table; none = their scale is not known.
    std::optional<std::uint8_t> unlisted_decimals;
    bool unscaled_holds = true; ///< false: unscaled_tags = "zero"
    std::size_t line = 0;       ///< index into Config::lines
    drive::UnitAddress unit{};
    std::string unit_text;
    std::chrono::nanoseconds output_refresh = std::chrono::seconds{1};
    drive::ZeroAfter zero_after = std::chrono::nanoseconds{0};
    bool ext_diag_bit = false;          ///< a fault in the extended diagnosis sets Ext_Diag (X-15)
    std::uint16_t status_tag = 0;       ///< [station.diagnosis]; 0 = the profile has none
    bool integer_resolution = false;    ///< 2408f/2404f: resolution = "integer"
    std::optional<TecConfig> tec;       ///< there where the profile has the block
    std::vector<std::uint16_t> watched; ///< tags that the drive side reads for diagnosis and lamps
    /// [station.write_limits]: by tag, for writes over the control socket. The master is not limited by them.
    std::map<std::uint16_t, drive::Limits> write_limits;
    std::vector<LedConfig> leds;
    /// What it points to counts as well: see is_same() in reload_plan.hpp.
    friend bool operator==(const StationConfig&, const StationConfig&) = default;
};

struct Config {
    std::filesystem::path file;
    BusConfig bus;
    RealtimeConfig realtime;
    std::filesystem::path sysfs = "/sys";
    ControlConfig control;
    toml::Place operator_group_place; ///< of the key
    TraceConfig trace;
    std::vector<LineConfig> lines;
    std::vector<StationConfig> stations;
    std::vector<toml::Fault> warnings; ///< said in the log at start: address 0..2, RIDE THROUGH, tags without
                                       ///< mnemonic
};

/// Nothing: the system has no such group. Asks it, which takes long where a directory in the network has the
/// groups: load_config() does not, and the bus does not wait for it.
std::optional<gid_t> operator_group_of(const ControlConfig& control);
/// What to say where operator_group_of() is nothing.
toml::Fault without_operator_group(const Config& config);

/// The file behind a path, links followed, so that two names of one tty are the same.
std::string canonical(const std::string& path);

/// Reads and judges `file`; all faults of it, of the profiles and of the tag tables in one list.
Result<Config, toml::Faults> load_config(const std::filesystem::path& file,
                                         const std::filesystem::path& profiles);

} // namespace dpslave::config
