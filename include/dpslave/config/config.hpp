// SPDX-License-Identifier: Apache-2.0
/// The configuration file (config/dpslaved.toml shows every key), judged completely before anything starts.
#pragma once

#include "dpslave/base/echo_mode.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/line_setting.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/drive/wire_time.hpp"
#include "dpslave/input/document.hpp"
#include "dpslave/input/fault.hpp"
#include "dpslave/io/driver_enable.hpp"
#include "dpslave/profile/profile.hpp"
#include "dpslave/profile/station_keys.hpp"
#include "dpslave/tec/option_block.hpp"

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
    EchoMode echo = EchoMode::off;
    bool listen = false; ///< no station, and nothing is ever sent
    friend bool operator==(const BusConfig&, const BusConfig&) = default;
    unsigned port_line = 0; ///< where the key is, for a message when the port cannot be opened
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

using drive::LineFormat;

/// Protocols of a drive line, as the file spells them.
inline constexpr std::string_view kEiAscii = "ei-ascii";
inline constexpr std::string_view kModbusRtu = "modbus-rtu";

/// The time that an answer may take unless the file says otherwise. A 2408f takes up to 500 ms for a block
/// (Modbus reference, section 5).
inline constexpr std::chrono::milliseconds kEiAsciiTimeout{200}, kModbusTimeout{600};

struct LineConfig {
    std::string name;
    std::string port;
    std::string protocol; ///< kEiAscii or kModbusRtu
    std::uint32_t baud = 9600;
    LineFormat format; ///< where the file names none: 7E1, of Modbus RTU 8N1
    std::chrono::milliseconds timeout = kEiAsciiTimeout; ///< kModbusTimeout with Modbus RTU
    int retries = 2;
    std::chrono::milliseconds settle{0}; ///< how late an answer may come; 0 = ten timeouts
    EchoMode echo = EchoMode::off;
    drive::WireTime wire_time = drive::WireTime::automatic;
    io::DriverEnableSettings driver_enable{}; ///< of a two-wire line
    /// SCHED_FIFO priority of the drive thread from the write to the release, where it switches the
    /// transceiver: below the bus thread, as [realtime] has that; 0 = ordinary.
    int sending_priority = 0;
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
    std::uint16_t ext_diagnostic_tag = 0; ///< 0 = the value that is set applies
    profile::MirroredLamp health, run;
    friend bool operator==(const TecConfig&, const TecConfig&) = default;
};

struct StationConfig {
    std::string name; ///< letters, digits, "_-.", no "-" first, 32 characters at most; unlike all others
    std::uint8_t address = 0;
    std::shared_ptr<const profile::Profile> profile;
    profile::StationKeys keys; ///< ident, tags_at, identifiers (X-53)
    std::shared_ptr<const dp::Personality>
        personality; ///< the profile's, with this station's keys, max_tsdr and demand switches
    /// The profile's or the station's own, with the decimals of its display and its resolution.
    std::shared_ptr<const drive::TagTable> tags;
    std::string tag_file;
    /// Over EI-ASCII: the decimals of numbers that are in no table; none = their scale is not known.
    std::optional<std::uint8_t> unlisted_decimals;
    bool unscaled_holds = true;                                    ///< false: unscaled_tags = "zero"
    drive::DeniedHold denied_holds = drive::DeniedHold::where_one; ///< denied_tags; a technology box: never
    std::size_t line = 0;                                          ///< index into Config::lines
    drive::UnitAddress unit{};
    std::string unit_text;
    std::chrono::nanoseconds output_refresh = std::chrono::seconds{1};
    drive::ZeroAfter zero_after = std::chrono::nanoseconds{0};
    drive::LossRule loss{.when = drive::WhenLost::silent, .after = std::chrono::seconds{2}}; ///< X-51
    bool ext_diag_bit = false;       ///< a fault in the extended diagnosis sets Ext_Diag (X-15)
    std::uint16_t status_tag = 0;    ///< [station.diagnosis]; 0 = the profile has none
    bool integer_resolution = false; ///< 2408f/2404f: resolution = "integer"
    std::vector<drive::ScaleRegister> scale_registers; ///< in which the device says it itself (X-54)
    std::optional<TecConfig> tec;                      ///< there where the profile has the block
    std::vector<std::uint16_t> watched; ///< tags that the drive side reads for diagnosis and lamps
    /// [station.write_limits]: by tag, for writes over the control socket. The master is not limited by them.
    std::map<std::uint16_t, drive::Limits> write_limits;
    std::vector<LedConfig> leds;
    /// Equal contents of pointers count as well: see is_same() in reload_plan.hpp.
    friend bool operator==(const StationConfig&, const StationConfig&) = default;
};

struct Config {
    std::filesystem::path file;
    BusConfig bus;
    RealtimeConfig realtime;
    std::filesystem::path sysfs = "/sys";
    ControlConfig control;
    input::Place operator_group_place; ///< of the key
    TraceConfig trace;
    std::vector<LineConfig> lines;
    std::vector<StationConfig> stations;
    std::vector<input::Fault> warnings; ///< said in the log at start: address 0..2, RIDE THROUGH, tags
                                        ///< without mnemonic
};

/// Returns nullopt if the system has no such group. It asks the system, which takes long if a directory in
/// the network has the groups: load_config() does not, and the bus does not wait for it.
std::optional<gid_t> operator_group_of(const ControlConfig& control);
/// Returns the message for an operator_group_of() that is nullopt.
input::Fault without_operator_group(const Config& config);

/// Returns the file that a path leads to, links followed, so that two names of one tty are the same. It asks
/// the file system, which may take long.
std::string canonical(const std::string& path);

/// Reads and judges `file`; all faults of it, of the profiles and of the tag tables in one list.
Result<Config, input::Faults> load_config(const std::filesystem::path& file,
                                          const std::filesystem::path& profiles);

} // namespace dpslave::config
