// SPDX-License-Identifier: Apache-2.0
/// From the daemon's replies to the likely cause and the next step, by the troubleshooting tables of the
/// manuals: HA389815 ch. 9, HA463561U002 "Troubleshooting", 2408f/2404f handbook ch. 6. Pure.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/io/port_users.hpp"
#include "dpslave/report/replies.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// What a diagnosis asks for.
struct Replies {
    report::GetStatusReply status{};
    report::GetInfoReply info{};
    report::GetDiagnosisReply diagnosis{};
    report::GetCountersReply counters{};
    report::GetLedsReply leds{};
    report::GetTecReply tec{};
    report::GetIoReply io{};
    std::vector<io::PortUsers> ports{}; ///< of the bus and of each line, as far as dpctl may look
};

/// Whose troubleshooting table counts.
enum class Family : std::uint8_t { option_board, technology_box, controller };

/// What a rule may look at: the bus, and one station (empty in rules of the bus, and what the daemon does not
/// report of it).
struct Facts {
    const Replies& replies;
    const report::Bus& bus;
    const report::CounterGroup& counters; ///< of the bus
    std::int64_t uptime_ms = 0;
    Family family = Family::option_board;
    const report::Station& station;
    const report::CounterGroup& station_counters;
    const report::Info& info;
    const report::Diagnosis& diagnosis;
    const report::Tec& tec;
    const report::StationIo& io;
};

/// What comes first: what explains the rest. Within a rank the order of rules() counts.
enum class Rank : std::uint8_t {
    gone,      ///< a port or the driver enable is not there
    stands,    ///< one cause that holds at this moment
    recent,    ///< counted within the last minute
    checklist, ///< the manual's list for what the lamps show
    note,      ///< to know, nothing is wrong
};

/// One row of the tables: condition -> cause -> steps.
struct Rule {
    std::string_view name; ///< "bus.silent"; those that do not begin with "bus." look at one station
    Rank rank;
    std::string_view condition;
    std::string_view cause;
    std::string_view steps; ///< one a line
    std::string_view source;
    /// What makes it hold, in words; empty = it does not hold.
    std::string (*seen)(const Facts&);
};
std::span<const Rule> rules();
bool is_of_bus(const Rule& rule);
std::vector<std::string_view> steps_of(const Rule& rule);

struct Finding {
    std::string station; ///< empty = the bus
    const Rule* rule = nullptr;
    std::string evidence;
};
/// How many causes are named for the bus and for each station.
inline constexpr std::size_t kMostCauses = 3;

/// What holds now or held within the last minute: by rank, kMostCauses at most for the bus and for each
/// station, and all notes. `station`: name or address, empty = all.
std::vector<Finding> diagnose(const Replies& replies, const std::string& station);

/// Trouble that was counted and has not come again for a minute.
struct Earlier {
    std::string station; ///< empty = the bus
    std::string what;    ///< "times that Data_Exch was left"
    std::int64_t count = 0;
    double age_ms = 0; ///< of the last one
};
std::vector<Earlier> earlier_troubles(const Replies& replies, const std::string& station);

/// Metres of a segment (HA463561U002, "Maximum Line Length Per Segment"; the handbook has the same table).
struct LineLimit {
    std::int64_t baud = 0;
    int cable_a = 0;
    std::optional<int> cable_b; ///< none: not at this rate
};
inline constexpr std::array kLineLimits = std::to_array<LineLimit>({
    {9600, 1200, 1200},
    {19200, 1200, 1200},
    {45450, 1200, 1200}, // not in the table; as its neighbours
    {93750, 1200, 1200},
    {187500, 1000, 600},
    {500000, 400, 200},
    {1500000, 200, std::nullopt},
});
/// Nothing while the rate is searched, or for a rate that the table does not have.
std::optional<LineLimit> line_limit(const report::Bus& bus);

bool is_meant(const report::Station& station, const std::string& wanted);

Json doctor_json(const Replies& replies, const std::vector<Finding>& findings,
                 const std::vector<Earlier>& earlier);
std::string render_doctor(const Replies& replies, const std::vector<Finding>& findings,
                          const std::vector<Earlier>& earlier, const std::string& station, Look look);
Json rules_json();
std::string render_rules(Look look);

} // namespace dpslave::dpctl
