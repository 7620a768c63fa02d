// SPDX-License-Identifier: Apache-2.0
/// What is told of the device of a station when it has changed: sentences for the log and for `dpctl events`.
/// Pure.
#pragma once

#include "emulated_device.hpp"
#include "presence_words.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::app {

class DeviceNews {
public:
    /// Compares with the update before: presence of the drive, FAULT, NETWORK STATE, trip, faults of a status
    /// word, scales, and each RIDE THROUGH that was set and could compromise safety (B-047).
    void update(const Station& station, const EmulatedDevice& device, const BusSnapshot& bus);
    /// The sentences since the last call.
    std::vector<Sentence> take() { return std::exchange(news_, {}); }

private:
    void say(const Station& station, bool is_warning, std::string text);
    void say_ride_through(const Station& station, const TecOption& tec);
    void say_fault(const Station& station, const TecOption& tec);
    void say_trip(const Station& station, const EmulatedDevice& device);
    void say_status(const Station& station, const EmulatedDevice& device);
    void say_scales(const Station& station);

    OptionFault fault_ = OptionFault::none;
    std::optional<NetworkState> network_;
    std::uint8_t trip_ = 0;
    PresenceNews presence_;
    std::uint16_t status_ = 0;
    std::string scales_;
    std::uint32_t ride_through_changes_ = 0;
    std::vector<Sentence> news_;
};

} // namespace dpslave::app
