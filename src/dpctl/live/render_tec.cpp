// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/table.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::int64_t kParameter = 1, kTypeMismatch = 2; // of FAULT

constexpr const char* kSteps =
    "  not set up; in three steps (on the Operator Station: view level Advanced, block TEC OPTION):\n"
    "    1. TYPE is to be PROFIBUS DP:  dpctl tec set TYPE \"PROFIBUS DP\"\n"
    "    2. ADDRESS, 0 to 125; 0 to 2 are usually masters:  dpctl tec set ADDRESS 3\n"
    "    3. look at FAULT: NONE is wanted\n"
    "  What is set lasts until the next start; the configuration file has the start values.\n";

Table row_table(const Json& tec)
{
    const char* name = text(tec, "view") == "generic" ? "generic_name" : "name";
    Table table({"", "NAME", "VALUE", ">NUMBER", "RANGE"});
    for (const Json& row : list(tec, "rows"))
        table.add({flag(row, "input") ? "input" : "output", text(row, name), text(row, "shown"),
                   number(row, "value"), text(row, "range", "")});
    return table;
}

bool is_set_up(const Json& tec)
{
    for (const Json& row : list(tec, "rows")) {
        const auto value = integer(row, "value");
        if (text(row, "name") == "FAULT" && (value == kParameter || value == kTypeMismatch)) return false;
    }
    return true;
}

} // namespace

std::string render_tec(const Json& tec, Look look)
{
    std::string out = fmt::format("{}: TEC OPTION{}\n", painted(text(tec, "name"), Tone::strong, look),
                                  text(tec, "view") == "generic" ? ", in names that fit any option" : "");
    out += row_table(tec).str(look, 2);
    if (const std::string trip = text(tec, "trip", ""); !trip.empty()) out += "  trip " + trip + '\n';
    for (const Json& note : list(tec, "notes"))
        if (note.is_string()) out += "  " + painted(note.get<std::string>(), Tone::strong, look) + '\n';
    if (!is_set_up(tec)) out += kSteps;
    return out;
}

} // namespace dpslave::dpctl
