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
    "    1. set TYPE to PROFIBUS DP:  dpctl tec set TYPE \"PROFIBUS DP\"\n"
    "    2. set ADDRESS, 0 to 125; 0 to 2 are usually masters:  dpctl tec set ADDRESS 3\n"
    "    3. check FAULT: it must be NONE\n"
    "  Values that you set last until the next start; the configuration file has the start values.\n";

Table row_table(const report::Tec& tec)
{
    const bool is_generic = tec.view == "generic";
    Table table({"", "NAME", "VALUE", ">NUMBER", "RANGE"});
    for (const report::TecRow& row : tec.rows)
        table.add({row.input ? "input" : "output", is_generic ? row.generic_name : row.name, row.shown,
                   number(row.value), row.range});
    return table;
}

bool is_set_up(const report::Tec& tec)
{
    for (const report::TecRow& row : tec.rows) {
        if (row.name == "FAULT" && (row.value == kParameter || row.value == kTypeMismatch)) return false;
    }
    return true;
}

} // namespace

std::string render_tec(const report::Tec& tec, Look look)
{
    std::string out = fmt::format("{}: TEC OPTION{}\n", painted(tec.name, Tone::strong, look),
                                  tec.view == "generic" ? ", with the general names of any option" : "");
    out += row_table(tec).str(look, 2);
    if (tec.trip) out += "  trip " + *tec.trip + '\n';
    for (const std::string& note : tec.notes) out += "  " + painted(note, Tone::strong, look) + '\n';
    if (!is_set_up(tec)) out += kSteps;
    return out;
}

} // namespace dpslave::dpctl
