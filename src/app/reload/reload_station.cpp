// SPDX-License-Identifier: Apache-2.0
#include "reload_station.hpp"

#include <fmt/format.h>

#include <string>

namespace dpslave::app {

namespace {

/// What the master has in its GSD, or has read in the diagnosis and the answers until now.
void look_at_personality(const config::StationConfig& before, const config::StationConfig& now,
                         Differences& leaves)
{
    const dp::Personality& a = *before.personality;
    const dp::Personality& b = *now.personality;
    dp::Personality like = a;
    like.ident = b.ident;
    like.max_tsdr = b.max_tsdr;
    like.identifiers = b.identifiers;
    like.prm = b.prm;
    like.waits_for_drive = b.waits_for_drive; // by when_drive_lost
    leaves.compare(a.ident, b.ident, "ident");
    leaves.compare(a.max_tsdr, b.max_tsdr, "max_tsdr");
    leaves.compare(a.prm, b.prm, "tags_at");
    leaves.compare(a.identifiers, b.identifiers, "identifiers");
    leaves.compare(like, b, "its Demand Data or other abilities");
}

/// The rest of it is texts, what only a GSD or --check needs, and what the station has copied.
void look_at_profile(const profile::Profile& a, const profile::Profile& b, Differences& leaves,
                     Differences& applied)
{
    profile::Profile like = a;
    like.tags = b.tags; // looked at row by row
    like.tag_file = b.tag_file;
    like.personality = b.personality;
    if (like == b) return;
    const bool matters = a.has_tec != b.has_tec || a.leds != b.leds || a.mnemonics != b.mnemonics ||
                         a.never_written != b.never_written ||
                         a.tags_only_from_table != b.tags_only_from_table;
    (matters ? leaves : applied).add("profile");
}

/// With an input out of range, or another TYPE, the station would fall silent.
void look_at_tec(const config::TecConfig& a, const config::TecConfig& b, Differences& leaves,
                 Differences& applied)
{
    config::TecConfig like = a;
    like.start.address = b.start.address; // that of the station, which is looked at there
    if (like == b) return;
    const bool is_silent = tec::fault(b.start, {}) != OptionFault::none;
    (is_silent ? leaves : applied).add("[station.tec]");
}

/// Every member that is not named here counts as one that cannot change, so that none can be forgotten.
void look_at_keys(const config::StationConfig& before, const config::StationConfig& now,
                  StationChange& change)
{
    auto& [leaves, applied] = change;
    leaves.compare(before.address, now.address, "address");
    leaves.compare(before.unit, now.unit, "unit");
    leaves.compare(before.loss.when, now.loss.when, "when_drive_lost");
    look_at_personality(before, now, leaves);
    look_at_profile(*before.profile, *now.profile, leaves, applied);
    if (before.tec.has_value() != now.tec.has_value()) leaves.add("[station.tec]");
    if (before.tec && now.tec) look_at_tec(*before.tec, *now.tec, leaves, applied);

    applied.compare(before.name, now.name, fmt::format("its name, which was {}", before.name));
    applied.compare(before.tag_file, now.tag_file, "tags");
    applied.compare(before.output_refresh, now.output_refresh, "output_refresh_s");
    applied.compare(before.loss.after, now.loss.after, "drive_lost_after_s");
    if (!now.tec) applied.compare(before.zero_after, now.zero_after, "output_loss");
    applied.compare(before.ext_diag_bit, now.ext_diag_bit, "ext_diag_bit");
    applied.compare(before.status_tag, now.status_tag, "status_tag");
    applied.compare(before.integer_resolution, now.integer_resolution, "resolution");
    applied.compare(before.unlisted_decimals, now.unlisted_decimals, "unlisted_decimals");
    applied.compare(before.unscaled_holds, now.unscaled_holds, "unscaled_tags");
    applied.compare(before.denied_holds, now.denied_holds, "denied_tags");
    applied.compare(before.write_limits, now.write_limits, "write_limits");
    applied.compare(before.leds, now.leds, "other lamps");

    config::StationConfig like = now;
    like.address = before.address;
    like.unit = before.unit;
    like.unit_text = before.unit_text;
    like.personality = before.personality;
    like.keys = before.keys;
    like.profile = before.profile;
    like.tags = before.tags;
    like.tec = before.tec;
    like.name = before.name;
    like.tag_file = before.tag_file;
    like.line = before.line;
    like.output_refresh = before.output_refresh;
    like.zero_after = before.zero_after;
    like.loss = before.loss;
    like.ext_diag_bit = before.ext_diag_bit;
    like.status_tag = before.status_tag;
    like.integer_resolution = before.integer_resolution;
    like.unlisted_decimals = before.unlisted_decimals;
    like.unscaled_holds = before.unscaled_holds;
    like.denied_holds = before.denied_holds;
    like.watched = before.watched;
    like.write_limits = before.write_limits;
    like.leds = before.leds;
    leaves.compare(like, before, "another key");
}

drive::Tag row_of(const config::StationConfig& station, std::uint16_t number)
{
    const drive::Tag* row = station.tags->find(number);
    if (row != nullptr) return *row;
    return station.unlisted_decimals ? drive::unlisted_tag(number, *station.unlisted_decimals)
                                     : drive::unlisted_tag(number);
}

/// Empty: the row may change under the word that is on the bus.
std::string why_not(const drive::Tag& before, const drive::Tag& now, std::uint16_t word)
{
    if (!drive::is_same_value(before, now) || (drive::has_scale(before) && !drive::has_scale(now)))
        return fmt::format("tag {}, which the master uses, would be another value", now.number);
    if (drive::is_within_limits(before, word) && !drive::is_within_limits(now, word))
        return fmt::format("tag {} is {}, which is outside its new limits", now.number,
                           drive::displayed(now, word));
    return {};
}

/// A row moves when one is put in before it: that is no change of it.
bool is_same_row(drive::Tag a, const drive::Tag& b)
{
    a.position = b.position;
    return a == b;
}

std::size_t changed_rows(const drive::TagTable& before, const drive::TagTable& now)
{
    std::size_t count = 0;
    for (const drive::Tag& row : now.all()) {
        const drive::Tag* const known = before.find(row.number);
        if (known == nullptr || !is_same_row(*known, row)) ++count;
    }
    for (const drive::Tag& row : before.all())
        if (now.find(row.number) == nullptr) ++count;
    return count;
}

void look_at_rows(const config::StationConfig& before, const config::StationConfig& now,
                  const InForce& in_force, StationChange& change)
{
    if (*before.tags == *now.tags && before.unlisted_decimals == now.unlisted_decimals) return;
    for (const TagInUse& used : in_force.tags) {
        if (!used.word) continue;
        const std::string reason = why_not(row_of(before, used.tag), row_of(now, used.tag), *used.word);
        if (!reason.empty()) change.leaves.add(reason);
    }
    const std::size_t rows = changed_rows(*before.tags, *now.tags);
    if (rows > 0) change.applied.add(fmt::format("{} {} of its tag table", rows, rows == 1 ? "row" : "rows"));
}

} // namespace

StationChange change_of(const config::StationConfig& before, const config::StationConfig& now,
                        const InForce& in_force)
{
    StationChange change;
    look_at_keys(before, now, change);
    look_at_rows(before, now, in_force, change);
    return change;
}

} // namespace dpslave::app
