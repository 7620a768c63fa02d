// SPDX-License-Identifier: Apache-2.0
// [[station]]: one PROFIBUS slave address, its device type and its drive.
#include "parts.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/io/led_sink.hpp"

#include <algorithm>

namespace dpslave::config {
namespace {

using input::Document;
using input::in_quotes;
using input::Place;
using input::Table;
using profile::Profile;

constexpr std::ptrdiff_t kMostStations = 126; ///< addresses of a bus, 0 to 125

/// A number as it is written in a file: "12", "0x1F", "-5", "1.5".
bool is_number(std::string_view name)
{
    if (name.starts_with('+') || name.starts_with('-')) name.remove_prefix(1);
    const bool is_hex = name.starts_with("0x") || name.starts_with("0X");
    const std::string_view digits = is_hex ? name.substr(2) : name;
    const std::string_view legal = is_hex ? "0123456789abcdefABCDEF" : "0123456789.";
    return !digits.empty() && digits.find_first_not_of(legal) == std::string_view::npos;
}

/// A letter of any language counts where a terminal shows it in one word: no space, no sign of punctuation.
bool is_letter(std::uint32_t code)
{
    const auto within = [code](std::uint32_t from, std::uint32_t to) { return from <= code && code <= to; };
    const bool is_sign = code == 0xD7 || code == 0xF7 || code == 0x061C || code == 0x1680 || code == 0x180E;
    return within('A', 'Z') || within('a', 'z') ||
           (!is_sign && (within(0xC0, 0x1FFF) || within(0x2C00, 0x2DFF) || within(0x3005, 0xD7FF)));
}

/// Returns whether the name can be typed on a command line as it is, and never looks like an option.
bool is_station_name(std::string_view name)
{
    constexpr std::size_t longest = 32;
    if (name.starts_with('-')) return false;
    std::size_t count = 0;
    while (!name.empty()) {
        const std::size_t length = character_length(name);
        const char first = name.front();
        const bool is_other = (first >= '0' && first <= '9') || first == '_' || first == '-' || first == '.';
        if (length == 0 || (!is_other && !is_letter(code_point(name.substr(0, length))))) return false;
        name.remove_prefix(length);
        ++count;
    }
    return count <= longest;
}

class StationReader {
public:
    StationReader(Document& document, const BusConfig& bus, const std::filesystem::path& sysfs,
                  const std::vector<ReadLine>& lines, Shelf& shelf, input::Faults& warnings)
        : document_(document), bus_(bus), sysfs_(sysfs), lines_(lines), shelf_(shelf), warnings_(warnings)
    {}

    StationConfig read(Table& table)
    {
        StationConfig station;
        table.require("name", R"(name = "unwinder", which dpctl uses for it)");
        station.name = table.text("name").value_or("");
        if (is_number(station.name))
            table.refuse("name",
                         "station name " + in_quotes(station.name) +
                             " is a number, which dpctl would take for an address: begin it with a letter.");
        else if (!is_station_name(station.name))
            table.refuse(
                "name",
                "station name " + in_quotes(station.name) +
                    " cannot be used on a command line: use letters, digits, '_', '-' and '.', 32 at most, and do not begin with '-'.");
        if (!station.name.empty())
            names_.check(table, "name", station.name, "station name " + in_quotes(station.name),
                         "give each station a name of its own");
        read_profile(table, station);
        read_address(table, station);
        read_drive(table, station);
        read_behaviour(table, station);
        const bool is_ei_ascii = line_known_ && lines_[station.line].line.protocol == kEiAscii;
        read_personality(document_, table, bus_, is_ei_ascii, station, warnings_);
        const std::string_view protocol =
            line_known_ ? lines_[station.line].line.protocol : std::string_view{};
        read_tag_keys(document_, table, station, shelf_, protocol);
        read_leds(table, station);
        read_device_keys(document_, table, station, warnings_);
        read_write_limits(table, station);
        judge_tags(document_, table, station, protocol, warnings_);
        return station;
    }

private:
    void read_profile(Table& table, StationConfig& station)
    {
        const auto& names = shelf_.names();
        table.require("profile", "profile = " + in_quotes(names.empty() ? "590" : names.front()));
        const auto name = table.text("profile");
        if (!name) return;
        if (std::find(names.begin(), names.end(), *name) != names.end()) {
            station.profile = shelf_.profile(*name);
            return;
        }
        const std::string folder = shelf_.folder().string();
        std::string what = "there is no profile " + in_quotes(*name) + " in " + folder + ": ";
        if (names.empty())
            what += "the folder holds no profile at all; name the right one with --profiles.";
        else
            what += "write " + input::listed(names) + ".";
        table.refuse("profile", std::move(what));
    }

    void read_address(Table& table, StationConfig& station)
    {
        table.require("address", "address = 5");
        const auto value = table.integer("address", 0, 127);
        if (!value) return;
        station.address = static_cast<std::uint8_t>(*value);
        const std::string text = "address " + std::to_string(*value);
        const int min = station.profile ? station.profile->min_address : 0;
        const int max = station.profile ? station.profile->max_address : 125;
        const std::string range = std::to_string(min) + " to " + std::to_string(max);
        if (*value > 125)
            table.refuse("address", text +
                                        (*value == 126 ? " is for stations that have no address yet"
                                                       : " is for telegrams to all stations") +
                                        ": choose one from " + range + ".");
        else if (*value < min || *value > max)
            table.refuse("address", text + " is not an address of profile " +
                                        in_quotes(station.profile->name) + ": choose one from " + range +
                                        ".");
        else if (*value <= 2)
            warn(
                table.place_of("address"),
                text +
                    ": masters and engineering tools usually have 0 to 2; check that no other device on the bus has it.");
        addresses_.check(table, "address", std::to_string(*value), text,
                         "give each station of the bus an address of its own");
    }

    void read_drive(Table& table, StationConfig& station)
    {
        table.require("line", lines_.empty() || lines_.front().line.name.empty()
                                  ? R"(line = "p3", the name of a [[line]])"
                                  : "line = " + in_quotes(lines_.front().line.name));
        if (const auto name = table.text("line")) find_line(table, station, *name);
        table.require("unit", R"(unit = "00", group and unit id of the drive, or its Modbus address)");
        const auto unit = table.text("unit");
        if (!unit) return;
        station.unit_text = *unit;
        if (!line_known_ || lines_[station.line].line.protocol.empty()) return; // said there already
        const bool modbus = lines_[station.line].line.protocol == kModbusRtu;
        const auto parsed =
            drive::unit_of(modbus ? drive::LineProtocol::modbus_rtu : drive::LineProtocol::ei_ascii, *unit);
        if (!parsed) {
            table.refuse(
                "unit",
                "unit " + in_quotes(*unit) +
                    (modbus
                         ? ": write the Modbus address of the instrument, \"1\" to \"247\". The instrument itself also takes 248 to 254, which Modbus reserves: give it a lower one."
                         : ": write two hexadecimal digits, the group and the unit id of the drive, as in \"00\"."));
            return;
        }
        station.unit = *parsed;
        const std::string& line = lines_[station.line].line.name;
        drives_.check(table, "unit",
                      std::to_string(station.line) + '/' + std::to_string(parsed->group * 16 + parsed->unit),
                      "unit " + in_quotes(*unit) + " of drive line " + in_quotes(line),
                      "one drive serves one station only");
    }

    void warn_of_rate(Table& table, const StationConfig& station)
    {
        const std::uint32_t rate = lines_[station.line].line.baud;
        if (!station.profile || !station.profile->recommended_baud ||
            *station.profile->recommended_baud == rate)
            return;
        warn(table.place_of("line"), "the line of this station runs at " + std::to_string(rate) +
                                         " bit/s; for a " + station.profile->name + " " +
                                         std::to_string(*station.profile->recommended_baud) +
                                         " is recommended; with another rate the link may perform worse");
    }

    void find_line(Table& table, StationConfig& station, const std::string& name)
    {
        line_known_ = false;
        std::vector<std::string> names;
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            names.push_back(lines_[i].line.name);
            if (lines_[i].line.name != name || line_known_) continue;
            station.line = i;
            line_known_ = true;
        }
        if (!line_known_) {
            table.refuse("line", "there is no line " + in_quotes(name) + ": " +
                                     (names.empty() ? "add a [[line]] with this name."
                                                    : "write " + input::listed(names) +
                                                          ", or add a [[line]] with this name."));
            return;
        }
        warn_of_rate(table, station);
        const std::string& protocol = lines_[station.line].line.protocol;
        if (!station.profile || protocol.empty()) return; // none that is legal: said at the line
        const auto& legal = station.profile->protocols;
        if (std::find(legal.begin(), legal.end(), protocol) == legal.end())
            table.refuse("line", "line " + in_quotes(name) + " speaks " + protocol +
                                     ", but a device of profile " + in_quotes(station.profile->name) +
                                     " is reached by " + input::listed(legal) + ": choose another line.");
    }

    void read_behaviour(Table& table, StationConfig& station)
    {
        if (const auto seconds = table.real("output_refresh_s", 0, 86'400))
            station.output_refresh =
                std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>{*seconds});
        using drive::WhenLost;
        if (const auto when = table.choice<WhenLost>(
                "when_drive_lost",
                {{"silent", WhenLost::silent}, {"diagnosis", WhenLost::diagnosis}, {"hold", WhenLost::hold}}))
            station.loss.when = *when;
        if (const auto seconds = table.real("drive_lost_after_s", 0.5, 600))
            station.loss.after =
                std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>{*seconds});
        enum class Loss : std::uint8_t { zero, hold };
        const auto loss = table.choice<Loss>("output_loss", {{"zero", Loss::zero}, {"hold", Loss::hold}});
        if (station.profile) station.zero_after = station.profile->zero_after;
        if (table.has("output_loss") && station.profile && station.profile->has_tec)
            table.refuse(
                "output_loss",
                "a device of profile " + in_quotes(station.profile->name) +
                    " has a TEC OPTION function block, whose RIDE THROUGH alone decides what happens to the outputs: remove 'output_loss' and set ride_through in [station.tec].");
        else if (loss == Loss::zero)
            station.zero_after = std::chrono::nanoseconds{0};
        else if (loss == Loss::hold)
            station.zero_after.reset();
    }

    void read_leds(Table& table, StationConfig& station)
    {
        Table leds = table.table("leds");
        if (!leds.exists() || !station.profile) return;
        std::vector<std::string> lamps;
        for (const led::Lamp& lamp : led::lamps(station.profile->leds, led::Condition{}))
            lamps.emplace_back(lamp.name);
        for (const std::string& lamp : lamps) {
            const auto sink = leds.text(lamp);
            if (!sink || !legal_sink(leds, lamp, *sink)) continue;
            sinks_.check(leds, lamp, io::led_sink_target(*sink, sysfs_),
                         "the LED of sink " + in_quotes(*sink), "give each lamp an LED of its own");
            station.leds.push_back({lamp, *sink});
        }
    }

    bool legal_sink(Table& leds, const std::string& lamp, const std::string& sink) const
    {
        const auto refuse = [&](const std::string& what) {
            leds.refuse(lamp, "sink " + in_quotes(sink) + ": " + what);
            return false;
        };
        if (const auto trouble = io::judge_led_sink(sink)) return refuse(*trouble + ".");
        const auto is_drivers = [&](const io::DriverEnableSettings& driver) {
            return driver.direction == io::Direction::gpio &&
                   io::led_sink_target(sink, sysfs_) == gpio_target(driver, sysfs_);
        };
        const std::string remedy = "): a lamp needs a line of its own.";
        if (is_drivers(bus_.driver_enable))
            return refuse("this line switches the transceiver (gpio_line in [bus]" + remedy);
        for (const auto& [line, name_at] : lines_)
            if (is_drivers(line.driver_enable))
                return refuse("this line switches the transceiver of line " + in_quotes(line.name) +
                              " (gpio_line in [[line]]" + remedy);
        return true;
    }

    void warn(Place at, std::string what)
    {
        warnings_.push_back({document_.name(), at.line, at.column, std::move(what)});
    }

    Document& document_;
    const BusConfig& bus_;
    const std::filesystem::path& sysfs_;
    const std::vector<ReadLine>& lines_;
    Shelf& shelf_;
    input::Faults& warnings_;
    Unlike names_, addresses_, drives_, sinks_;
    bool line_known_ = false; ///< of the station being read
};

} // namespace

std::vector<StationConfig> read_stations(Document& document, const BusConfig& bus,
                                         const std::filesystem::path& sysfs,
                                         const std::vector<ReadLine>& lines, Shelf& shelf,
                                         input::Faults& warnings)
{
    std::vector<StationConfig> stations;
    StationReader reader{document, bus, sysfs, lines, shelf, warnings};
    Table root = document.root();
    std::vector<Table> tables = root.tables("station");
    if (bus.listen) refuse_beside_listen(document, tables, "station");
    if (std::ssize(tables) > kMostStations) {
        document.fault(
            tables[static_cast<std::size_t>(kMostStations)].place(),
            "there are more stations than addresses on a bus (0 to 125): remove those that are too many.");
        tables.erase(tables.begin() + kMostStations, tables.end());
    }
    for (Table& table : tables) stations.push_back(reader.read(table));
    if (stations.empty() && !bus.listen)
        document.fault(
            {},
            "there is no station: add a [[line]] with the drive's serial port and a [[station]] with name, address, profile, line and unit. To only listen on the bus: write listen = true under [bus].");
    return stations;
}

} // namespace dpslave::config
