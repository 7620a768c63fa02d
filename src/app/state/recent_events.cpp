// SPDX-License-Identifier: Apache-2.0
#include "recent_events.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>
#include <array>

namespace dpslave::app {
namespace {

/// At most `longest` octets of it, in whole characters.
std::string cut(std::string_view text, std::size_t longest)
{
    std::string whole = printable(text);
    if (whole.size() <= longest) return whole;
    std::size_t end = 0;
    for (std::size_t next = 0; next <= longest;
         next += character_length(std::string_view{whole}.substr(next)))
        end = next;
    return whole.substr(0, end) + " ...";
}

} // namespace

std::string_view code(Happened kind) noexcept
{
    static constexpr std::array<std::string_view, 9> kCodes{"state", "refused", "drive",  "device", "port",
                                                            "write", "setting", "reload", "daemon"};
    return kCodes[static_cast<std::size_t>(kind)];
}

void RecentEvents::add(Happened kind, std::string_view station, std::string_view text, Instant now)
{
    add(kind, station, text, text, now);
}

/// The event that an equal one joins; null: it is one of its own. A drive that was lost and answers again is
/// two events in their order. What goes back and forth without end must not push everything else out.
RecentEvents::Event* RecentEvents::to_join(Happened kind, std::string_view station, std::string_view key,
                                           Instant now)
{
    Event* equal = nullptr;
    std::size_t of_its_kind = 0, behind_equal = 0;
    for (auto old = events_.rbegin(); old != events_.rend() && now - old->at < kJoined; ++old) {
        if (old->kind != kind || old->station != station) continue;
        if (equal == nullptr && old->key == key) {
            equal = &*old;
            behind_equal = of_its_kind;
        }
        ++of_its_kind;
    }
    const bool is_too_many = of_its_kind >= kMostOfOne;
    return behind_equal == 0 || is_too_many ? equal : nullptr;
}

void RecentEvents::add(Happened kind, std::string_view station, std::string_view text, std::string_view key,
                       Instant now)
{
    if (Event* const equal = to_join(kind, station, key, now)) {
        ++equal->count;
        equal->text = cut(text, kLongest);
        return;
    }
    if (events_.size() == kMost) events_.pop_front();
    events_.push_back({++newest_, now, std::string{station}, kind, cut(text, kLongest), 1, std::string{key}});
}

} // namespace dpslave::app
