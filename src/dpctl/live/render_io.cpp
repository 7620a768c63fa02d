// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace dpslave::dpctl {
namespace {

std::string hex_words(const std::vector<std::int64_t>& words)
{
    std::string result;
    for (const std::int64_t w : words) result += fmt::format("{}{:04X}", result.empty() ? "" : " ", w);
    return result;
}

std::string outputs_text(const report::StationIo& s)
{
    std::string out = "outputs go to the drive";
    if (!s.may_write) return "nothing is written to the drive";
    if (s.sync) out = "Sync holds the outputs";
    if (s.clear) out = "the master is in Clear, 0 goes to every output";
    return s.freeze ? out + "; Freeze holds the inputs" : out;
}

std::string demand_lines(const report::Demand& demand, Look look)
{
    Block block;
    block.add("Demand Data", demand.words);
    block.add("request", hex_words(demand.request));
    block.add("reply", hex_words(demand.reply));
    return block.str(2, look);
}

/// Where the words of parameters begin: behind Demand Data, if there are any.
std::int64_t first_octet(const std::vector<report::Word>& words)
{
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const report::Word& w : words) first = std::min(first, w.octet);
    return first;
}

/// Words of a direction are counted from 1, without Demand Data: as gsd make and dpsim count.
std::string word_number(const report::Word& w, std::int64_t first)
{
    return std::to_string((w.octet - first) / 2 + 1);
}

Table word_table(const std::vector<report::Word>& words)
{
    Table table({"DIR", ">OCTET", ">WORD", ">TAG", "NAME", ">VALUE", ">RAW", "STATE", ">AGE"});
    const std::int64_t first = first_octet(words);
    for (const report::Word& w : words) {
        const std::string state = state_text(w);
        table.add({w.direction, number(w.octet), word_number(w, first), number(w.tag), w.name.value_or(""),
                   w.value, fmt::format("{0} ({0:04X}h)", w.raw),
                   Cell{w.answer ? fmt::format("{} '{}'", state, *w.answer) : state, state_tone(w)},
                   age(w.age_ms)});
    }
    return table;
}

/// ", address 5: Data_Exch"; nothing without the station.
std::string state_of(const std::string& name, const std::vector<report::Station>& stations)
{
    for (const report::Station& s : stations)
        if (s.name == name) return fmt::format(", address {}: {}", s.address, state_text(s));
    return {};
}

std::string table_text(const std::vector<report::Word>& words, Look look)
{
    const Table table = word_table(words);
    return table.empty() ? "  no parameters: no master has chosen one\n" : table.str(look, 2);
}

} // namespace

std::string state_text(const report::Word& word)
{
    std::string state = word.state;
    std::replace(state.begin(), state.end(), '_', ' ');
    return state;
}

Tone state_tone(const report::Word& word)
{
    return word.state == "good" ? Tone::good : word.state == "untried" ? Tone::plain : Tone::bad;
}

std::string render_io(const Json& json, Look look)
{
    const auto reply = report::read<report::GetIoReply>(json);
    std::string out;
    for (const report::StationIo& s : reply.stations) {
        out += out.empty() ? "" : "\n";
        out +=
            headline(s.name, fmt::format(", address {}: {}; {}", s.address, s.state, outputs_text(s)), look);
        out += table_text(s.words, look);
        if (s.demand) out += demand_lines(*s.demand, look);
    }
    if (!out.empty())
        out +=
            '\n' +
            paragraph(
                "",
                "in: drive to master, out: master to drive; octet: place in the Data_Exchange telegram, counted from 0; word: place among the words of its direction, counted from 1 after Demand Data, as gsd make and dpsim count",
                look.width);
    return out;
}

std::string render_followed_io(const Json& json, Look look)
{
    const auto reply = report::read<report::WatchReply>(json);
    std::string out;
    for (const report::StationWords& s : reply.words) {
        out += out.empty() ? "" : "\n";
        out += headline(s.name, state_of(s.name, reply.stations), look);
        out += table_text(s.words, look);
    }
    return out;
}

} // namespace dpslave::dpctl
