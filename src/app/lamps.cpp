// SPDX-License-Identifier: Apache-2.0
#include "dpslave/app/lamps.hpp"

#include <algorithm>

namespace dpslave::app {

Lamps::Lamps(const Config& config, std::vector<std::string>& warnings)
{
    for (std::size_t i = 0; i < config.stations.size(); ++i) {
        const StationConfig& station = config.stations[i];
        languages_.push_back(station.profile->leds);
        conditions_.emplace_back();
        for (const LedConfig& led : station.leds) {
            auto sink = io::open_led_sink(led.sink, config.sysfs);
            if (sink)
                lamps_.push_back({.station = i, .name = led.lamp, .pattern = {}, .sink = std::move(*sink)});
            else
                warnings.push_back(station.name + ": the lamp " + led.lamp + " stays dark: " + sink.error());
        }
        set(i, {});
    }
}

void Lamps::set(std::size_t station, const led::Condition& condition)
{
    conditions_[station] = condition;
    for (const led::Lamp& shown : led::lamps(languages_[station], condition))
        for (Lamp& lamp : lamps_)
            if (lamp.station == station && lamp.name == shown.name) lamp.pattern = shown.pattern;
}

void Lamps::show(Instant now)
{
    for (Lamp& lamp : lamps_) lamp.sink->set(led::lit(lamp.pattern, now));
}

Instant Lamps::next_change(Instant now) const
{
    Instant next = kNever;
    for (const Lamp& lamp : lamps_) next = std::min(next, led::next_change(lamp.pattern, now));
    return next;
}

} // namespace dpslave::app
