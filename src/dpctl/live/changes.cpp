// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// The object of `array` whose `key` is the same as in `like`; an empty one without.
const Json& same(const Json& array, const Json& like, std::initializer_list<const char*> keys)
{
    static const Json nothing = Json::object();
    for (const Json& item : array) {
        bool equal = item.is_object();
        for (const char* key : keys) equal = equal && item.value(key, Json{}) == like.value(key, Json{});
        if (equal) return item;
    }
    return nothing;
}

/// "state Wait_Prm (was Data_Exch)", or nothing when it is the same.
void compare(std::string& line, const char* what, const std::string& before, const std::string& now,
             bool anew)
{
    if (!anew && before == now) return;
    line += fmt::format("{}{} {}", line.empty() ? "" : ", ", what, now);
    if (!anew) line += fmt::format(" (was {})", before);
}

std::string bus_state(const Json& bus)
{
    return bus.contains("port_open") && !flag(bus, "port_open") ? "port gone" : text(bus, "baud_state");
}

std::string bus_change(const Json& before, const Json& now)
{
    const bool anew = before.empty();
    std::string line;
    compare(line, "rate", rate(integer(before, "baud").value_or(0)), rate(integer(now, "baud").value_or(0)),
            anew);
    compare(line, "state", bus_state(before), bus_state(now), anew);
    return line;
}

std::string station_change(const Json& before, const Json& now)
{
    const bool anew = before.empty();
    std::string line;
    compare(line, "state", state_text(before), state_text(now), anew);
    compare(line, "master", number(before, "master", "none"), number(now, "master", "none"), anew);
    compare(line, "drive", link_text(part(before, "drive")), link_text(part(now, "drive")), anew);
    return line;
}

std::string word_change(const Json& before, const Json& now)
{
    const bool same_value = text(before, "value") == text(now, "value") &&
                            before.value("raw", Json{}) == now.value("raw", Json{});
    if (!before.empty() && same_value && text(before, "state") == text(now, "state")) return {};
    const std::string name = text(now, "name", "");
    return fmt::format("{} tag {}{} = {} ({})", text(now, "direction"), number(now, "tag"),
                       name.empty() ? "" : " " + name, text(now, "value"), text(now, "state"));
}

void add(std::vector<std::string>& lines, const std::string& what, const std::string& line)
{
    if (!line.empty()) lines.push_back(what + ": " + line);
}

} // namespace

std::vector<std::string> status_changes(const Json& before, const Json& now)
{
    std::vector<std::string> lines;
    add(lines, "bus", bus_change(part(before, "bus"), part(now, "bus")));
    for (const Json& station : list(now, "stations"))
        if (station.is_object())
            add(lines, text(station, "name"),
                station_change(same(list(before, "stations"), station, {"name"}), station));
    for (const Json& station : list(before, "stations"))
        if (station.is_object() && same(list(now, "stations"), station, {"name"}).empty())
            add(lines, text(station, "name"), "removed");
    return lines;
}

std::vector<std::string> io_changes(const Json& before, const Json& now)
{
    std::vector<std::string> lines;
    for (const Json& station : list(now, "words")) {
        if (!station.is_object()) continue;
        const Json& old_words = list(same(list(before, "words"), station, {"name"}), "words");
        for (const Json& w : list(station, "words"))
            if (w.is_object())
                add(lines, text(station, "name"),
                    word_change(same(old_words, w, {"direction", "octet", "tag"}), w));
    }
    return lines;
}

} // namespace dpslave::dpctl
