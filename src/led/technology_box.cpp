// SPDX-License-Identifier: Apache-2.0
/// HA463561U002, "Understanding the LED Indications": NETWORK and MODULE by NETWORK STATE and FAULT, HEALTH
/// and RUN mirrored from the drive. On is good, off is bad (B-035).
#include "languages.hpp"

namespace dpslave::led {
namespace {

using std::chrono::milliseconds;

// The manual draws them; its figures are lost. All three have the same period, so that two lamps side by side
// can be compared [DEC, B-034].
constexpr Pattern kShortFlash{milliseconds{1000}, milliseconds{100}};
constexpr Pattern kFlash = kFlash1Hz;
constexpr Pattern kLongFlash{milliseconds{1000}, milliseconds{900}};

struct ModuleRow {
    Pattern pattern;
    std::string_view meaning;
};

// The MODULE lamp, in the order of OptionFault.
constexpr std::array kModule = std::to_array<ModuleRow>({
    {kOn, "valid set-up, ready for external communications"},
    {kLongFlash, "set-up fault: a parameter of the TEC OPTION function block is out of range"},
    {kFlash, "wrong type or disabled: TYPE is not PROFIBUS DP"},
    {kShortFlash, "self-test failed: hardware fault, internal"},
    {kOff, "hardware fault, external: the bus port cannot be opened, or the drive is gone"},
    {kOff, "no option fitted"}, // no pattern of its own: off, as all that is bad [DEC, B-035]
});

static_assert(kModule.size() == static_cast<std::size_t>(OptionFault::missing) + 1);

// The NETWORK lamp, in the order of NetworkState.
constexpr std::array kNetwork = std::to_array<ModuleRow>({
    {kOn, "data exchange with the master"},
    {kLongFlash, "data exchange with error: at least one parameter cannot be read or written"},
    {kFlash, "waiting for configuration by the master"},
    {kShortFlash, "waiting for parameterisation by the master"},
    {kOff, "baud search: no valid communications detected"},
    {kOff, "disabled: FAULT says why"},
});

static_assert(kNetwork.size() == static_cast<std::size_t>(NetworkState::disabled) + 1);

constexpr Pattern lamp(bool is_lit)
{
    return is_lit ? kOn : kOff;
}

} // namespace

Shown technology_box(const Condition& condition)
{
    if (!condition.running)
        return {{{"network", kOff}, {"module", kOff}, {"health", kOff}, {"run", kOff}},
                "no power: this station is not served"};

    const ModuleRow& module = kModule[static_cast<std::size_t>(condition.fault)];
    const ModuleRow& network = kNetwork[static_cast<std::size_t>(condition.network)];
    const bool ready = module.pattern == kOn; // else NETWORK is off whatever its state (B-032)
    // The last health report of a silent drive does not count.
    const Pattern health = lamp(condition.drive_answers && condition.health);
    const Pattern run = lamp(condition.drive_answers && condition.run);
    return {{{"network", ready ? network.pattern : kOff},
             {"module", module.pattern},
             {"health", health},
             {"run", run}},
            ready ? network.meaning : module.meaning};
}

} // namespace dpslave::led
