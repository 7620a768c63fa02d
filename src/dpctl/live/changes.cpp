// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// The one of `all` that is like `wanted` in these fields; null without.
template <class T>
const T* same(const std::vector<T>& all, const T& wanted, auto... fields)
{
    for (const T& one : all)
        if (((one.*fields == wanted.*fields) && ...)) return &one;
    return nullptr;
}

/// "state Wait_Prm (was Data_Exch)", or nothing when it is the same.
void compare(std::string& line, const char* what, const std::string& before, const std::string& now,
             bool anew)
{
    if (!anew && before == now) return;
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", what, now);
    if (!anew) line += fmt::format(" (was {})", before);
}

std::string bus_state(const report::Bus& bus)
{
    return bus.port_open ? bus.baud_state : "port missing";
}

std::string bus_change(const report::Bus& before, const report::Bus& now, bool anew)
{
    std::string line;
    compare(line, "rate", rate(before.baud), rate(now.baud), anew);
    compare(line, "state", bus_state(before), bus_state(now), anew);
    return line;
}

/// `past`: null when it was not there.
std::string station_change(const report::Station* past, const report::Station& now)
{
    const bool anew = past == nullptr;
    const report::Station& before = anew ? now : *past;
    std::string line;
    compare(line, "state", state_text(before), state_text(now), anew);
    compare(line, "master", number(before.master, "none"), number(now.master, "none"), anew);
    compare(line, "drive", link_text(before.drive), link_text(now.drive), anew);
    return line;
}

std::string word_change(const report::Word* before, const report::Word& now)
{
    using report::Word;
    if (before != nullptr && same({*before}, now, &Word::value, &Word::raw, &Word::state) != nullptr)
        return {};
    return fmt::format("{} tag {}{} = {} ({})", now.direction, now.tag, now.name ? " " + *now.name : "",
                       now.value, state_text(now));
}

void add(std::vector<std::string>& lines, const std::string& what, const std::string& line)
{
    if (!line.empty()) lines.push_back(what + ": " + line);
}

} // namespace

std::vector<std::string> status_changes(const Json& past, const Json& reply)
{
    const auto before = report::read<report::WatchReply>(past), now = report::read<report::WatchReply>(reply);
    std::vector<std::string> lines;
    add(lines, "bus", bus_change(before.bus, now.bus, past.empty()));
    for (const report::Station& station : now.stations)
        add(lines, station.name,
            station_change(same(before.stations, station, &report::Station::name), station));
    for (const report::Station& station : before.stations)
        if (same(now.stations, station, &report::Station::name) == nullptr)
            add(lines, station.name, "removed");
    return lines;
}

std::vector<std::string> io_changes(const Json& past, const Json& reply)
{
    using report::Word;
    const auto before = report::read<report::WatchReply>(past), now = report::read<report::WatchReply>(reply);
    std::vector<std::string> lines;
    for (const report::StationWords& station : now.words) {
        const auto* old = same(before.words, station, &report::StationWords::name);
        for (const Word& word : station.words)
            add(lines, station.name,
                word_change(old ? same(old->words, word, &Word::direction, &Word::octet, &Word::tag)
                                : nullptr,
                            word));
    }
    return lines;
}

} // namespace dpslave::dpctl
