// SPDX-License-Identifier: Apache-2.0
#include "trouble_log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::app {

namespace {

bool is_write(const drive::Transaction& access)
{
    return access.kind == drive::Transaction::Kind::write;
}

template <class Trouble>
bool is_of(const Trouble& trouble, const DriveUnit& unit, const drive::Transaction& access)
{
    return trouble.station == unit.number && trouble.tag == access.tag->number &&
           trouble.is_write == is_write(access);
}

} // namespace

/// A value that never fits is a new text each time; one of a cause is told until the access works.
void TroubleLog::add(const DriveUnit& unit, const drive::Transaction& access, AccessError cause,
                     const std::string& text)
{
    const std::uint16_t tag = access.tag->number;
    const auto line = (is_write(access) ? "write of tag " : "tag ") + std::to_string(tag) + ": " + text;
    const auto end = list_.troubles.begin() + list_.count;
    const auto known = std::find_if(list_.troubles.begin(), end,
                                    [&](const Trouble& one) { return is_of(one, unit, access); });
    if (known != end) {
        if (line.compare(0, known->text.size() - 1, known->text.data()) == 0) return;
        std::copy(known + 1, end, known);
        --list_.count;
    }
    if (told_.insert({unit.number, tag, is_write(access), cause}).second)
        happenings_.tell(
            Severity::warning, unit.number, unit.config->name + ": " + line, LineHappenings::Kind::other,
            fmt::format("{}/{}/{}/{}", unit.number, tag, is_write(access), static_cast<int>(cause)));
    if (list_.count == list_.troubles.size()) { // the oldest is dropped
        std::copy(list_.troubles.begin() + 1, list_.troubles.end(), list_.troubles.begin());
        --list_.count;
    }
    Trouble& trouble = list_.troubles[list_.count++];
    trouble = {.station = unit.number, .tag = tag, .is_write = is_write(access), .error = cause, .text = {}};
    line.copy(trouble.text.data(), trouble.text.size() - 1);
    published_.publish(list_);
}

void TroubleLog::remove(const DriveUnit& unit, const drive::Transaction& access)
{
    remove_if([&](const auto& trouble) { return is_of(trouble, unit, access); });
}

void TroubleLog::keep_only(const std::vector<DriveUnit>& units)
{
    remove_if([&](const auto& trouble) {
        return std::none_of(units.begin(), units.end(),
                            [&](const DriveUnit& unit) { return unit.number == trouble.station; });
    });
}

void TroubleLog::remove_changed_rows(const DriveUnit& unit, const config::StationConfig& next)
{
    const config::StationConfig& before = *unit.config;
    remove_if([&](const auto& trouble) {
        if (trouble.station != unit.number) return false;
        const drive::Tag* const old = before.tags->find(trouble.tag);
        const drive::Tag* const row = next.tags->find(trouble.tag);
        if (old == nullptr || row == nullptr)
            return old != row || before.unlisted_decimals != next.unlisted_decimals;
        return !drive::is_same_value(*old, *row) || drive::has_scale(*old) != drive::has_scale(*row);
    });
}

template <class Condition>
void TroubleLog::remove_if(Condition condition)
{
    std::erase_if(told_, condition);
    const auto end = list_.troubles.begin() + list_.count;
    const auto kept = std::remove_if(list_.troubles.begin(), end, condition);
    if (kept == end) return;
    list_.count = static_cast<std::uint8_t>(kept - list_.troubles.begin());
    published_.publish(list_);
}

} // namespace dpslave::app
