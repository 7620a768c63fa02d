// SPDX-License-Identifier: Apache-2.0
#include "dpslave/led/pattern.hpp"

#include <array>

namespace dpslave::led {
namespace {

using std::chrono::milliseconds;

constexpr Pattern kOff{milliseconds{0}, milliseconds{0}};
constexpr Pattern kOn{milliseconds{0}, milliseconds{1}};
constexpr Pattern kFlash1Hz{milliseconds{1000}, milliseconds{500}};
constexpr Pattern kFlash2Hz{milliseconds{500}, milliseconds{250}};

/// What the two lamps of the option board can say (HA389815 ch. 9).
enum class Say : std::uint8_t { dark, normal, external_fault, internal_fault };

struct Row {
    Pattern red;
    Pattern red_620; ///< the 620 shows one fault differently (X-32)
    Pattern green;
    std::string_view meaning;
};

// In the order of Say.
constexpr std::array kTable = std::to_array<Row>({
    {kOff, kOff, kOff, "no power or major fault: this station is not served"},
    {kOff, kOff, kFlash2Hz, "normal operation: data exchange with the master"},
    {kOn, kOn, kFlash1Hz,
     "external communications fault or configuration fault: no data exchange with the master"},
    {kOn, kFlash2Hz, kFlash2Hz, "internal communications fault: the drive does not answer"},
});

/// The internal fault goes before the external one: without its drive the board has nothing to exchange, and
/// whoever looks for a fault on the bus first would look in vain.
constexpr Say say(const Condition& condition)
{
    if (!condition.running) return Say::dark;
    if (!condition.drive_answers) return Say::internal_fault;
    return condition.data_exchange ? Say::normal : Say::external_fault;
}

constexpr const Row& row_of(const Condition& condition)
{
    return kTable[static_cast<std::size_t>(say(condition))];
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

} // namespace

std::vector<Lamp> lamps(Language language, const Condition& condition)
{
    const Row& row = row_of(condition);
    const Pattern& red = language == Language::option_board_620 ? row.red_620 : row.red;
    return {{"red", red}, {"green", row.green}};
}

std::string_view meaning(Language, const Condition& condition)
{
    return row_of(condition).meaning;
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
