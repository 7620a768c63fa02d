// SPDX-License-Identifier: Apache-2.0
/// The parts of the configuration file, each read by its own function; config.cpp puts them together.
#pragma once

#include "dpslave/config/config.hpp"
#include "dpslave/input/document.hpp"
#include "dpslave/io/file.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::config {

/// A drive line and its place in the file. A line with faults stays in the list, so that stations which name
/// it get no fault for it.
struct ReadLine {
    LineConfig line;
    input::Place name_at;
};

/// The limit in octets for all tag tables that stations name, together: a reload reads them on the main
/// thread, and the service's watchdog allows 5 s. The largest table that is shipped has 160 KiB.
inline constexpr std::uintmax_t kMaxTablesTogether = 2 * io::kMaxFileSize;

/// Profiles and tag tables, each file read and judged once however many stations use it.
class Shelf {
public:
    explicit Shelf(std::filesystem::path folder)
        : folder_(std::move(folder)), names_(io::names_in(folder_, ".toml"))
    {}

    const std::filesystem::path& folder() const { return folder_; }
    const std::vector<std::string>& names() const { return names_; }
    /// Null when the file has faults, which are kept for faults().
    std::shared_ptr<const profile::Profile> profile(const std::string& name);
    std::shared_ptr<const drive::TagTable> tags(const std::filesystem::path& file);
    const input::Faults& faults() const { return faults_; }

private:
    bool has_room_for(const std::filesystem::path& table);
    void keep(const input::Faults& faults);

    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::map<std::string, std::shared_ptr<const profile::Profile>> profiles_;
    std::map<std::filesystem::path, std::shared_ptr<const drive::TagTable>> tables_;
    std::uintmax_t size_of_tables_ = 0; ///< in octets, of those in tables_
    input::Faults faults_;
    std::set<std::string> reported_; ///< faults as text, so that each is in faults_ once
};

BusConfig read_bus(input::Document& document, input::Faults& warnings);

/// direction, gpio_chip, gpio_line and gpio_active_low of [bus] or of a [[line]]. `otherwise`: the direction
/// where the file names none.
io::DriverEnableSettings read_driver_enable(input::Document& document, input::Table& table,
                                            io::Direction otherwise, input::Faults& warnings);
/// Returns the GPIO line that `driver` switches, the same for each name of its chip. It is for comparison
/// only.
std::string gpio_target(const io::DriverEnableSettings& driver, const std::filesystem::path& sysfs);

/// Adds with listen = true a fault at the first of the `what` tables, "line" or "station".
void refuse_beside_listen(input::Document& document, const std::vector<input::Table>& tables,
                          std::string_view what);

/// The [[line]] tables, with unlike names, ports and GPIO lines.
std::vector<ReadLine> read_lines(input::Document& document, const BusConfig& bus,
                                 const std::filesystem::path& sysfs, input::Faults& warnings);

/// The [[station]] tables, with unlike names, addresses, drives and lamp sinks.
std::vector<StationConfig> read_stations(input::Document& document, const BusConfig& bus,
                                         const std::filesystem::path& sysfs,
                                         const std::vector<ReadLine>& lines, Shelf& shelf,
                                         input::Faults& warnings);

/// Reads what the slave accepts: ident, tags_at, identifiers and [station.demand] over the profile's,
/// max_tsdr of the bus. Call it when profile, line and when_drive_lost are known, as far as they are.
/// `is_ei_ascii`: the line speaks it.
void read_personality(input::Document& document, input::Table& table, const BusConfig& bus, bool is_ei_ascii,
                      StationConfig& station, input::Faults& warnings);

/// The tag table of a station and the keys that say what becomes of tags without a scale. `protocol`: of its
/// line; empty = not known.
void read_tag_keys(input::Document& document, input::Table& table, StationConfig& station, Shelf& shelf,
                   std::string_view protocol);
/// Says of the table in use what its rows do not: that there are none, mnemonics, decimals, confirmations.
void judge_tags(input::Document& document, input::Table& table, const StationConfig& station,
                std::string_view protocol, input::Faults& warnings);

/// Reads the keys of a station that only some device types have: [station.tec], [station.diagnosis],
/// ext_diag_bit, resolution, display_decimals; and what follows from them: the tag table in use, and the tags
/// that are watched. Call it when profile, address, line and tag table are known, as far as they are.
void read_device_keys(input::Document& document, input::Table& table, StationConfig& station,
                      input::Faults& warnings);

/// Reads [station.write_limits]. Call it after read_device_keys(): limits are values of the tag table in use.
void read_write_limits(input::Table& table, StationConfig& station);

/// Holds values of one kind that must be in the file only once.
class Unlike {
public:
    /// A fault at the key when `value` was seen before; it names both lines. `shown`: the value in words;
    /// `remedy`: what to do, a whole clause.
    void check(input::Table& table, std::string_view key, const std::string& value, const std::string& shown,
               std::string_view remedy);

private:
    std::map<std::string, input::Place> seen_;
};

} // namespace dpslave::config
