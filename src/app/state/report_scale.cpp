// SPDX-License-Identifier: Apache-2.0
// Tags that the drive denies or whose scale is not known, what their rows lack, what a tag
// takes.
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

/// " or one of Run, Hold": what stands for a value of this tag, as far as it can be listed.
std::string names_of_values(const drive::Tag& tag)
{
    constexpr std::size_t most = 12;
    std::string names;
    std::size_t count = 0;
    for (const drive::Label& label : tag.labels) {
        if (label.is_bit) continue;
        if (++count > most) return names + " ...";
        names += (names.empty() ? " or one of " : ", ") + label.text;
    }
    return names;
}

/// "an INT", "a WORD".
std::string with_article(std::string_view type)
{
    const bool is_vowel =
        !type.empty() && std::string_view{"AEIOU"}.find(type.front()) != std::string_view::npos;
    return fmt::format("{} {}", is_vowel ? "an" : "a", type);
}

} // namespace

std::optional<std::string> scale_register_words(const Station& station)
{
    const auto fault = station.drive.scale_fault;
    if (!fault) return std::nullopt;
    const drive::Tag* const row = station.config->tags->find(fault->tag);
    const auto shown = [row](std::uint16_t word) {
        return row != nullptr ? drive::displayed(*row, word) : std::to_string(word);
    };
    const bool is_held = station.bus.stat_diag && station.config->unscaled_holds;
    const bool is_resolution = fault->tag == station.config->profile->resolution_tag;
    return fmt::format(
        "{}: the drive says {} in tag {}{}, and the station says {}. Set {} in [[station]] as the drive has it, then run dpctl reload; or set the drive",
        is_held ? "Data exchange does not start"
                : "Inputs are held (0 if never read) and outputs are not written",
        shown(fault->word), fault->tag, row != nullptr ? " (" + row->name + ")" : std::string{},
        shown(fault->expected), is_resolution ? "resolution" : "display_decimals");
}

std::optional<std::string> scale_words(const Station& station)
{
    if (auto words = scale_register_words(station)) return words;
    const std::vector<report::Unscaled> all = unscaled_report(station);
    if (all.empty()) return std::nullopt;
    // What the drive side has found the bus side knows a moment later.
    const bool is_held =
        station.bus.hold == StartHold::unscaled || (station.bus.stat_diag && station.config->unscaled_holds);
    std::string words;
    if (const std::string tags = listed(all, false); !tags.empty())
        words = fmt::format(
            "{}: the scale of {} is not known. Give each a confirmed row with decimals in the tag table (dpctl survey finds a lower bound), or set unlisted_decimals, then run dpctl reload",
            is_held ? "Data exchange does not start"
                    : "Inputs are held (0 if never read) and outputs are not written",
            tags);
    if (const std::string tags = listed(all, true); !tags.empty())
        words += fmt::format(
            "{}The tag table gives too few decimals to {}. The tag is refused: correct its row, then run dpctl reload",
            words.empty() ? "" : ". ", tags);
    return words;
}

namespace {

std::string_view direction_of(const LayoutEntry& parameter)
{
    return parameter.reads ? parameter.writes ? "in and out" : "in" : "out";
}

/// Calls `use` with the place of each parameter of the layout that is in `state`.
template <class Use>
void for_each_in(const Station& station, WordState state, Use use)
{
    const Layout& layout = station.bus.layout;
    if (layout.generation == 0 || station.drive.generation != layout.generation) return;
    for (std::size_t i = 0; i < layout.count; ++i)
        if (station.drive.states[i] == state) use(i);
}

} // namespace

std::vector<report::Denied> denied_report(const Station& station)
{
    std::vector<report::Denied> found;
    for_each_in(station, WordState::invalid_tag, [&](std::size_t i) {
        const LayoutEntry& parameter = station.bus.layout.parameters[i];
        found.push_back(
            {parameter.tag, std::string{direction_of(parameter)}, station.drive.answer_texts[i].data()});
    });
    return found;
}

std::optional<std::string> denied_words(const Station& station)
{
    const std::vector<report::Denied> all = denied_report(station);
    const bool is_held = station.bus.hold == StartHold::denied;
    const bool are_all = !all.empty() && all.size() == station.bus.layout.count;
    if (all.empty() || (!is_held && !are_all)) return std::nullopt;
    std::string tags;
    for (const report::Denied& one : all) {
        tags += fmt::format("{}tag {}", tags.empty() ? "" : ", ", one.tag);
        if (!one.answer.empty()) tags += fmt::format(" (says '{}')", one.answer);
    }
    const profile::Profile& profile = *station.config->profile;
    const bool has_rule = profile.mnemonics != drive::MnemonicRule::none;
    const std::string rule = has_rule ? fmt::format("mnemonic rule {}{}, ", drive::text(profile.mnemonics),
                                                    profile.mnemonics_assumed ? " (assumed)" : "")
                                      : std::string{};
    return fmt::format(
        "{}: the drive denies {}{}. Check {}profile {}, tag table {} and unit {}{}, then run dpctl reload",
        is_held ? "Data exchange does not start" : "Inputs read 0 and outputs are not written",
        are_all ? "every chosen tag: " : "", tags, rule, profile.name, station.config->tag_file,
        station.config->unit_text, are_all ? "" : ", or set denied_tags = \"zero\"");
}

std::string start_words(const Station& station)
{
    std::string words = denied_words(station).value_or("");
    if (const auto scales = scale_words(station)) words += (words.empty() ? "" : ". ") + *scales;
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
    if (station.drive.scale_fault) return found; // the table is not to blame
    for_each_in(station, WordState::unscaled, [&](std::size_t i) {
        const LayoutEntry& parameter = station.bus.layout.parameters[i];
        found.push_back({parameter.tag, std::string{direction_of(parameter)},
                         station.drive.answer_texts[i].data(),
                         station.drive.errors[i] == AccessError::contradicted});
    });
    return found;
}

std::string bad_value_words(const drive::Tag& tag, AccessError error)
{
    const auto limit = [&tag](std::int32_t counts) {
        return drive::displayed(tag, static_cast<std::uint16_t>(counts));
    };
    switch (error) {
        case AccessError::out_of_range:
            if (tag.min && tag.max) return fmt::format("takes {} to {}", limit(*tag.min), limit(*tag.max));
            return "does not fit into 16 bit with the decimals of the tag table";
        case AccessError::unsupported_type:
            return fmt::format("{} is {}, which is not transported", tag.name,
                               with_article(drive::text(tag.type)));
        default:
            return fmt::format("takes {}{}{}", with_article(drive::text(tag.type)),
                               tag.decimals > 0 ? fmt::format(" with up to {} decimal{}", tag.decimals,
                                                              tag.decimals == 1 ? "" : "s")
                                                : std::string{},
                               names_of_values(tag));
    }
}

} // namespace dpslave::app
