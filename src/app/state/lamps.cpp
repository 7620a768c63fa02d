// SPDX-License-Identifier: Apache-2.0
#include "lamps.hpp"

#include <algorithm>

namespace dpslave::app {

std::vector<std::string> Lamps::exchange(const config::Config& config)
{
    std::vector<Lamp> before;
    std::swap(before, lamps_);
    languages_.clear();
    dark_.clear();
    conditions_.assign(config.stations.size(), {});
    for (std::size_t i = 0; i < config.stations.size(); ++i) {
        const config::StationConfig& station = config.stations[i];
        languages_.push_back(station.profile->leds);
        for (const config::LedConfig& led : station.leds) {
            const auto known = std::find_if(before.begin(), before.end(), [&](const Lamp& lamp) {
                return lamp.config.sink == led.sink && config.sysfs == sysfs_;
            });
            lamps_.push_back({.station = i, .config = led, .pattern = {}, .sink = {}});
            if (known != before.end()) lamps_.back().sink = std::move(known->sink);
        }
    }
    sysfs_ = config.sysfs;
    before.clear(); // dark, and free for others, before new ones are opened

    std::vector<std::string> warnings;
    for (Lamp& lamp : lamps_) {
        if (lamp.sink) continue;
        auto sink = io::open_led_sink(lamp.config.sink, sysfs_);
        if (sink)
            lamp.sink = std::move(*sink);
        else
            dark_.push_back({.station = lamp.station, .lamp = lamp.config.lamp, .why = sink.error()});
    }
    for (const Dark& one : dark_)
        warnings.push_back(config.stations[one.station].name + ": the lamp " + one.lamp +
                           " stays dark: " + one.why);
    std::erase_if(lamps_, [](const Lamp& lamp) { return !lamp.sink; });
    for (std::size_t i = 0; i < languages_.size(); ++i) set(i, {});
    return warnings;
}

std::optional<std::string> Lamps::trouble(std::size_t station, const std::string& lamp) const
{
    for (const Dark& one : dark_)
        if (one.station == station && one.lamp == lamp) return one.why;
    return std::nullopt;
}

void Lamps::set(std::size_t station, const led::Condition& condition)
{
    conditions_[station] = condition;
    for (const led::Lamp& shown : led::lamps(languages_[station], condition))
        for (Lamp& lamp : lamps_)
            if (lamp.station == station && lamp.config.lamp == shown.name) lamp.pattern = shown.pattern;
}

void Lamps::show(Instant now)
{
    for (Lamp& lamp : lamps_) lamp.sink->set(led::lit(lamp.pattern, now), now);
}

Instant Lamps::next_change(Instant now) const
{
    Instant next = kNever;
    for (const Lamp& lamp : lamps_) next = std::min(next, led::next_change(lamp.pattern, now));
    return next;
}

} // namespace dpslave::app
