// SPDX-License-Identifier: Apache-2.0
#include "device_news.hpp"

#include "report.hpp"

#include <fmt/format.h>

namespace dpslave::app {

void DeviceNews::update(const Station& station, const EmulatedDevice& device, const BusSnapshot& bus)
{
    const TecOption* const tec = device.tec();
    if (tec != nullptr) say_ride_through(station, *tec);
    for (Sentence& one : presence_.take(station)) say(station, one.is_warning, std::move(one.text));
    say_status(station, device);
    say_scales(station);
    if (tec == nullptr) return;
    const bool began = tec->fault() != OptionFault::none || station.bus.state != dp::State::power_on;
    if (bus.valid && began && !station.drive.away) say_fault(station, *tec);
    say_trip(station, device);
}

void DeviceNews::say(const Station& station, bool is_warning, std::string text)
{
    news_.push_back({.is_warning = is_warning, .text = station.config->name + ": " + std::move(text)});
}

void DeviceNews::say_ride_through(const Station& station, const TecOption& tec)
{
    if (std::exchange(ride_through_changes_, tec.ride_through_changes()) == tec.ride_through_changes())
        return;
    const std::int32_t now = tec.settings().ride_through;
    if (now == 0)
        say(station, false, "RIDE THROUGH is 0 again");
    else
        say(station, true, fmt::format("RIDE THROUGH is {}. {}", now, kRideThroughWarning));
}

void DeviceNews::say_fault(const Station& station, const TecOption& tec)
{
    if (std::exchange(fault_, tec.fault()) != tec.fault()) {
        if (fault_ == OptionFault::none)
            say(station, false, "FAULT is NONE again");
        else
            say(station, true, tec.fault_words());
    }
    if (network_ == tec.network()) return;
    network_ = tec.network();
    say(station, network_ == NetworkState::data_ex_error,
        fmt::format("NETWORK STATE is {}", dpslave::text(*network_)));
}

void DeviceNews::say_trip(const Station& station, const EmulatedDevice& device)
{
    const std::uint8_t now = device.trip_octet();
    if (std::exchange(trip_, now) == now) return;
    if (now == 0)
        say(station, false, "trip of the drive: none any more");
    else
        say(station, true, "trip of the drive: " + *device.trip());
}

/// Once for each set of tags: what holds the start, what reads 0, and what to do.
void DeviceNews::say_scales(const Station& station)
{
    std::string now = start_words(station);
    if (station.bus.state != dp::State::data_exch) scales_.clear(); // nothing is chosen any more
    const bool is_known = station.bus.state == dp::State::data_exch && !station.bus.stat_diag &&
                          station.drive.generation == station.bus.layout.generation;
    if (now == scales_ || (now.empty() && !is_known)) return;
    if (now.empty())
        say(station, false, "the drive has every tag that the master has chosen, and its scale is known");
    else
        say(station, true, now);
    scales_ = std::move(now);
}

void DeviceNews::say_status(const Station& station, const EmulatedDevice& device)
{
    const config::StationConfig& config = *station.config;
    if (config.profile->diagnosis != profile::DiagForm::status_word) return;
    const std::uint16_t word = device.watched().word_of(config.status_tag);
    const auto faults = static_cast<std::uint16_t>(word & config.profile->fault_mask);
    if (std::exchange(status_, faults) == faults) return;
    if (faults == 0)
        say(station, false, "the instrument no longer reports an alarm or a fault");
    else
        say(station, true,
            fmt::format("the instrument reports {}", shown_value(*config.tags, config.status_tag, word)));
}

} // namespace dpslave::app
