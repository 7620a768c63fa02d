// SPDX-License-Identifier: Apache-2.0
/// The parts of the configuration file, each read by its own function; config.cpp puts them together.
#pragma once

#include "dpslave/config/config.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/toml/document.hpp"

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
    toml::Place name_at;
};

/// In octets, of the tag tables that stations name, all together: a reload reads them on the main thread, and
/// the service's watchdog allows 5 s. The largest table that is shipped has 160 KiB.
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
    const toml::Faults& faults() const { return faults_; }

private:
    bool has_room_for(const std::filesystem::path& table);
    void keep(const toml::Faults& faults);

    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::map<std::string, std::shared_ptr<const profile::Profile>> profiles_;
    std::map<std::filesystem::path, std::shared_ptr<const drive::TagTable>> tables_;
    std::uintmax_t size_of_tables_ = 0; ///< in octets, of those in tables_
    toml::Faults faults_;
    std::set<std::string> reported_; ///< faults as text, so that each is in faults_ once
};

BusConfig read_bus(toml::Document& document, toml::Faults& warnings);

/// With listen = true: a fault at the first of the `what` tables, "line" or "station".
void refuse_beside_listen(toml::Document& document, const std::vector<toml::Table>& tables,
                          std::string_view what);

/// The [[line]] tables, with unlike names and ports.
std::vector<ReadLine> read_lines(toml::Document& document, const BusConfig& bus);

/// The [[station]] tables, with unlike names, addresses, drives and lamp sinks.
std::vector<StationConfig> read_stations(toml::Document& document, const BusConfig& bus,
                                         const std::filesystem::path& sysfs,
                                         const std::vector<ReadLine>& lines, Shelf& shelf,
                                         toml::Faults& warnings);

/// The tag table of a station and the keys that say what becomes of tags without a scale. `protocol`: of its
/// line; empty = not known.
void read_tag_keys(toml::Document& document, toml::Table& table, StationConfig& station, Shelf& shelf,
                   std::string_view protocol);
/// Says of the table in use what its rows do not: that there are none, mnemonics, decimals, confirmations.
void judge_tags(toml::Document& document, toml::Table& table, const StationConfig& station,
                std::string_view protocol, toml::Faults& warnings);

/// The keys of a station that only some device types have: [station.tec], [station.diagnosis], ext_diag_bit,
/// resolution, display_decimals; and what follows from them: the tag table in use, and the tags that are
/// watched. To be called when profile, address, line and tag table are known, as far as they are.
void read_device_keys(toml::Document& document, toml::Table& table, StationConfig& station,
                      toml::Faults& warnings);

/// [station.write_limits]. To be called after read_device_keys(): limits are values of the tag table in use.
void read_write_limits(toml::Table& table, StationConfig& station);

/// Values of one kind that must not stand in the file twice.
class Unlike {
public:
    /// A fault at the key when `value` was seen before; it names both lines. `shown`: the value in words;
    /// `remedy`: what to do, a whole clause.
    void check(toml::Table& table, std::string_view key, const std::string& value, const std::string& shown,
               std::string_view remedy);

private:
    std::map<std::string, toml::Place> seen_;
};

} // namespace dpslave::config
