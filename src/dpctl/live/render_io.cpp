// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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

std::string outputs_text(const Json& s)
{
    std::string out = "outputs go to the drive";
    if (!flag(s, "may_write")) return "nothing is written to the drive";
    if (flag(s, "sync")) out = "Sync holds the outputs";
    if (flag(s, "clear")) out = "the master is in Clear, 0 goes to every output";
    return flag(s, "freeze") ? out + "; Freeze holds the inputs" : out;
}

std::string demand_lines(const Json& demand, Look look)
{
    Block block;
    block.add("Demand Data", text(demand, "words"));
    block.add("request", hex_words(list(demand, "request")));
    block.add("reply", hex_words(list(demand, "reply")));
    return block.str(2, look);
}

/// Where the words of parameters begin: behind Demand Data, if there are any.
std::int64_t first_octet(const Json& words)
{
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const Json& w : words) first = std::min(first, integer(w, "octet").value_or(first));
    return first;
}

/// Words of a direction are counted from 1, without Demand Data: as gsd make and dpsim count.
std::string word_number(const Json& w, std::int64_t first)
{
    const auto octet = integer(w, "octet");
    return octet ? std::to_string((*octet - first) / 2 + 1) : "-";
}

/// "5000 (1388h)".
std::string raw_text(const Json& w)
{
    const auto raw = integer(w, "raw");
    return raw ? fmt::format("{} ({:04X}h)", *raw, *raw) : "-";
}

Table word_table(const Json& words)
{
    Table table({"DIR", ">OCTET", ">WORD", ">TAG", "NAME", ">VALUE", ">RAW", "STATE", ">AGE"});
    const std::int64_t first = first_octet(words);
    for (const Json& w : words) {
        const std::string state = text(w, "state");
        const std::string answer = text(w, "answer", "");
        const Tone tone = state == "good" ? Tone::good : state == "untried" ? Tone::plain : Tone::bad;
        table.add({text(w, "direction"), number(w, "octet"), word_number(w, first), number(w, "tag"),
                   text(w, "name", ""), text(w, "value"), raw_text(w),
                   Cell{answer.empty() ? state : fmt::format("{} '{}'", state, answer), tone},
                   age(real(w, "age_ms"))});
    }
    return table;
}

/// The station of the same name; an empty object without.
const Json& station_of(const Json& reply, const Json& words)
{
    static const Json nothing = Json::object();
    for (const Json& s : list(reply, "stations"))
        if (s.is_object() && text(s, "name") == text(words, "name")) return s;
    return nothing;
}

std::string table_text(const Json& words, Look look)
{
    const Table table = word_table(words);
    return table.empty() ? "  no parameters: no master has chosen any\n" : table.str(look, 2);
}

} // namespace

std::string render_io(const Json& reply, Look look)
{
    std::string out;
    for (const Json& s : list(reply, "stations")) {
        out += out.empty() ? "" : "\n";
        out += headline(
            text(s, "name"),
            fmt::format(", address {}: {}; {}", number(s, "address"), text(s, "state"), outputs_text(s)),
            look);
        out += table_text(list(s, "words"), look);
        if (const Json& demand = part(s, "demand"); !demand.empty()) out += demand_lines(demand, look);
    }
    if (!out.empty())
        out += '\n' +
               paragraph(
                   "",
                   "in: drive to master, out: master to drive; octet: place in the Data_Exchange telegram, "
                   "counted from 0; word: place among the words of its direction, counted from 1 "
                   "behind Demand Data, as gsd make and dpsim count",
                   look.width);
    return out;
}

std::string render_followed_io(const Json& reply, Look look)
{
    std::string out;
    for (const Json& s : list(reply, "words")) {
        const Json& station = station_of(reply, s);
        out += out.empty() ? "" : "\n";
        out +=
            headline(text(s, "name"),
                     fmt::format(", address {}: {}", number(station, "address"), state_text(station)), look);
        out += table_text(list(s, "words"), look);
    }
    return out;
}

} // namespace dpslave::dpctl
