// SPDX-License-Identifier: Apache-2.0
#include "report.hpp"

#include "emulated_device.hpp"

#include "dpslave/report/demand.hpp"
#include "dpslave/report/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

namespace {

double milliseconds(std::chrono::nanoseconds time)
{
    return std::chrono::duration<double, std::milli>(time).count();
}

/// How long ago `then` was; nothing for "never".
std::optional<double> age(Instant then, Instant now)
{
    return then == Instant{} ? std::nullopt : std::optional{milliseconds(now - then)};
}

std::optional<std::string> unless_empty(const std::string& words)
{
    return words.empty() ? std::nullopt : std::optional{words};
}

std::string_view link_text(const Station& station)
{
    if (station.drive.presence == drive::DrivePresence::gone) return "gone";
    if (station.drive.presence == drive::DrivePresence::returning) return "returning";
    if (!station.line_open) return "silent";
    if (!station.drive.known) return "unknown";
    return station.drive.answers ? "answers" : "silent";
}

report::Drive drive_report(const Station& station)
{
    const drive::DriveSnapshot& drive = station.drive;
    const config::LineConfig& line = *station.line;
    report::Drive result;
    result.line = line.name;
    result.port = line.port;
    result.protocol = line.protocol;
    result.unit = station.config->unit_text;
    result.link = link_text(station);
    result.port_open = station.line_open;
    result.ever_answered = station.ever_answered;
    if (drive.not_zeroed != 0) result.not_zeroed = drive.not_zeroed;
    result.baud = line.baud;
    result.format = drive::text(line.format);
    result.direction = io::text(line.driver_enable.direction);
    result.timeout_ms = line.timeout.count();
    if (drive.cycle.count() > 0) result.cycle_ms = milliseconds(drive.cycle);
    result.reads = integer(drive.reads);
    result.writes = integer(drive.writes);
    result.silences = integer(drive.silences);
    result.refusals = integer(drive.refusals);
    result.losses = integer(drive.losses);
    if (!station.troubles.empty()) result.last_trouble = station.troubles.back().text.data();
    if (station.line_stalled.count() != 0) result.stalled_ms = milliseconds(station.line_stalled);
    if (const std::string_view call = io::name(station.stalled_in); result.stalled_ms && !call.empty())
        result.stalled_in = call;
    if (!station.port_settings.empty()) result.port_settings = station.port_settings;
    return result;
}

/// Nothing: the outputs do not outlive a master. `ends_in_ms` null: they do for ever.
std::optional<report::Ride> ride_report(const Station& station, Instant now)
{
    const auto ends = station.drive.ride_ends;
    if (!ends) return std::nullopt;
    return *ends == kNever ? report::Ride{} : report::Ride{milliseconds(std::max(*ends, now) - now)};
}

std::vector<report::Unanswered> unanswered_report(const View& view, Instant now)
{
    std::vector<report::Unanswered> all;
    for (const dp::UnansweredAddress& one : view.bus.unanswered)
        if (one.requests != 0 && !is_ours(view, one.address))
            all.push_back({one.address, one.master, integer(one.requests), milliseconds(now - one.last)});
    return all;
}

std::string demand_words(const config::StationConfig& station, const dp::Snapshot& bus)
{
    report::DemandNames names;
    names.value = [&station](std::uint16_t tag, std::uint16_t word) {
        return shown_value(*station.tags, tag, word);
    };
    return report::demand_words(bus.demand_request, bus.demand_reply,
                                station.personality->demand == dp::DemandForm::extended, names);
}

/// A master exchanges data with it. Held at the start it is in the state and exchanges nothing.
bool exchanges(const Station& station)
{
    return station.bus.state == dp::State::data_exch && station.bus.hold == StartHold::none;
}

std::ptrdiff_t exchanging(const View& view)
{
    return std::count_if(view.stations.begin(), view.stations.end(), exchanges);
}

/// As a controller shows it in its Comms list (C-007).
std::optional<std::string> comms_status(const Station& station)
{
    if (station.config->profile->leds != led::Language::controller) return std::nullopt;
    return station.bus.state == dp::State::data_exch ? "run" : "rdY";
}

/// HEALTH and RUN of a technology box mirror a bit of the drive, where one is configured.
bool is_fed(const config::StationConfig& station, std::string_view lamp)
{
    if (!station.tec) return true;
    if (lamp == "health") return station.tec->health.tag != 0;
    return lamp != "run" || station.tec->run.tag != 0;
}

} // namespace

std::string shown_value(const drive::TagTable& tags, std::uint16_t tag, std::uint16_t word)
{
    const drive::Tag* row = tags.find(tag);
    return row != nullptr ? drive::displayed(*row, word) : fmt::format(">{:04X}", word);
}

report::Bus bus_report(const View& view, Instant now)
{
    report::Bus result;
    result.port = view.config->bus.port;
    result.baud = integer(view.bus.baud);
    result.baud_state = fdl::text(view.bus.baud_state);
    if (view.config->bus.baud) result.configured_baud = integer(*view.config->bus.baud);
    result.port_open = view.bus.port_open;
    result.driver_works = view.bus.driver_works;
    result.listens = view.config->bus.listen;
    result.unanswered = unanswered_report(view, now);
    result.stations = integer(view.stations.size());
    result.exchanging = exchanging(view);
    result.last_telegram_age_ms = age(view.bus.last_telegram, now);
    if (!view.bus_trouble.empty()) result.trouble = view.bus_trouble;
    if (!view.port_settings.empty()) result.port_settings = view.port_settings;
    return result;
}

report::Station station_report(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    report::Station result;
    result.name = station.config->name;
    result.address = station.address;
    result.profile = station.config->profile->name;
    result.device = station.config->profile->device;
    result.state = dp::text(bus.state);
    if (bus.master != 0xFF) result.master = bus.master;
    if (bus.watchdog_on) result.watchdog_ms = bus.watchdog.count();
    result.min_tsdr = bus.min_tsdr.count;
    result.groups = bus.groups;
    result.sync = bus.sync;
    result.freeze = bus.freeze;
    result.clear = bus.clear;
    result.held = bus.hold != StartHold::none;
    if (result.held) result.held_because = report::text(bus.hold);
    result.ride = ride_report(station, now);
    result.silent_because = unless_empty(station.silent_because);
    result.stat_diag = bus.stat_diag;
    result.diag_pending = bus.diag_pending;
    result.parameters = integer(bus.layout.count);
    result.demand_data = bus.demand_data;
    result.left_count = integer(bus.counters.left_data_exchange);
    if (bus.left_because != dp::LeaveReason::none) {
        result.left_because = dp::text(bus.left_because);
        result.left_code = report::code(bus.left_because);
    }
    result.drive = drive_report(station);
    return result;
}

std::vector<report::Station> stations_report(const View& view, Instant now)
{
    std::vector<report::Station> all;
    for (const Station& one : view.stations) all.push_back(station_report(one, now));
    return all;
}

report::Info info_report(const Station& station, std::optional<std::uint8_t> pending,
                         const std::vector<std::string>& notes)
{
    const config::StationConfig& config = *station.config;
    const profile::Profile& profile = *config.profile;
    const dp::Personality& personality = *config.personality;
    const std::size_t demand_octets = personality.demand == dp::DemandForm::none ? 0 : dp::kDemandOctets;
    std::size_t most_octets = demand_octets + 2 * personality.max_parameters;
    if (personality.max_words != 0) most_octets = std::min(most_octets, 2 * personality.max_words);
    report::Info result;
    result.name = config.name;
    result.profile = profile.name;
    result.device = profile.device;
    result.order_code = profile.order_code;
    result.firmware = profile.firmware;
    result.manual = profile.manual;
    result.ident = personality.ident;
    result.address_active = station.address;
    result.address_pending = pending;
    result.address_min = profile.min_address;
    result.address_max = profile.max_address;
    result.max_parameters = integer(personality.max_parameters);
    result.max_input_octets = result.max_output_octets = integer(most_octets);
    result.max_diag_octets = integer(personality.max_diag_length);
    result.demand_data = personality.demand != dp::DemandForm::none;
    result.sync = personality.sync;
    result.freeze = personality.freeze;
    for (std::size_t i = 0; i < kBauds.size(); ++i) {
        if (personality.max_tsdr[i].count == 0) continue;
        result.bauds.push_back(integer(kBauds[i]));
        result.max_tsdr.push_back(personality.max_tsdr[i].count);
    }
    if (config.keys.tags_at) result.tags_at = integer(*config.keys.tags_at);
    for (const dp::Identifier& one : config.keys.identifiers)
        result.identifiers.push_back(profile::to_string(one));
    result.tag_table = config.tag_file;
    result.tags_in_table = integer(config.tags->all().size());
    result.option_software = unless_empty(profile.option_software);
    result.comms_status = comms_status(station);
    if (profile.selectable_resolution) result.resolution = config.integer_resolution ? "integer" : "full";
    if (profile.mnemonics != drive::MnemonicRule::none) result.mnemonic_rule = drive::text(profile.mnemonics);
    result.mnemonic_source = unless_empty(profile.mnemonic_source);
    result.mnemonics_assumed = profile.mnemonics_assumed;
    result.notes = notes;
    return result;
}

std::vector<report::Word> words_report(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    const drive::DriveSnapshot& drive = station.drive;
    const bool same_layout = drive.generation == bus.layout.generation;
    std::int64_t in_octet = bus.demand_data ? 8 : 0;
    std::int64_t out_octet = in_octet;
    std::vector<report::Word> words;
    const auto add = [&](std::size_t i, bool input) {
        report::Word result;
        const std::uint16_t tag = bus.layout.parameters[i].tag;
        const std::uint16_t raw = input ? bus.inputs[i] : bus.outputs[i];
        std::int64_t& octet = input ? in_octet : out_octet;
        result.tag = tag;
        if (const drive::Tag* row = station.config->tags->find(tag)) result.name = row->name;
        result.direction = input ? "in" : "out";
        result.octet = octet;
        result.raw = raw;
        result.value = shown_value(*station.config->tags, tag, raw);
        result.state = report::code(same_layout ? drive.states[i] : WordState::untried);
        if (same_layout) {
            if (drive.errors[i] == AccessError::contradicted) result.state = "contradicted";
            result.answer = unless_empty(drive.answer_texts[i].data());
            result.age_ms = age(drive.updated_at[i], now);
        }
        words.push_back(std::move(result));
        octet += 2;
    };
    for (std::size_t i = 0; i < bus.layout.count; ++i) {
        if (bus.layout.parameters[i].reads) add(i, true);
        if (bus.layout.parameters[i].writes) add(i, false);
    }
    return words;
}

report::StationIo io_report(const Station& station, Instant now)
{
    const dp::Snapshot& bus = station.bus;
    report::StationIo result{.name = station.config->name,
                             .address = station.address,
                             .state = std::string{dp::text(bus.state)},
                             .may_write = bus.may_write,
                             .clear = bus.clear,
                             .sync = bus.sync,
                             .freeze = bus.freeze,
                             .words = words_report(station, now)};
    const auto registers = [](const auto& words) {
        return std::vector<std::int64_t>(words.begin(), words.end());
    };
    if (bus.demand_data)
        result.demand = {.request = registers(bus.demand_request),
                         .reply = registers(bus.demand_reply),
                         .words = demand_words(*station.config, bus)};
    return result;
}

std::string status_line(const View& view)
{
    std::string line = view.config->bus.listen
                           ? std::string{"only listens"}
                           : fmt::format("{} of {} in Data_Exch", exchanging(view), view.stations.size());
    if (!view.bus.port_open)
        line += view.bus_trouble.empty() ? "; the port of the bus is missing" : "; " + view.bus_trouble;
    for (const Station& one : view.stations) {
        line += fmt::format("; {}: {}", one.config->name, dp::text(one.bus.state));
        if (one.bus.master != 0xFF) line += fmt::format(" with master {}", one.bus.master);
        if (one.bus.hold != StartHold::none) line += fmt::format(", held: {}", report::text(one.bus.hold));
        if (one.bus.clear) line += " in Clear";
        if (one.drive.ride_ends) line += ", RIDE THROUGH";
        if (one.line_stalled.count() != 0)
            line += ", line stalled";
        else if (!one.line_open)
            line += ", port of the drive gone";
        else if (one.drive.known && !one.drive.answers)
            line += ", drive silent";
    }
    return line;
}

report::Tec tec_report(const std::string& station, const EmulatedDevice& device)
{
    report::Tec result;
    result.name = station;
    result.view = device.tec()->settings().type == tec::kProfibusDp ? "profibus" : "generic";
    for (const tec::Row& row : device.tec()->rows())
        result.rows.push_back({std::string{row.name}, std::string{row.generic_name}, row.is_input,
                               integer(row.value), row.shown, std::string{row.range}});
    result.trip = device.trip();
    result.trip_tag = device.trip_tag();
    result.tripped = device.tripped();
    result.notes = device.notes();
    return result;
}

report::StationLeds leds_report(const config::StationConfig& station, const led::Condition& condition,
                                Instant now)
{
    report::StationLeds result{station.name, std::string{led::meaning(station.profile->leds, condition)}};
    for (const led::Lamp& lamp : led::lamps(station.profile->leds, condition)) {
        const auto wired =
            std::find_if(station.leds.begin(), station.leds.end(),
                         [&lamp](const config::LedConfig& one) { return one.lamp == lamp.name; });
        result.leds.push_back({std::string{lamp.name}, wired == station.leds.end() ? "none" : wired->sink,
                               led::lit(lamp.pattern, now),
                               is_fed(station, lamp.name)
                                   ? std::string{led::words(station.profile->leds, lamp.pattern)}
                                   : "not configured: no bit of the drive feeds it",
                               std::nullopt});
    }
    return result;
}

} // namespace dpslave::app
