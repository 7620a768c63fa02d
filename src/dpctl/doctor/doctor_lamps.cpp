// SPDX-License-Identifier: Apache-2.0
// The lamps of the gateway, for a station of any family.
#include "doctor_rules.hpp"

namespace dpslave::dpctl {
namespace {

std::string seen_lamp(const Facts& f)
{
    std::string all;
    for (const report::StationLeds& station : f.replies.leds.stations)
        for (const report::Led& led : station.leds)
            if (station.name == f.station.name && led.trouble)
                all += (all.empty() ? "lamp " : "; lamp ") + led.name + ": " + *led.trouble;
    return all;
}

constexpr std::array kLampRules = std::to_array<Rule>({
    {"station.lamp", Rank::stands, "a lamp of the gateway stays dark",
     "A lamp cannot be switched, or its chip does not answer: it shows nothing",
     "Compare the line or the name of the lamp in [station.leds] with gpioinfo, and with ls /sys/class/leds\n"
     "Check that no other program has this line. Check that the service may use it: its groups and the udev "
     "rule.\n"
     "The daemon tries it again by itself, after 30 s at most. Until then look at the lamps with dpctl show",
     kGateway, seen_lamp},
});

} // namespace

std::span<const Rule> lamp_rules()
{
    return kLampRules;
}

} // namespace dpslave::dpctl
