// SPDX-License-Identifier: Apache-2.0
#include "languages.hpp"

namespace dpslave::led {
namespace {

using std::chrono::milliseconds;

Shown shown(Language language, const Condition& condition)
{
    switch (language) {
        case Language::option_board: return option_board(condition, false);
        case Language::option_board_620: return option_board(condition, true);
        case Language::technology_box: return technology_box(condition);
        case Language::controller: return controller(condition);
    }
    return {};
}

constexpr bool is_steady(const Pattern& pattern)
{
    return pattern.period <= milliseconds{0} || pattern.on <= milliseconds{0} || pattern.on >= pattern.period;
}

/// Time since the present period began; never negative, also before the time line's zero.
constexpr std::chrono::nanoseconds phase(const Pattern& pattern, Instant now)
{
    const std::chrono::nanoseconds period = pattern.period;
    const std::chrono::nanoseconds rest = now.time_since_epoch() % period;
    return rest.count() < 0 ? rest + period : rest;
}

/// The three flashes of a technology box differ in how long they are lit, not in their period.
std::string flash_words(const Pattern& pattern)
{
    const auto twice = 2 * pattern.on;
    const char* const name = twice < pattern.period   ? "short flash"
                             : twice > pattern.period ? "long flash"
                                                      : "flash";
    const auto percent = 100 * pattern.on / pattern.period;
    const auto length = pattern.period % std::chrono::seconds{1} == milliseconds{0}
                            ? std::to_string(pattern.period / std::chrono::seconds{1}) + " s"
                            : std::to_string(pattern.period.count()) + " ms";
    return std::string{name} + " (" + std::to_string(percent) + " % of " + length + ")";
}

} // namespace

std::vector<Lamp> lamps(Language language, const Condition& condition)
{
    return shown(language, condition).lamps;
}

std::string_view meaning(Language language, const Condition& condition)
{
    return shown(language, condition).meaning;
}

std::string words(Language language, const Pattern& pattern)
{
    if (is_steady(pattern)) return pattern.on > milliseconds{0} ? "on" : "off";
    if (language == Language::technology_box) return flash_words(pattern);
    if (const milliseconds second{1000}; second % pattern.period == milliseconds{0})
        return "flashing " + std::to_string(second / pattern.period) + " Hz";
    return "flashing every " + std::to_string(pattern.period.count()) + " ms";
}

bool lit(const Pattern& pattern, Instant now)
{
    if (is_steady(pattern)) return pattern.on > milliseconds{0};
    return phase(pattern, now) < pattern.on;
}

Instant next_change(const Pattern& pattern, Instant now)
{
    if (is_steady(pattern)) return kNever;
    const std::chrono::nanoseconds at = phase(pattern, now);
    const std::chrono::nanoseconds wait = (at < pattern.on ? pattern.on : pattern.period) - at;
    return now > kNever - wait ? kNever : now + wait;
}

} // namespace dpslave::led
