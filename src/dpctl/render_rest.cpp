// SPDX-License-Identifier: Apache-2.0
#include "render.hpp"
#include "tables.hpp"
#include "words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

std::string render_counters(const Json& reply, bool colour)
{
    std::string out;
    for (const Json& group : list(reply, "groups")) {
        Table table({">COUNT", "OF", "MEANING"});
        for (const Json& c : list(group, "counters"))
            table.add({number(c, "value"), text(c, "name"), text(c, "meaning")});
        out += fmt::format("{}{}\n{}", out.empty() ? "" : "\n",
                           painted(text(group, "name"), Tone::strong, colour), table.str(colour, 2));
    }
    return out;
}

std::string render_leds(const Json& reply, bool colour)
{
    std::string out;
    for (const Json& s : list(reply, "stations")) {
        Table table({"LED", "NOW", "PATTERN", "SINK"});
        for (const Json& led : list(s, "leds"))
            table.add({text(led, "name"), flag(led, "lit") ? "lit" : "dark", text(led, "pattern"),
                       text(led, "sink")});
        out += fmt::format("{}{}: {}\n", out.empty() ? "" : "\n",
                           painted(text(s, "name"), Tone::strong, colour), text(s, "meaning"));
        if (!table.empty()) out += table.str(colour, 2);
    }
    return out;
}

std::string render_tag(const Json& reply, std::string_view verb)
{
    const std::string name = text(reply, "name", "");
    return fmt::format("{}: tag {}{} {} {}, raw {}\n", text(reply, "station"), number(reply, "tag"),
                       name.empty() ? "" : " " + name, verb, text(reply, "value"),
                       word(integer(reply, "raw")));
}

std::string render_watch(const Json& reply, bool colour)
{
    std::string out =
        bus_line(part(reply, "bus")) + "\n\n" + station_table(list(reply, "stations")).str(colour);
    for (const Json& s : list(reply, "words")) {
        const Table table = word_table(list(s, "words"));
        if (!table.empty())
            out += '\n' + painted(text(s, "name"), Tone::strong, colour) + '\n' + table.str(colour, 2);
    }
    return out;
}

} // namespace dpslave::dpctl
