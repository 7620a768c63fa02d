// SPDX-License-Identifier: Apache-2.0
// The tag table of a station, and what is said of it: tags without a mnemonic, without a scale, not
// confirmed.
#include "parts.hpp"

#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <utility>

namespace dpslave::config {
namespace {

using input::Document;
using input::Faults;
using input::in_quotes;
using input::Table;

/// "tag 5", "tags 5, 6 and 12 more".
std::string listed_tags(const std::vector<std::uint16_t>& tags)
{
    constexpr std::size_t shown = 16;
    std::string list = tags.size() == 1 ? "tag " : "tags ";
    for (std::size_t i = 0; i < tags.size() && i < shown; ++i)
        list += (i > 0 ? ", " : "") + std::to_string(tags[i]);
    if (tags.size() > shown) list += " and " + std::to_string(tags.size() - shown) + " more";
    return list;
}

/// A tag as the key of a table: "62".
std::optional<std::uint16_t> tag_number(std::string_view key)
{
    std::uint16_t number = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
    if (error != std::errc{} || end != key.data() + key.size()) return std::nullopt;
    return number;
}

std::vector<std::uint16_t> tags_where(const drive::TagTable& table, bool (*is_so)(const drive::Tag&))
{
    std::vector<std::uint16_t> found;
    for (const drive::Tag& tag : table.all())
        if (is_so(tag)) found.push_back(tag.number);
    return found;
}

/// Warns of a complete table: two stations may name the same one, and the warning is given once.
void warn_of_table(const StationConfig& station, const std::string& what, Faults& warnings)
{
    const bool is_said = std::any_of(warnings.begin(), warnings.end(), [&](const input::Fault& known) {
        return known.file == station.tag_file && known.what == what;
    });
    if (!is_said) warnings.push_back({station.tag_file, 0, 0, what});
}

void warn_of_tags_without_mnemonic(const StationConfig& station, Faults& warnings)
{
    std::vector<std::uint16_t> without;
    for (const drive::Tag& tag : station.tags->all())
        if (tag.type != drive::TagType::string && !mnemonic_of(tag, station.profile->mnemonics))
            without.push_back(tag.number);
    if (without.empty()) return;
    warn_of_table(
        station,
        "no mnemonic for " + listed_tags(without) +
            ": they read as invalid tag; fill in column mnemonic, or set mnemonic_rule in profile " +
            in_quotes(station.profile->name) + ".",
        warnings);
}

/// No source says that the device follows the rule of its profile, and the table needs the rule (X-52).
void warn_of_assumed_rule(Document& document, const Table& table, const StationConfig& station,
                          Faults& warnings)
{
    const profile::Profile& profile = *station.profile;
    const auto& rows = station.tags->all();
    const bool needs_rule = rows.empty() || std::any_of(rows.begin(), rows.end(), [](const drive::Tag& tag) {
                                return tag.type != drive::TagType::string && tag.mnemonic.empty();
                            });
    if (!profile.mnemonics_assumed || !needs_rule) return;
    const input::Place at = table.place();
    warnings.push_back(
        {document.name(), at.line, at.column,
         "the mnemonic rule of profile " + in_quotes(profile.name) + " is assumed" +
             (profile.mnemonic_source.empty() ? std::string{} : " (" + profile.mnemonic_source + ")") +
             ": if the drive of station " + in_quotes(station.name) +
             " follows another rule, it denies its tags and data exchange does not start."});
}

/// A mnemonic of the table that the rule gives to another tag of it: one parameter under two scales.
void refuse_shared_mnemonics(Document& document, Table& table, const StationConfig& station)
{
    std::map<std::array<char, 2>, std::uint16_t> known;
    for (const drive::Tag& tag : station.tags->all()) {
        const auto mnemonic = mnemonic_of(tag, station.profile->mnemonics);
        if (!mnemonic) continue;
        const auto [first, is_new] = known.try_emplace(*mnemonic, tag.number);
        if (is_new) continue;
        document.fault(table.place(), station.tag_file + ": tags " + std::to_string(first->second) + " and " +
                                          std::to_string(tag.number) + " both have the mnemonic " +
                                          in_quotes({mnemonic->data(), mnemonic->size()}) +
                                          ", one from its row and one by the rule of profile " +
                                          in_quotes(station.profile->name) +
                                          ": correct column mnemonic of one of them.");
    }
}

void warn_of_unknown_scales(const StationConfig& station, Faults& warnings)
{
    const auto bare = tags_where(*station.tags, [](const drive::Tag& tag) { return !tag.decimals_known; });
    if (!bare.empty())
        warn_of_table(
            station,
            listed_tags(bare) + (bare.size() == 1 ? " is a number" : " are numbers") +
                " without decimals: over EI-ASCII the scale is not known, and data exchange does not start while a master chooses such a tag; fill in column decimals.",
            warnings);
}

/// Rows that a survey wrote.
void warn_of_unconfirmed_rows(const StationConfig& station, bool is_text, Faults& warnings)
{
    const auto waiting = tags_where(*station.tags, [](const drive::Tag& tag) { return !tag.confirmed; });
    if (waiting.empty()) return;
    warn_of_table(station,
                  listed_tags(waiting) + (waiting.size() == 1 ? " waits" : " wait") +
                      " for confirmation: until then " +
                      (is_text ? "the scale is not known" : "values are shown in hexadecimal") +
                      "; compare the rows with the manual of the device and set column confirmed to yes.",
                  warnings);
}

void warn_of_no_table(Document& document, const Table& table, const StationConfig& station, bool is_text,
                      Faults& warnings)
{
    const std::string without =
        "station " + in_quotes(station.name) + " has no tag table (" + station.tag_file + " has no rows): ";
    const input::Place at = table.place();
    std::string what =
        without + "its tags go to and from the instrument as they are, 16 bits without a name.";
    if (is_text && station.unlisted_decimals)
        what = without + "every number of its drive is taken with " +
               std::to_string(*station.unlisted_decimals) + " decimals, as 'unlisted_decimals' says.";
    else if (is_text)
        what =
            without +
            "the scale of its drive's numbers is not known, and data exchange does not start while a master chooses a tag that answers with one; name a table with 'tags', or set 'unlisted_decimals'.";
    warnings.push_back({document.name(), at.line, at.column, what});
}

} // namespace

namespace {

/// A technology box says so itself, with DATA EX ERROR and its access error, and exchanges data all the same.
void read_denied_tags(Table& table, StationConfig& station)
{
    using drive::DeniedHold;
    const auto said = table.choice<DeniedHold>(
        "denied_tags", {{"refuse", DeniedHold::where_one}, {"zero", DeniedHold::where_all}});
    const bool is_box = station.profile && station.profile->has_tec;
    if (is_box && said == DeniedHold::where_one)
        table.refuse(
            "denied_tags",
            "a technology box (profile " + in_quotes(station.profile->name) +
                ") exchanges data also with a tag that its drive denies: write \"zero\", or remove 'denied_tags'.");
    if (station.profile) station.denied_holds = station.profile->denied_holds;
    if (said && !is_box) station.denied_holds = *said;
}

} // namespace

void read_tag_keys(Document& document, Table& table, StationConfig& station, Shelf& shelf,
                   std::string_view protocol)
{
    if (const auto own = table.text("tags")) {
        const std::filesystem::path file =
            std::filesystem::path{document.name()}.parent_path() / *own; // absolute stays
        station.tag_file = file.lexically_normal().string();
        station.tags = shelf.tags(file.lexically_normal());
    } else if (station.profile) {
        station.tag_file = station.profile->tag_file;
        station.tags = {station.profile, &station.profile->tags};
    }
    if (const auto decimals = table.integer("unlisted_decimals", 0, 4))
        station.unlisted_decimals = static_cast<std::uint8_t>(*decimals);
    station.unscaled_holds =
        table.choice<bool>("unscaled_tags", {{"refuse", true}, {"zero", false}}).value_or(true);
    read_denied_tags(table, station);
    for (const char* const key : {"unlisted_decimals", "unscaled_tags"})
        if (protocol == kModbusRtu && table.has(key))
            table.refuse(
                key,
                "'" + std::string{key} +
                    "' has a meaning only on an EI-ASCII line, where numbers travel as text: remove it.");
}

void read_write_limits(Table& table, StationConfig& station)
{
    Table limits = table.table("write_limits");
    if (!limits.exists()) return;
    for (const std::string& key : limits.keys()) {
        const auto values = limits.texts(key);
        if (!values || !station.tags) continue;
        const auto tag = tag_number(key);
        const drive::Tag* const row = tag ? station.tags->find(*tag) : nullptr;
        if (row == nullptr || !row->confirmed || !row->decimals_known) {
            limits.refuse(
                key,
                "tag " + in_quotes(key) + " has no limits that can be checked: " + station.tag_file +
                    " has no confirmed row with its type and decimals. Complete the row, or remove the limits.");
            continue;
        }
        const auto range =
            values->size() == 2 ? limits_of(*row, values->front(), values->back()) : std::nullopt;
        if (range)
            station.write_limits[*tag] = *range;
        else
            limits.refuse(
                key,
                "the limits of tag " + key +
                    " are wrong: write the smallest and the largest value as the drive displays them, within the limits of " +
                    station.tag_file + R"(, as in )" + key + R"( = ["0.0", "50.0"].)");
    }
}

void judge_tags(Document& document, Table& table, const StationConfig& station, std::string_view protocol,
                Faults& warnings)
{
    if (!station.profile || !station.tags || protocol.empty()) return;
    const bool is_text = protocol == kEiAscii;
    if (station.tags->all().empty()) warn_of_no_table(document, table, station, is_text, warnings);
    warn_of_unconfirmed_rows(station, is_text, warnings);
    if (!is_text) return;
    warn_of_assumed_rule(document, table, station, warnings);
    warn_of_tags_without_mnemonic(station, warnings);
    warn_of_unknown_scales(station, warnings);
    refuse_shared_mnemonics(document, table, station);
}

} // namespace dpslave::config
