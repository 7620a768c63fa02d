// SPDX-License-Identifier: Apache-2.0
// Tags that the master has chosen and whose scale is not known: in words, and for the control socket.
#include "report.hpp"

#include <fmt/format.h>

namespace dpslave::app {

namespace {

std::string listed(const std::vector<report::Unscaled>& all, bool is_contradicted)
{
    std::string list;
    for (const report::Unscaled& one : all) {
        if (one.contradicted != is_contradicted) continue;
        list += fmt::format("{}tag {}", list.empty() ? "" : ", ", one.tag);
        if (!one.answer.empty()) list += fmt::format(" (answers \'{}\')", one.answer);
    }
    return list;
}

} // namespace

std::optional<std::string> scale_words(const Station& station)
{
    const std::vector<report::Unscaled> all = unscaled_report(station);
    if (all.empty()) return std::nullopt;
    // What the drive side has found the bus side knows a moment later.
    const bool is_held = station.bus.holds || (station.bus.stat_diag && station.config->unscaled_holds);
    std::string words;
    if (const std::string tags = listed(all, false); !tags.empty())
        words = fmt::format(
            "{}: the scale of {} is not known. Give each a confirmed row with decimals in "
            "the tag table (dpctl "
            "survey finds a lower bound), or set unlisted_decimals, then run dpctl reload",
            is_held ? "Data exchange does not start" : "Inputs read 0 and outputs are not written", tags);
    if (const std::string tags = listed(all, true); !tags.empty())
        words +=
            fmt::format("{}The tag table gives too few decimals to {}. The tag is refused: correct its row, "
                        "then run dpctl reload",
                        words.empty() ? "" : ". ", tags);
    return words;
}

std::string row_advice(const config::StationConfig& station, std::uint16_t tag)
{
    const drive::Tag* const row = station.tags->find(tag);
    const bool is_of_profile = station.profile->tag_file == station.tag_file;
    if (row == nullptr)
        return fmt::format("the tag table {} has no line for tag {}: check the number, or {}",
                           station.tag_file, tag,
                           is_of_profile ? "write your own table and name it with 'tags' in [[station]]"
                                         : "add a line with name, type and decimals");
    if (!row->confirmed)
        return "its row is not confirmed: compare it with the drive's manual and set confirmed to yes";
    if (!row->decimals_known) return "its row has no decimals: fill in column decimals";
    return {};
}

std::vector<report::Unscaled> unscaled_report(const Station& station)
{
    std::vector<report::Unscaled> found;
    const drive::UnitSnapshot& drive = station.drive;
    const Layout& layout = station.bus.layout;
    if (layout.generation == 0 || drive.generation != layout.generation) return found;
    for (std::size_t i = 0; i < layout.count; ++i) {
        if (drive.states[i] != WordState::unscaled) continue;
        const Parameter& parameter = layout.parameters[i];
        found.push_back({parameter.tag, parameter.reads ? parameter.writes ? "in and out" : "in" : "out",
                         drive.answer_texts[i].data(), drive.errors[i] == AccessError::contradicted});
    }
    return found;
}

} // namespace dpslave::app
