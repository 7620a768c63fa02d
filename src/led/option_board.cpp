// SPDX-License-Identifier: Apache-2.0
/// HA389815 ch. 9: the red and the green lamp of the option board.
#include "languages.hpp"

namespace dpslave::led {
namespace {

using std::chrono::milliseconds;

constexpr Pattern kFlash2Hz{milliseconds{500}, milliseconds{250}};

/// The two lamps of the option board can say this (HA389815 ch. 9).
enum class Say : std::uint8_t { dark, normal, external_fault, internal_fault };

struct Row {
    Pattern red;
    Pattern red_620; ///< the 620 shows one fault differently (X-32)
    Pattern green;
    std::string_view meaning;
};

// The rows are in the order of Say.
constexpr std::array kTable = std::to_array<Row>({
    {kOff, kOff, kOff, "no power or major fault: this station is not served"},
    {kOff, kOff, kFlash2Hz, "normal operation: data exchange with the master"},
    {kOn, kOn, kFlash1Hz,
     "external communications fault or configuration fault: no data exchange with the master"},
    {kOn, kFlash2Hz, kFlash2Hz, "internal communications fault: the drive does not answer"},
});

/// The internal fault goes before the external one: without its drive the board has nothing to exchange, and
/// a fault on the bus would be looked for first, in vain.
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

} // namespace

Shown option_board(const Condition& condition, bool is_620)
{
    const Row& row = row_of(condition);
    return {{{"red", is_620 ? row.red_620 : row.red}, {"green", row.green}}, row.meaning};
}

} // namespace dpslave::led
