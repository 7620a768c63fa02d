// SPDX-License-Identifier: Apache-2.0
#include "render_top.hpp"

#include "dpctl/cli/columns.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"
#include "grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kEventsOfAPipe = 8;
constexpr std::size_t kSparkColumns = 40;

std::string clock_text(double unix_seconds, bool with_milliseconds)
{
    using std::chrono::system_clock;
    const auto since = std::chrono::duration_cast<system_clock::duration>(
        std::chrono::duration<double>{std::clamp(unix_seconds, 0.0, 4e9)});
    const std::string text = time_of_day(system_clock::time_point{since});
    return with_milliseconds ? text : text.substr(0, 8);
}

std::string rate_text(std::optional<double> per_second)
{
    return per_second ? fmt::format("{:.1f}", *per_second) : "-";
}

/// What says the same as telegrams and replies, while all is well.
constexpr std::array<std::string_view, 2> kTold{"checked", "requests"};

/// "telegrams 210.0/s, replies 100.0/s": first those that are `always` named, then the others that grow.
std::string rates_text(const std::vector<Rate>& all, const std::vector<std::string_view>& always)
{
    std::string out;
    const auto add = [&](std::string_view name, double per_second) {
        out += fmt::format("{}{} {:.1f}/s", out.empty() ? "" : ", ", name, per_second);
    };
    for (const std::string_view name : always)
        if (const auto rate = rate_of(all, name)) add(name, *rate);
    const auto is_among = [](const auto& names, const Rate& one) {
        return std::find(names.begin(), names.end(), one.name) != names.end();
    };
    for (const Rate& one : all)
        if (one.per_second > 0 && !is_among(always, one) && !is_among(kTold, one))
            add(one.name, one.per_second);
    return out;
}

std::vector<Rate> bus_rates(const TopState& state)
{
    if (state.before() == nullptr) return {};
    return rates(bus_group(state.before()->counters), bus_group(state.now().counters), state.passed());
}

std::vector<Rate> station_rates(const TopState& state, std::string_view station)
{
    if (state.before() == nullptr) return {};
    return rates(station_group(state.before()->counters, station),
                 station_group(state.now().counters, station), state.passed());
}

std::string class_end(std::optional<std::int64_t> end)
{
    return end ? std::to_string(*end) : "more";
}

std::string turnaround_line(const TopState& state, std::size_t columns, const TopLook& look)
{
    const auto all = state.turnaround().now();
    if (!all) return "turnaround: no reply was sent yet";
    return fmt::format("turnaround [{}] {} to {} {}, p50 {}, p99 {}, {}",
                       sparkline(*all, std::min(kSparkColumns, columns / 4), look.blocks),
                       all->classes.front().from, class_end(all->highest), all->unit, class_end(all->p50),
                       class_end(all->p99),
                       state.turnaround().is_recent() ? "last minute" : "since the start");
}

/// What stands above the stations.
std::vector<std::string> head_lines(const TopState& state, std::size_t columns, const TopLook& look)
{
    const std::string time = clock_text(state.now().unix_seconds, false);
    std::string first = bus_line(state.now().status.bus);
    if (columns > time.size() + 20) first = fitted(first, columns - time.size() - 2) + "  " + time;
    std::string second = rates_text(bus_rates(state), {"telegrams", "replies", "octets"});
    if (second.empty())
        second = state.before() == nullptr ? "rates: with the next refresh" : "no counter of the bus grows";
    return {first, second, turnaround_line(state, columns, look)};
}

std::string mark(bool is_selected, bool has_changed)
{
    return std::string{is_selected ? ">" : " "} + (has_changed ? "*" : " ");
}

/// `shows_selected`: with a mark at the selected one.
Grid station_grid(const TopState& state, bool shows_selected)
{
    Grid grid({"  ", "STATION", "STATE", ">EXCH/s", "DRIVE", ">READS/s", ">ADDR", ">MASTER", "LINE"});
    const auto stations = state.stations();
    const std::size_t selected = state.selected();
    for (std::size_t i = 0; i < stations.size(); ++i) {
        const report::Station& one = *stations[i];
        const auto all = station_rates(state, one.name);
        const bool changed = state.has_changed(one);
        grid.add({mark(shows_selected && i == selected, changed),
                  {one.name, changed ? Tone::strong : Tone::plain},
                  {state_text(one), state_tone(one)},
                  rate_text(rate_of(all, "data_exchange")),
                  {link_text(one.drive), link_tone(one.drive)},
                  rate_text(rate_of(all, "drive_reads")),
                  std::to_string(one.address),
                  number(one.master),
                  one.drive.line});
    }
    return grid;
}

Grid value_grid(const TopState& state, const std::string& station)
{
    Grid grid({"  ", "DIR", ">TAG", "NAME", "VALUE", "STATE", ">AGE", ">RAW"});
    for (const report::Word* const one : state.words(station)) {
        const bool changed = state.has_changed(station, *one);
        grid.add({mark(false, changed),
                  one->direction,
                  std::to_string(one->tag),
                  one->name.value_or(""),
                  {one->value, changed ? Tone::strong : Tone::plain},
                  {state_text(*one), state_tone(*one)},
                  age(one->age_ms),
                  fmt::format("{:04X}h", one->raw & 0xFFFF)});
    }
    return grid;
}

/// The name of a station, and its counters that grow.
std::string value_head(const TopState& state, const std::string& station, std::size_t columns, Look look)
{
    const std::string text = rates_text(station_rates(state, station), {});
    const std::string line = station + (text.empty() ? "" : ": " + text);
    const std::string shown = cut(line, columns);
    const std::size_t name = std::min(station.size(), shown.size());
    return painted(shown.substr(0, name), Tone::strong, look) + shown.substr(name);
}

std::vector<std::string> event_lines(const TopState& state, std::size_t count)
{
    const auto& all = state.events();
    std::vector<std::string> out;
    for (std::size_t i = all.size() - std::min(all.size(), count); i < all.size(); ++i)
        out.push_back(clock_text(all[i].unix_seconds, true) + " " + all[i].text);
    return out;
}

/// How many lines each part gets, headers included.
struct Parts {
    std::size_t stations = 0, values = 0, events = 0, blanks = 0;
};

/// `wanted` within `rows`: on a small screen the stations come first, then the values, then the events.
Parts shared_out(Parts wanted, std::size_t rows)
{
    Parts given;
    if (rows >= 14) given.blanks = std::min<std::size_t>(wanted.blanks, 3);
    rows -= given.blanks;
    given.events = std::min(wanted.events, rows / 4);
    const std::size_t lists = rows - given.events;
    given.stations = std::min(wanted.stations, std::max<std::size_t>(2, lists / 2));
    if (wanted.values < lists - std::min(lists, given.stations)) // the stations get what the values leave
        given.stations = std::min(wanted.stations, lists - wanted.values);
    given.stations = std::min(given.stations, lists);
    given.values = std::min(wanted.values, lists - given.stations);
    if (given.values < 3) { // no room for a head, a header and a value
        given.stations = std::min(wanted.stations, lists);
        given.values = 0;
    }
    given.events = std::min(wanted.events, rows - given.stations - given.values);
    return given;
}

std::string footer_line(const TopState& state, std::size_t stations)
{
    if (state.types_filter()) return "filter: " + state.filter() + "_   Enter keeps it, Esc ends it";
    const std::string filtered = state.filter().empty() ? "" : " (" + state.filter() + ")";
    return fmt::format("q quit   up/down station {}/{}   PgUp/PgDn values   / filter{}",
                       stations == 0 ? 0 : state.selected() + 1, stations, filtered);
}

/// Lines that are put together on a screen: each is cut to its columns, those behind its last row are
/// dropped.
class Lines {
public:
    explicit Lines(ScreenSize size) : size_(size) {}
    /// Without colours.
    void add_plain(const std::string& line) { add_fitted(cut(line, size_.columns)); }
    void add_plain(const std::vector<std::string>& lines)
    {
        for (const std::string& line : lines) add_plain(line);
    }
    /// Fits already, and may have colours.
    void add_fitted(std::string line)
    {
        if (lines_.size() < size_.rows) lines_.push_back(std::move(line));
    }
    void add_fitted(std::vector<std::string> lines)
    {
        for (std::string& line : lines) add_fitted(std::move(line));
    }
    void fill_up(std::size_t rows)
    {
        while (lines_.size() < rows) lines_.emplace_back();
    }
    std::vector<std::string> take() { return std::move(lines_); }

private:
    ScreenSize size_;
    std::vector<std::string> lines_;
};

/// The first row of a list of which `shown` rows fit, so that row `wanted` is among them.
std::size_t first_shown(std::size_t wanted, std::size_t shown, std::size_t rows)
{
    const std::size_t first = wanted - std::min(wanted, shown / 2);
    return std::min(first, rows - std::min(rows, shown));
}

void add_stations(Lines& lines, const TopState& state, std::size_t rows, std::size_t columns, Look look)
{
    if (rows == 0) return;
    const Grid grid = station_grid(state, true);
    const std::size_t shown = rows - 1;
    lines.add_fitted(grid.lines(look, columns, first_shown(state.selected(), shown, grid.rows()), shown));
    if (grid.rows() == 0 && !state.now().status.bus.listens)
        lines.add_plain("  no station has this in its name or in those of its tags");
}

void add_values(Lines& lines, const TopState& state, std::size_t rows, std::size_t columns, Look look)
{
    const auto stations = state.stations();
    if (rows < 3 || stations.empty()) return;
    const std::string& name = stations[state.selected()]->name;
    lines.add_fitted(value_head(state, name, columns, look));
    const Grid grid = value_grid(state, name);
    const std::size_t last_start = grid.rows() - std::min(grid.rows(), rows - 2);
    lines.add_fitted(grid.lines(look, columns, std::min(state.first_word(), last_start), rows - 2));
}

} // namespace

std::vector<std::string> render_top(const TopState& state, ScreenSize size, const TopLook& look)
{
    Lines lines{size};
    const bool with_footer = size.rows >= 6;
    const std::size_t head = size.rows >= 6 ? 3 : 0;
    if (head > 0) lines.add_plain(head_lines(state, size.columns, look));

    const auto stations = state.stations();
    const std::size_t values = stations.empty() ? 0 : state.words(stations[state.selected()]->name).size();
    const Parts parts =
        shared_out({1 + std::max<std::size_t>(stations.size(), 1), values > 0 ? 2 + values : 0,
                    std::min<std::size_t>(state.events().size(), 8), 3},
                   size.rows - head - (with_footer ? 1 : 0));
    if (parts.blanks > 0) lines.add_fitted("");
    add_stations(lines, state, parts.stations, size.columns, look.look);
    if (parts.blanks > 0 && parts.values > 0) lines.add_fitted("");
    add_values(lines, state, parts.values, size.columns, look.look);
    if (parts.blanks > 0 && parts.events > 0) lines.add_fitted("");
    lines.add_plain(event_lines(state, parts.events));
    if (with_footer) {
        lines.fill_up(size.rows - 1);
        lines.add_plain(footer_line(state, stations.size()));
    }
    return lines.take();
}

std::string render_top_whole(const TopState& state, const TopLook& look)
{
    constexpr std::size_t kNoEnd = 1'000'000;
    const std::size_t columns = look.look.width;
    Lines lines{{columns, kNoEnd}};
    lines.add_plain(head_lines(state, columns, look));
    lines.add_fitted("");
    lines.add_fitted(station_grid(state, false).lines(look.look, columns, 0, kNoEnd));
    for (const report::Station* const one : state.stations()) {
        const Grid grid = value_grid(state, one->name);
        if (grid.rows() == 0) continue;
        lines.add_fitted("");
        lines.add_fitted(value_head(state, one->name, columns, look.look));
        lines.add_fitted(grid.lines(look.look, columns, 0, kNoEnd));
    }
    if (!state.events().empty()) lines.add_fitted("");
    lines.add_plain(event_lines(state, kEventsOfAPipe));
    std::string out;
    for (const std::string& line : lines.take()) out += line + '\n';
    return out;
}

} // namespace dpslave::dpctl
