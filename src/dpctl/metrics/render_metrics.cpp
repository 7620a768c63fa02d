// SPDX-License-Identifier: Apache-2.0
#include "exposition.hpp"
#include "metrics.hpp"

#include "dpslave/base/histogram.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <optional>
#include <set>

namespace dpslave::dpctl {
namespace {

constexpr const char* kUp = "dpslaved_up";
constexpr const char* kUpHelp = "1: the daemon behind this socket answered.";

double seconds(double milliseconds)
{
    return milliseconds / 1000;
}

/// As a part of a name of a metric: small letters, digits and single underscores.
std::string part_of_name(std::string_view words)
{
    std::string out;
    for (const char c : words) {
        const auto octet = static_cast<unsigned char>(c);
        if (octet < 0x80 && std::isalnum(octet) != 0)
            out += static_cast<char>(std::tolower(octet));
        else if (!out.empty() && out.back() != '_')
            out += '_';
    }
    while (!out.empty() && out.back() == '_') out.pop_back();
    return out;
}

/// Classes of the daemon as buckets. `uppers`: ends of classes, all of them at each scrape, also those in
/// which nothing has been counted yet.
Buckets buckets_of(const report::Distribution& counted, const std::vector<std::int64_t>& uppers,
                   double units_in_second)
{
    Buckets result;
    for (const std::int64_t upper : uppers) {
        std::int64_t below = 0;
        for (const report::DistributionClass& one : counted.classes)
            if (one.to && *one.to <= upper) below += one.count;
        result.buckets.push_back({static_cast<double>(upper) / units_in_second, below});
    }
    result.count = counted.count;
    result.sum = static_cast<double>(counted.sum) / units_in_second;
    return result;
}

/// Every class from 16 us up: no reply is faster than 11 bit times at 1.5 Mbit/s.
std::vector<std::int64_t> turnaround_uppers()
{
    constexpr std::uint32_t kShortest = 15;
    std::vector<std::int64_t> uppers;
    for (std::size_t n = 1; n < Histogram::kClasses; ++n)
        if (const std::uint32_t upper = Histogram::lower_end(n) - 1; upper >= kShortest)
            uppers.push_back(upper);
    return uppers;
}

/// One for each power of two: 126 stations have a histogram each.
std::vector<std::int64_t> refresh_uppers()
{
    std::vector<std::int64_t> uppers;
    for (std::int64_t end = 2; end < Histogram::kLastLowerEnd; end *= 2) uppers.push_back(end - 1);
    uppers.push_back(Histogram::kLastLowerEnd - 1);
    return uppers;
}

/// A counter of the daemon, by what its name says: one that counts flaws has their kind as a label, one in
/// milliseconds is a figure of now.
void add_counter(Exposition& out, std::string prefix, Labels labels, const report::Counter& counter)
{
    std::string name = counter.name;
    std::string help = counter.name + (counter.meaning.empty() ? "" : ": " + counter.meaning);
    if (constexpr std::string_view kFlaw = "flaw: "; name.starts_with(kFlaw)) {
        labels.emplace_back("flaw", name.substr(kFlaw.size()));
        return out.counter(prefix + "flaws_total", counter.meaning, labels, counter.value);
    }
    if (constexpr std::string_view kDrive = "drive_"; prefix == "dpslaved_station_") {
        if (name.starts_with(kDrive)) {
            prefix = "dpslaved_drive_";
            name.erase(0, kDrive.size());
        } else {
            std::erase_if(labels, [](const auto& label) { return label.first == "line"; });
        }
    }
    if (constexpr std::string_view kMs = "_ms"; name.ends_with(kMs)) {
        name.erase(name.size() - kMs.size());
        return out.gauge(prefix + part_of_name(name) + "_seconds", help, labels,
                         seconds(static_cast<double>(counter.value)));
    }
    if (name == "octets") name = "received_bytes";
    out.counter(prefix + part_of_name(name) + "_total", help, labels, counter.value);
}

void add_bus(Exposition& out, const Figures& figures, const Labels& labels)
{
    const report::GetStatusReply& status = figures.status;
    const report::Bus& bus = status.bus;
    Labels build = labels;
    build.emplace_back("version", figures.version.version);
    out.gauge("dpslaved_build_info", "Always 1; the version is a label.", build, 1);
    out.gauge("dpslaved_uptime_seconds", "Since the start of the daemon.", labels,
              seconds(static_cast<double>(status.uptime_ms)));
    out.gauge("dpslaved_bus_port_open", "0: the port of the bus is gone.", labels, bus.port_open ? 1 : 0);
    out.gauge("dpslaved_bus_driver_works",
              "0: an edge of the driver enable failed, nothing is sent until it works again.", labels,
              bus.driver_works ? 1 : 0);
    out.gauge("dpslaved_bus_baud", "Rate of the bus in bit/s.", labels, static_cast<double>(bus.baud));
    if (bus.last_telegram_age_ms)
        out.gauge("dpslaved_bus_last_telegram_age_seconds",
                  "Since the last telegram with a checksum; missing if none was ever heard.", labels,
                  seconds(*bus.last_telegram_age_ms));
    out.gauge("dpslaved_bus_stations", "Stations that are configured.", labels,
              static_cast<double>(bus.stations));
    out.gauge("dpslaved_bus_stations_exchanging", "Stations that exchange data with a master.", labels,
              static_cast<double>(bus.exchanging));
    for (const report::Distribution& one : figures.counters.turnaround)
        if (one.unit == "us")
            out.histogram(
                "dpslaved_reply_turnaround_seconds",
                "From the read of the last octet of a request to the end of the write of its reply, in whole microseconds, rounded up.",
                labels, buckets_of(one, turnaround_uppers(), 1e6));
}

void add_station(Exposition& out, const report::Station& station, const Labels& bus)
{
    Labels labels = bus;
    labels.emplace_back("station", station.name);
    Labels info = labels;
    info.insert(info.end(), {{"address", std::to_string(station.address)},
                             {"profile", station.profile},
                             {"device", station.device}});
    out.gauge("dpslaved_station_info", "Always 1; address, profile and device are labels.", info, 1);
    std::set<std::string> states{"Power_On", "Wait_Prm", "Wait_Cfg", "Data_Exch"};
    states.insert(station.state);
    for (const std::string& state : states) {
        Labels with_state = labels;
        with_state.emplace_back("state", state);
        out.gauge("dpslaved_station_state", "1 for the state of the station, 0 for the others.", with_state,
                  state == station.state ? 1 : 0);
    }
    out.gauge("dpslaved_station_exchanging", "1: data exchange with a master.", labels,
              station.state == "Data_Exch" && !station.held ? 1 : 0);
    out.gauge("dpslaved_station_held",
              "1: data exchange does not start: a tag has no scale, or the drive denies it.", labels,
              station.held ? 1 : 0);
    out.gauge("dpslaved_station_clear", "1: the master is in Clear, every output is 0.", labels,
              station.clear ? 1 : 0);
    out.gauge("dpslaved_station_stat_diag", "1: Stat_Diag is set.", labels, station.stat_diag ? 1 : 0);
    out.gauge("dpslaved_station_silent", "1: the station is kept off the bus by its function block.", labels,
              station.silent_because ? 1 : 0);
    if (station.watchdog_ms)
        out.gauge("dpslaved_station_watchdog_seconds", "As the master set it; missing if it is off.", labels,
                  seconds(static_cast<double>(*station.watchdog_ms)));
}

Labels drive_labels(const std::string& station, const std::string& line, Labels labels)
{
    labels.emplace_back("line", line);
    labels.emplace_back("station", station);
    return labels;
}

void add_drive(Exposition& out, const report::Station& station, const Labels& bus,
               std::set<std::string>& lines)
{
    const report::Drive& drive = station.drive;
    if (lines.insert(drive.line).second) {
        Labels line = bus;
        line.emplace_back("line", drive.line);
        out.gauge("dpslaved_line_port_open", "0: the port of the drive line is gone.", line,
                  drive.port_open ? 1 : 0);
    }
    if (drive.stalled_ms)
        out.gauge("dpslaved_drive_line_stalled_seconds", "A call of the port does not come back.",
                  drive_labels(station.name, drive.line, bus), seconds(*drive.stalled_ms));
    const Labels labels = drive_labels(station.name, drive.line, bus);
    if (drive.link != "unknown")
        out.gauge("dpslaved_drive_answers", "0: the drive is silent; missing if nothing was asked yet.",
                  labels, drive.link == "answers" || drive.link == "returning" ? 1 : 0);
    out.gauge("dpslaved_drive_gone", "1: the drive is gone, and the master sees it (when_drive_lost).",
              labels, drive.link == "gone" ? 1 : 0);
    if (drive.cycle_ms)
        out.gauge("dpslaved_drive_last_refresh_seconds", "The last round over the parameters of the drive.",
                  labels, seconds(*drive.cycle_ms));
}

/// The groups are those of the bus, of each station and of the control socket, in this order.
void add_counters(Exposition& out, const Figures& figures, const Labels& bus)
{
    const auto add = [&out](const report::CounterGroup& group, const char* prefix, const Labels& labels) {
        for (const report::Counter& counter : group.counters) add_counter(out, prefix, labels, counter);
    };
    const auto& groups = figures.counters.groups;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (i == 0) add(groups[i], "dpslaved_bus_", bus);
        if (i != 0 && i + 1 == groups.size()) add(groups[i], "dpslaved_control_", bus);
        if (i == 0 || i + 1 == groups.size()) continue;
        for (const report::Station& one : figures.status.stations) // one that has just come has no line yet
            if (one.name == groups[i].name)
                add(groups[i], "dpslaved_station_", drive_labels(one.name, one.drive.line, bus));
    }
    for (const report::Refresh& one : figures.counters.refresh)
        out.histogram("dpslaved_drive_refresh_seconds",
                      "Rounds over the parameters of the drive, in whole milliseconds, rounded up.",
                      drive_labels(one.station, one.line, bus),
                      buckets_of(one.rounds, refresh_uppers(), 1e3));
}

} // namespace

std::string render_metrics(const Figures& figures, const std::string& socket)
{
    Exposition out;
    const Labels bus{{"bus", figures.status.bus.port}};
    out.gauge(kUp, kUpHelp, {{"socket", socket}}, 1);
    add_bus(out, figures, bus);
    std::set<std::string> lines;
    for (const report::Station& station : figures.status.stations) {
        add_station(out, station, bus);
        add_drive(out, station, bus, lines);
    }
    add_counters(out, figures, bus);
    return out.text();
}

std::string render_metrics_of_none(const std::string& socket)
{
    Exposition out;
    out.gauge(kUp, kUpHelp, {{"socket", socket}}, 0);
    return out.text();
}

} // namespace dpslave::dpctl
