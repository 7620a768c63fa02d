// SPDX-License-Identifier: Apache-2.0
// Reads the keys that only some device types have: the TEC OPTION function block, an extended diagnosis, two
// resolutions, a display of its own.
#include "parts.hpp"

#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <cmath>

namespace dpslave::config {
namespace {

using input::Document;
using input::Faults;
using input::in_quotes;
using input::Table;
using profile::DiagForm;

constexpr std::int64_t kHighestTag = 0xFFFF;

void read_lamp(Table& tec, const char* key, profile::MirroredLamp& lamp)
{
    const auto text = tec.text(key);
    if (!text) return;
    if (const auto parsed = profile::parse_lamp(*text))
        lamp = *parsed;
    else
        tec.refuse(key, "'" + std::string{key} + "' " + in_quotes(*text) +
                            R"(: write tag and bit of the drive, as in "272.3"; "!272.3" for a lamp that is )"
                            R"(lit while the bit is 0; "272" for any bit of the tag; or "none".)");
}

/// Any value that a PC tool could set is accepted, also one that no operator station would: FAULT = PARAMETER
/// shows it (B-049).
void read_setting(Table& tec, std::string_view key, std::int32_t& setting)
{
    if (const auto value = tec.integer(key, -32768, 65535)) setting = static_cast<std::int32_t>(*value);
}

std::uint16_t read_tag(Table& table, std::string_view key, std::int64_t lowest, std::uint16_t otherwise)
{
    const auto tag = table.integer(key, lowest, kHighestTag);
    return tag ? static_cast<std::uint16_t>(*tag) : otherwise;
}

/// The tag of the trip code by its number, or a bit that is set while the drive has tripped, as a lamp has
/// it. 0 = not known, whatever the profile says.
void read_trip(Table& tec, profile::TripSource& trip)
{
    if (!tec.has("trip_tag")) return;
    if (!tec.is_text("trip_tag")) {
        trip = {};
        trip.bit.tag = read_tag(tec, "trip_tag", 0, 0);
        return;
    }
    const auto text = tec.text("trip_tag");
    if (!text) return;
    if (const auto bit = profile::parse_lamp(*text))
        trip = {*bit, bit->tag == 0};
    else
        tec.refuse("trip_tag", "'trip_tag' " + in_quotes(*text) +
                                   R"(: write tag and bit of the drive, as in "272.3"; "!537.11" for a )"
                                   R"(trip while the bit is 0; "12" for any bit of the tag; or without )"
                                   R"(quotes the tag whose low octet is the trip code.)");
}

/// In the block 0 is "no trip": a missing tag must be reported elsewhere (X-50).
void warn_of_unknown_trips(const Document& document, const Table& table, const StationConfig& station,
                           Faults& warnings)
{
    if (station.tec->trip.bit.tag != 0) return;
    const input::Place at = table.place();
    warnings.push_back(
        {document.name(), at.line, at.column,
         "trips of station " + in_quotes(station.name) +
             " are not known: its diagnosis says \"no trip\" whatever the drive does; set trip_tag in [station.tec] to the tag of the trip code, or to a bit."});
}

void read_tec(Document& document, Table& table, StationConfig& station, Faults& warnings)
{
    const bool may_have = !station.profile || station.profile->has_tec;
    if (table.has("tec") && !may_have) {
        table.refuse("tec", "a device of profile " + in_quotes(station.profile->name) +
                                " has no TEC OPTION function block: remove [station.tec].");
        return;
    }
    Table tec = table.table("tec");
    TecConfig config;
    if (station.profile) {
        config.health = station.profile->health;
        config.run = station.profile->run;
        config.trip = station.profile->trip;
    }
    config.start.address = station.address;
    read_setting(tec, "type", config.start.type);
    read_setting(tec, "ext_diagnostic", config.start.ext_diagnostic);
    read_setting(tec, "int_diag_select", config.start.int_diag_select);
    read_setting(tec, "ride_through", config.start.ride_through);
    read_setting(tec, "unused_1", config.start.unused_1);
    read_trip(tec, config.trip);
    config.ext_diagnostic_tag = read_tag(tec, "ext_diagnostic_tag", 0, 0);
    read_lamp(tec, "health", config.health);
    read_lamp(tec, "run", config.run);
    if (config.start.ride_through != 0) {
        const input::Place at = tec.place_of("ride_through");
        warnings.push_back(
            {document.name(), at.line, at.column,
             "'ride_through' is " + std::to_string(config.start.ride_through) +
                 ": setting it to anything other than 0 could compromise safety, because the outputs then keep their values after the connection to the master is lost."});
    }
    if (!station.profile || !station.profile->has_tec) return;
    if (const OptionFault fault = tec::fault(config.start, {}); fault != OptionFault::none)
        warnings.push_back(
            {document.name(), table.place_of("tec").line, table.place_of("tec").column,
             "station " + in_quotes(station.name) + " will be silent on the bus: FAULT of TEC OPTION is " +
                 std::string{dpslave::text(fault)} +
                 (fault == OptionFault::type_mismatch ? ", because 'type' is not 2 (PROFIBUS DP)."
                                                      : ", because a value is out of its range.")});
    station.zero_after = tec::zero_after(config.start);
    station.tec = config;
    warn_of_unknown_trips(document, table, station, warnings);
}

void read_diagnosis(Table& table, StationConfig& station)
{
    const DiagForm form = station.profile ? station.profile->diagnosis : DiagForm::none;
    const std::string device =
        station.profile ? "a device of profile " + in_quotes(station.profile->name) : std::string{};
    const bool is_bit = table.boolean("ext_diag_bit").value_or(false);
    if (station.profile && form == DiagForm::none && table.has("ext_diag_bit"))
        table.refuse("ext_diag_bit", device + " has no extended diagnosis: remove 'ext_diag_bit'.");
    station.ext_diag_bit = is_bit;

    if (station.profile && form != DiagForm::status_word) {
        if (table.has("diagnosis"))
            table.refuse("diagnosis",
                         device + (form == DiagForm::none
                                       ? " has no extended diagnosis: remove [station.diagnosis]."
                                       : " reports its trip, no status word: remove [station.diagnosis]."));
        return;
    }
    Table diagnosis = table.table("diagnosis");
    station.status_tag = read_tag(diagnosis, "status_tag", 1,
                                  station.profile ? station.profile->status_tag : std::uint16_t{0});
}

/// A limit in counts of `from` decimals, in counts of `to`; towards the inside of the range.
std::int32_t rescaled(std::int32_t limit, unsigned from, unsigned to, bool is_lower)
{
    double counts = limit;
    for (; from < to; ++from) counts *= 10;
    for (; from > to; --from) counts /= 10;
    return static_cast<std::int32_t>(is_lower ? std::ceil(counts) : std::floor(counts));
}

void set_decimals(drive::Tag& tag, std::uint8_t decimals)
{
    if (tag.min) tag.min = rescaled(*tag.min, tag.decimals, decimals, true);
    if (tag.max) tag.max = rescaled(*tag.max, tag.decimals, decimals, false);
    tag.decimals = decimals;
    tag.decimals_known = true;
    tag.in_counts = false;
}

/// Integer resolution: a scaled value is read from the IEEE area, where it has its full value, and rounded.
/// Whole numbers and times (INT) are whole in the normal area already, and are no singles in the IEEE area:
/// they stay. That area has two registers a tag from 8000h on; tags above 16383 are not in it and stay too.
void make_integer(drive::Tag& tag)
{
    constexpr std::uint16_t ieee_area = 0x8000;
    const std::uint16_t number = tag.modbus_register.value_or(tag.number);
    if (number >= ieee_area / 2 && number < ieee_area) return;
    set_decimals(tag, 0);
    if (number < ieee_area) tag.modbus_register = static_cast<std::uint16_t>(ieee_area + 2 * number);
}

/// With integer resolution the display decimals do not matter: the IEEE area has full values whatever they
/// say.
void add_scale_registers(StationConfig& station, std::optional<std::int64_t> display_decimals)
{
    const profile::Profile& profile = *station.profile;
    if (station.integer_resolution) return;
    if (profile.resolution_tag != 0) station.scale_registers.push_back({.tag = profile.resolution_tag});
    if (profile.display_decimals_tag != 0 && display_decimals)
        station.scale_registers.push_back({.tag = profile.display_decimals_tag,
                                           .expected = static_cast<std::uint16_t>(*display_decimals),
                                           .only_display = true});
}

void read_resolution(Table& table, StationConfig& station)
{
    const bool selectable = !station.profile || station.profile->selectable_resolution;
    const auto integer = table.choice<bool>("resolution", {{"full", false}, {"integer", true}});
    if (table.has("resolution") && !selectable)
        table.refuse("resolution", "a device of profile " + in_quotes(station.profile->name) +
                                       " has one resolution only: remove 'resolution'.");
    station.integer_resolution = integer.value_or(false);

    const auto decimals = table.integer("display_decimals", 0, 4);
    if (!station.tags) return;
    const auto& rows = station.tags->all();
    const bool has_display =
        std::any_of(rows.begin(), rows.end(), [](const drive::Tag& tag) { return tag.follows_display; });
    if (station.profile) add_scale_registers(station, decimals);
    if (table.has("display_decimals") && !has_display)
        table.refuse("display_decimals", "no tag of " + station.tag_file +
                                             " has decimals \"display\": remove 'display_decimals'.");
    const bool scales = station.profile && station.profile->selectable_resolution;
    if (!station.integer_resolution && !decimals && !scales) return;

    std::vector<drive::Tag> tags = rows;
    if (scales) drive::mark_counts(tags);
    for (drive::Tag& tag : tags) {
        if (!tag.is_real) continue;
        if (station.integer_resolution)
            make_integer(tag);
        else if (tag.follows_display && decimals)
            set_decimals(tag, static_cast<std::uint8_t>(*decimals));
        else if (tag.follows_display)
            tag.in_counts = scales; // nothing says how many decimals the display has
    }
    station.tags = std::make_shared<const drive::TagTable>(std::move(tags));
}

void choose_watched(StationConfig& station)
{
    std::vector<std::uint16_t> wanted{station.status_tag};
    if (station.tec)
        wanted.insert(wanted.end(), {station.tec->trip.bit.tag, station.tec->ext_diagnostic_tag,
                                     station.tec->health.tag, station.tec->run.tag});
    for (const std::uint16_t tag : wanted) {
        auto& known = station.watched;
        if (tag != 0 && std::find(known.begin(), known.end(), tag) == known.end()) known.push_back(tag);
    }
}

} // namespace

void read_device_keys(Document& document, Table& table, StationConfig& station, Faults& warnings)
{
    read_tec(document, table, station, warnings);
    read_diagnosis(table, station);
    read_resolution(table, station);
    choose_watched(station);
}

} // namespace dpslave::config
