// SPDX-License-Identifier: Apache-2.0
// [[station]]: one PROFIBUS slave address, its device type and its drive.
#include "parts.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/io/led_sink.hpp"
#include "dpslave/toml/wording.hpp"

#include <algorithm>
#include <charconv>

namespace dpslave::config {
namespace {

using profile::Profile;
using toml::Document;
using toml::in_quotes;
using toml::Place;
using toml::Table;

constexpr std::ptrdiff_t kMostStations = 126; ///< addresses of a bus, 0 to 125

/// EI-ASCII: one hexadecimal digit for the group, one for the unit.
std::optional<drive::UnitAddress> ei_unit(std::string_view text)
{
    std::uint8_t both = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), both, 16);
    if (text.size() != 2 || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return drive::UnitAddress{static_cast<std::uint8_t>(both >> 4), static_cast<std::uint8_t>(both & 15)};
}

/// Modbus: a slave address in decimal.
std::optional<drive::UnitAddress> modbus_unit(std::string_view text)
{
    std::uint8_t address = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), address);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    if (address < 1 || address > 247) return std::nullopt;
    return drive::UnitAddress{.group = 0, .unit = address};
}

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

/// What stands on a command line as it is, and never looks like an option.
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
                  const std::vector<ReadLine>& lines, Shelf& shelf, toml::Faults& warnings)
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
            table.refuse("name", "station name " + in_quotes(station.name) +
                                     " cannot be used on a command line: use letters, digits, '_', '-' and "
                                     "'.', 32 at most, and do not begin with '-'.");
        if (!station.name.empty())
            names_.check(table, "name", station.name, "station name " + in_quotes(station.name),
                         "give each station a name of its own");
        read_profile(table, station);
        read_address(table, station);
        read_drive(table, station);
        read_behaviour(table, station);
        read_personality(table, station);
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
            what += "write " + toml::listed(names) + ".";
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
            warn(table.place_of("address"), text + ": masters and engineering tools usually have 0 to 2; "
                                                   "check that no other device on the bus has it.");
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
        const auto parsed = modbus ? modbus_unit(*unit) : ei_unit(*unit);
        if (!parsed) {
            table.refuse("unit",
                         "unit " + in_quotes(*unit) +
                             (modbus ? ": write the Modbus address of the instrument, \"1\" to \"247\". The "
                                       "instrument itself also takes 248 to 254, which Modbus reserves: "
                                       "give it a lower one."
                                     : ": write two hexadecimal digits, the group and the unit id of the "
                                       "drive, as in \"00\"."));
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
                                                    : "write " + toml::listed(names) +
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
                                     " is reached by " + toml::listed(legal) + ": choose another line.");
    }

    void read_behaviour(Table& table, StationConfig& station)
    {
        if (const auto seconds = table.real("output_refresh_s", 0, 86'400))
            station.output_refresh =
                std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>{*seconds});
        enum class Loss : std::uint8_t { zero, hold };
        const auto loss = table.choice<Loss>("output_loss", {{"zero", Loss::zero}, {"hold", Loss::hold}});
        if (station.profile) station.zero_after = station.profile->zero_after;
        if (table.has("output_loss") && station.profile && station.profile->has_tec)
            table.refuse(
                "output_loss",
                "a device of profile " + in_quotes(station.profile->name) +
                    " has a TEC OPTION function block, whose RIDE THROUGH alone decides what happens to "
                    "the outputs: remove 'output_loss' and set ride_through in [station.tec].");
        else if (loss == Loss::zero)
            station.zero_after = std::chrono::nanoseconds{0};
        else if (loss == Loss::hold)
            station.zero_after.reset();
    }

    /// The profile's, with what this station and this bus say otherwise.
    void read_personality(Table& table, StationConfig& station)
    {
        const auto ident = table.integer("ident", 1, 0xFFFF);
        Table demand = table.table("demand");
        const auto error_base = demand.integer("error_base", 0, 1);
        using Reply = dp::ExtendedReply;
        const auto extended =
            demand.choice<Reply>("extended_reply", {{"table", Reply::table}, {"example", Reply::example}});
        if (!station.profile) return;

        dp::Personality personality = station.profile->personality;
        if (!ident && !table.has("ident") && !station.profile->ident)
            document_.fault(table.place(),
                            "'ident' is missing in [[station]]: profile " + in_quotes(station.profile->name) +
                                " has none, because no source states it; add ident = 0x.... with the number "
                                "of the key Ident_Number in the GSD of the plant's PLC project.");
        if (ident) personality.ident = static_cast<std::uint16_t>(*ident);
        if (error_base && personality.demand == dp::DemandForm::none)
            demand.refuse("error_base", "profile " + in_quotes(station.profile->name) +
                                            " has no Demand Data: remove 'error_base'.");
        if (error_base) personality.demand_error_base = static_cast<std::uint16_t>(*error_base);
        if (demand.has("extended_reply") && personality.demand != dp::DemandForm::extended)
            demand.refuse("extended_reply", "profile " + in_quotes(station.profile->name) +
                                                " has no extended commands of Demand Data: remove "
                                                "'extended_reply'.");
        if (extended) personality.extended_reply = *extended;

        if (bus_.baud && personality.max_tsdr[index_of(*bus_.baud)].count == 0)
            table.refuse("profile", "profile " + in_quotes(station.profile->name) +
                                        " does not support the rate of the bus, " +
                                        std::to_string(static_cast<std::uint32_t>(*bus_.baud)) +
                                        " bit/s: its [max_tsdr] does not list it.");
        if (bus_.max_tsdr > 0) set_max_tsdr(personality, table);
        personality.tries_outputs = line_known_ && lines_[station.line].line.protocol == kEiAscii;
        station.personality = std::make_shared<const dp::Personality>(std::move(personality));
    }

    /// One for all rates; less than the GSD says is legal, and a warning.
    void set_max_tsdr(dp::Personality& personality, const Table& table)
    {
        bool warned = false;
        for (const Baud baud : kBauds) {
            Tbit& each = personality.max_tsdr[index_of(baud)];
            if (each.count == 0) continue;
            const bool is_used = !bus_.baud || *bus_.baud == baud;
            if (is_used && bus_.max_tsdr < each.count && !std::exchange(warned, true))
                warn(table.place(), "'max_tsdr' in [bus] is below the " + std::to_string(each.count) +
                                        " bit times of this station's profile at " +
                                        std::to_string(static_cast<std::uint32_t>(baud)) +
                                        " bit/s: answers that the master would still accept are suppressed. "
                                        "Name the rate of the bus, or a max_tsdr that suits all rates.");
            each = Tbit{bus_.max_tsdr};
        }
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
        const io::DriverEnableSettings& driver = bus_.driver_enable;
        const std::string drivers_line = "line:" + driver.gpio_chip + ':' + std::to_string(driver.gpio_line);
        const bool is_drivers =
            driver.direction == io::Direction::gpio &&
            io::led_sink_target(sink, sysfs_) == io::led_sink_target(drivers_line, sysfs_);
        return !is_drivers || refuse("this line switches the transceiver (gpio_line in [bus]): a lamp needs "
                                     "a line of its own.");
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
    toml::Faults& warnings_;
    Unlike names_, addresses_, drives_, sinks_;
    bool line_known_ = false; ///< of the station being read
};

} // namespace

std::vector<StationConfig> read_stations(Document& document, const BusConfig& bus,
                                         const std::filesystem::path& sysfs,
                                         const std::vector<ReadLine>& lines, Shelf& shelf,
                                         toml::Faults& warnings)
{
    std::vector<StationConfig> stations;
    StationReader reader{document, bus, sysfs, lines, shelf, warnings};
    Table root = document.root();
    std::vector<Table> tables = root.tables("station");
    if (bus.listen) refuse_beside_listen(document, tables, "station");
    if (std::ssize(tables) > kMostStations) {
        document.fault(
            tables[static_cast<std::size_t>(kMostStations)].place(),
            "there are more stations than addresses on a bus (0 to 125): remove those that are too "
            "many.");
        tables.erase(tables.begin() + kMostStations, tables.end());
    }
    for (Table& table : tables) stations.push_back(reader.read(table));
    if (stations.empty() && !bus.listen)
        document.fault(
            {},
            "there is no station: add a [[line]] with the drive's serial port and a [[station]] with name, "
            "address, profile, line and unit. To only listen on the bus: write listen = true under [bus].");
    return stations;
}

} // namespace dpslave::config
