// SPDX-License-Identifier: Apache-2.0
#include "render.hpp"
#include "tables.hpp"
#include "words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

std::string hex_words(const Json& words)
{
    std::string result;
    for (const Json& w : words)
        if (w.is_number_integer())
            result += fmt::format("{}{:04X}", result.empty() ? "" : " ", w.get<std::int64_t>());
    return result;
}

std::string demand_lines(const Json& demand)
{
    Block block;
    block.add("Demand Data", text(demand, "words"));
    block.add("request", hex_words(list(demand, "request")));
    block.add("reply", hex_words(list(demand, "reply")));
    return block.str();
}

} // namespace

Table word_table(const Json& words)
{
    Table table({"DIR", ">OCTET", ">TAG", "NAME", ">VALUE", ">RAW", "STATE", ">AGE"});
    for (const Json& w : words) {
        const std::string state = text(w, "state");
        const std::string answer = text(w, "answer", "");
        const Tone tone = state == "good" ? Tone::good : state == "untried" ? Tone::plain : Tone::bad;
        table.add({text(w, "direction"), number(w, "octet"), number(w, "tag"), text(w, "name", ""),
                   text(w, "value"), word(integer(w, "raw")),
                   Cell{answer.empty() ? state : fmt::format("{} '{}'", state, answer), tone},
                   age(real(w, "age_ms"))});
    }
    return table;
}

std::string render_io(const Json& reply, bool colour)
{
    std::string out;
    for (const Json& s : list(reply, "stations")) {
        out += fmt::format(
            "{}{}, address {}: {}; {}\n", out.empty() ? "" : "\n",
            painted(text(s, "name"), Tone::strong, colour), number(s, "address"), text(s, "state"),
            flag(s, "may_write") ? "outputs go to the drive" : "nothing is written to the drive");
        const Table table = word_table(list(s, "words"));
        out += table.empty() ? "  no parameters: no master has chosen any\n" : table.str(colour, 2);
        if (const Json& demand = part(s, "demand"); !demand.empty()) out += demand_lines(demand);
    }
    if (!out.empty())
        out += "\nin: drive to master, out: master to drive; octet: place in the Data_Exchange telegram, "
               "counted from 0\n";
    return out;
}

} // namespace dpslave::dpctl
