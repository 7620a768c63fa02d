// SPDX-License-Identifier: Apache-2.0
/// A station as the main thread has it. Main thread only.
#pragma once

#include "app/links/links.hpp"

#include "dpslave/config/config.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dpslave::app {

class BusStation;
class DeviceNews;
class EmulatedDevice;
struct DriveLine;

/// Its parts, which copies share, and the newest that is known of it.
struct Station {
    std::uint32_t number = 0; ///< DriveUnit::number
    std::shared_ptr<const config::StationConfig> config;
    std::shared_ptr<StationLink> link;
    std::shared_ptr<BusStation> bus_station;
    std::shared_ptr<DriveLine> drive_line;
    std::shared_ptr<EmulatedDevice> device;
    std::shared_ptr<DeviceNews> news;         ///< of `device`
    const config::LineConfig* line = nullptr; ///< of `drive_line`

    BusOrders ordered;        ///< as published last
    std::uint8_t address = 0; ///< in force
    dp::Snapshot bus{};
    drive::DriveSnapshot drive{};
    bool line_open = false;
    /// Its line has given no sign for so long that the drive counts as lost, and the call that it is
    /// in; 0: it goes round.
    std::chrono::nanoseconds line_stalled{};
    io::PortCall stalled_in = io::PortCall::none;
    /// Of the transceiver of its line, where the program switches it (io::TransceiverCounts).
    std::uint64_t late_releases = 0, guarded_releases = 0, driver_errors = 0, driver_raised = 0;
    std::uint64_t settings_changed = 0; ///< times that other programs had changed the settings of its line
    std::string port_settings;          ///< what they changed last
    std::uint64_t orders_dropped = 0;   ///< StationLink::orders_dropped
    bool ever_answered = false;         ///< the drive, since the station was added
    std::string silent_because;         ///< why it is silent on the bus (FAULT of TEC OPTION), and the remedy
    std::vector<Trouble> troubles;      ///< what the drive or the tag table refused, newest last
};

} // namespace dpslave::app
