// SPDX-License-Identifier: Apache-2.0
#include "dpslave/config/config.hpp"

#include "parts.hpp"

#include <grp.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <vector>

namespace dpslave::config {
namespace {

using input::Document;
using input::Faults;
using input::Table;

RealtimeConfig read_realtime(Table table)
{
    RealtimeConfig config;
    if (const auto priority = table.integer("priority", 0, 99)) config.priority = static_cast<int>(*priority);
    if (const auto cpu = table.integer("cpu", -1, 1023)) config.cpu = static_cast<int>(*cpu);
    config.lock_memory = table.boolean("lock_memory").value_or(config.lock_memory);
    return config;
}

/// The guard has one more than the sender, and both are below the bus thread if there is room.
int sending_priority(const RealtimeConfig& realtime)
{
    return realtime.priority < 2 ? 0 : std::max(1, realtime.priority - 2);
}

TraceConfig read_trace(Table table)
{
    constexpr std::uint32_t kMost = 1U << 20; // 1 GiB
    TraceConfig config;
    if (const auto kib = table.integer("bus_kib", 0, kMost))
        config.bus_kib = static_cast<std::uint32_t>(*kib);
    constexpr std::uint32_t kMostOfALine = 1U << 12; // 4 MiB: the main thread looks through all of it
    if (const auto kib = table.integer("samples_kib", 0, kMostOfALine))
        config.samples_kib = static_cast<std::uint32_t>(*kib);
    config.incidents = table.boolean("incidents").value_or(config.incidents);
    if (const auto kib = table.integer("drive_kib", 0, kMost))
        config.drive_kib = static_cast<std::uint32_t>(*kib);
    return config;
}

ControlConfig read_control(Table table)
{
    ControlConfig config;
    if (auto socket = table.text("socket")) {
        constexpr std::size_t longest = sizeof(sockaddr_un::sun_path) - 1;
        if (socket->size() > longest)
            table.refuse("socket", "'socket' is longer than the " + std::to_string(longest) +
                                       " octets that a socket's path may have: choose a shorter path.");
        config.socket = *std::move(socket);
    }
    if (auto group = table.text("operator_group")) config.operator_group = *std::move(group);
    config.read_only = table.boolean("read_only").value_or(config.read_only);
    return config;
}

} // namespace

std::shared_ptr<const profile::Profile> Shelf::profile(const std::string& name)
{
    const auto [entry, is_new] = profiles_.try_emplace(name);
    if (!is_new) return entry->second;
    auto loaded = profile::load_profile(io::read_regular_file, folder_.string(), name);
    if (loaded)
        entry->second = std::make_shared<const profile::Profile>(*std::move(loaded));
    else
        keep(loaded.error());
    return entry->second;
}

std::shared_ptr<const drive::TagTable> Shelf::tags(const std::filesystem::path& file)
{
    const auto [entry, is_new] = tables_.try_emplace(file);
    if (!is_new || !has_room_for(file)) return entry->second;
    auto loaded = profile::load_tags(io::read_regular_file, file.string());
    if (loaded)
        entry->second = std::make_shared<const drive::TagTable>(*std::move(loaded));
    else
        keep(loaded.error());
    return entry->second;
}

/// Reported once, for the first table above the limit. A file that cannot be read counts as empty: its reader
/// reports it.
bool Shelf::has_room_for(const std::filesystem::path& table)
{
    const bool had_room = size_of_tables_ <= kMaxTablesTogether;
    std::error_code unreadable;
    if (const auto size = std::filesystem::file_size(table, unreadable);
        !unreadable && size <= io::kMaxFileSize)
        size_of_tables_ += size;
    if (size_of_tables_ <= kMaxTablesTogether) return true;
    if (had_room)
        keep(
            {{table.string(), 0, 0,
              "with this table the tag tables of the stations have more than 2 MiB together: name one table for drives of one kind, and leave out unused tags."}});
    return false;
}

void Shelf::keep(const input::Faults& faults)
{
    for (const input::Fault& fault :
         faults) // two profiles may name one tag table: its faults are reported once
        if (reported_.insert(to_string(fault)).second) faults_.push_back(fault);
}

void Unlike::check(Table& table, std::string_view key, const std::string& value, const std::string& shown,
                   std::string_view remedy)
{
    const auto [entry, is_new] = seen_.try_emplace(value, table.place_of(key));
    if (!is_new)
        table.refuse(key, shown + " is already on line " + std::to_string(entry->second.line) + ": " +
                              std::string{remedy} + ".");
}

std::string canonical(const std::string& path)
{
    std::error_code error;
    const auto found = std::filesystem::weakly_canonical(path, error);
    return error ? std::filesystem::path{path}.lexically_normal().string() : found.string();
}

std::optional<gid_t> operator_group_of(const ControlConfig& control)
{
    constexpr std::size_t kMost = std::size_t{1} << 22; // a group of the network may have very many members
    group entry{};
    group* found = nullptr;
    int error = ERANGE;
    for (std::size_t size = 4096; error == ERANGE && size <= kMost; size *= 4) {
        std::vector<char> room(size);
        error = ::getgrnam_r(control.operator_group.c_str(), &entry, room.data(), room.size(), &found);
    }
    return found != nullptr ? std::optional{entry.gr_gid} : std::nullopt;
}

input::Fault without_operator_group(const Config& config)
{
    return {config.file.string(), config.operator_group_place.line, config.operator_group_place.column,
            "the system has no group \"" + config.control.operator_group +
                "\": only root may operate. Create the group, or name another one in 'operator_group'."};
}

Result<Config, Faults> load_config(const std::filesystem::path& file, const std::filesystem::path& profiles)
{
    Document document{io::read_regular_file, file.string()};
    if (!document.readable()) return Failure{document.faults()};

    Config config;
    config.file = file;
    Shelf shelf{profiles};
    Table root = document.root();
    config.bus = read_bus(document, config.warnings);
    config.realtime = read_realtime(root.table("realtime"));
    if (const auto sysfs = root.table("leds").text("sysfs")) config.sysfs = *sysfs;
    config.control = read_control(root.table("control"));
    config.operator_group_place = root.table("control").place_of("operator_group");
    config.trace = read_trace(root.table("trace"));
    const std::vector<ReadLine> lines = read_lines(document, config.bus, config.sysfs, config.warnings);
    config.stations = read_stations(document, config.bus, config.sysfs, lines, shelf, config.warnings);
    for (const ReadLine& read : lines) {
        config.lines.push_back(read.line);
        config.lines.back().sending_priority = sending_priority(config.realtime);
    }

    Faults faults = document.faults();
    faults.insert(faults.end(), shelf.faults().begin(), shelf.faults().end());
    input::cap(faults);
    if (!faults.empty()) return Failure{std::move(faults)};
    return config;
}

} // namespace dpslave::config
