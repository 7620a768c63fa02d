// SPDX-License-Identifier: Apache-2.0
/// The parts of the configuration file, each read by its own function; config.cpp puts them together.
#pragma once

#include "dpslave/app/config.hpp"
#include "dpslave/profile/document.hpp"
#include "dpslave/profile/text_file.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::app {

/// A drive line and where it stands. A line with faults stays in the list, so that stations which name it are
/// not blamed for it.
struct ReadLine {
    LineConfig line;
    profile::Place name_at;
};

/// In octets, of the tag tables that stations name, all together: a reload reads them on the main thread, and
/// the service's watchdog allows 5 s. The largest table that is shipped has 160 KiB.
inline constexpr std::uintmax_t kMaxTablesTogether = 2 * profile::kMaxFileSize;

/// Profiles and tag tables, each file read and judged once however many stations use it.
class Shelf {
public:
    explicit Shelf(std::filesystem::path folder)
        : folder_(std::move(folder)), names_(profile::profile_names(folder_))
    {}

    const std::filesystem::path& folder() const { return folder_; }
    const std::vector<std::string>& names() const { return names_; }
    /// Null when the file has faults, which are kept for faults().
    std::shared_ptr<const profile::Profile> profile(const std::string& name);
    std::shared_ptr<const drive::TagTable> tags(const std::filesystem::path& file);
    const profile::Faults& faults() const { return faults_; }

private:
    bool has_room_for(const std::filesystem::path& table);
    void keep(const profile::Faults& faults);

    std::filesystem::path folder_;
    std::vector<std::string> names_;
    std::map<std::string, std::shared_ptr<const profile::Profile>> profiles_;
    std::map<std::filesystem::path, std::shared_ptr<const drive::TagTable>> tables_;
    std::uintmax_t size_of_tables_ = 0; ///< in octets, of those in tables_
    profile::Faults faults_;
    std::set<std::string> told_; ///< each of them in words
};

BusConfig read_bus(profile::Document& document, profile::Faults& warnings);

/// The [[line]] tables, with unlike names and ports.
std::vector<ReadLine> read_lines(profile::Document& document, const BusConfig& bus);

/// The [[station]] tables, with unlike names, addresses, drives and lamp sinks.
std::vector<StationConfig> read_stations(profile::Document& document, const BusConfig& bus,
                                         const std::filesystem::path& sysfs,
                                         const std::vector<ReadLine>& lines, Shelf& shelf,
                                         profile::Faults& warnings);

/// The tag table of a station and the keys that say what becomes of tags without a scale. `protocol`: of its
/// line; empty = not known.
void read_tag_keys(profile::Document& document, profile::Table& table, StationConfig& station, Shelf& shelf,
                   std::string_view protocol);
/// Says of the table in use what its rows do not: that there are none, mnemonics, decimals, confirmations.
void judge_tags(profile::Document& document, profile::Table& table, const StationConfig& station,
                std::string_view protocol, profile::Faults& warnings);

/// The keys of a station that only some device types have: [station.tec], [station.diagnosis], ext_diag_bit,
/// resolution, display_decimals; and what follows from them: the tag table in use, and the tags that are
/// watched. To be called when profile, address, line and tag table are known, as far as they are.
void read_device_keys(profile::Document& document, profile::Table& table, StationConfig& station,
                      profile::Faults& warnings);

/// Values of one kind that must not stand in the file twice.
class Unlike {
public:
    /// A fault at the key when `value` was seen before; it names both lines. `shown`: the value in words;
    /// `remedy`: what to do, a whole clause.
    void check(profile::Table& table, std::string_view key, const std::string& value,
               const std::string& shown, std::string_view remedy);

private:
    std::map<std::string, profile::Place> seen_;
};

/// The file behind a path, links followed, so that two names of one tty are the same.
std::string canonical(const std::string& path);

} // namespace dpslave::app
