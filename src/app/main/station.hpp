// SPDX-License-Identifier: Apache-2.0
/// A station as the main thread has it. Main thread only.
#pragma once

#include "app/links.hpp"

#include "dpslave/config/config.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dpslave::app {

class BusStation;
class DeviceState;
struct DriveLine;

/// Its parts, which copies share, and the newest that is known of it.
struct Station {
    std::uint32_t number = 0; ///< DriveUnit::number
    std::shared_ptr<const config::StationConfig> config;
    std::shared_ptr<StationLink> link;
    std::shared_ptr<BusStation> bus_station;
    std::shared_ptr<DriveLine> drive_line;
    std::shared_ptr<DeviceState> device;
    const config::LineConfig* line = nullptr; ///< of `drive_line`

    BusOrders ordered;        ///< as published last
    std::uint8_t address = 0; ///< in force
    dp::Snapshot bus{};
    drive::UnitSnapshot drive{};
    bool line_open = false;
    bool ever_answered = false;    ///< the drive, since the station was added
    std::string silent_because;    ///< why it is silent on the bus (FAULT of TEC OPTION), and the remedy
    std::vector<Trouble> troubles; ///< what the drive or the tag table refused, newest last
};

} // namespace dpslave::app
