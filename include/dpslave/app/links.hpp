// SPDX-License-Identifier: Apache-2.0
/// All that crosses between the threads: one struct per pair of neighbours, made of Mailbox and Ring only.
/// Each member names its one writer and its one reader (docs/architecture.md, "Three kinds of threads").
#pragma once

#include "dpslave/base/mailbox.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/ring.hpp"
#include "dpslave/dp/slave.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/fdl/station.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

namespace dpslave::app {

/// What the main thread wants of a station on the bus.
struct BusOrders {
    bool enabled = true; ///< false: the station is silent (TEC OPTION: FAULT is not NONE)
    std::uint8_t address = 0;
    ByteBuffer<8> ext_diag;      ///< the block of the extended diagnosis; empty = the device has none
    bool ext_diag_fault = false; ///< it reports a fault, and the Ext_Diag bit shall say so
    friend bool operator==(const BusOrders&, const BusOrders&) = default;
};

/// StationLink::zero_after_ms: how ZeroAfter crosses between threads.
inline constexpr std::int64_t kNeverToZero = -1;
constexpr std::int64_t to_ms(drive::ZeroAfter after)
{
    return after ? std::chrono::ceil<std::chrono::milliseconds>(*after).count() : kNeverToZero;
}
constexpr drive::ZeroAfter from_ms(std::int64_t after)
{
    if (after == kNeverToZero) return std::nullopt;
    return std::chrono::milliseconds{after};
}

/// One station between its bus, its drive line and the main thread.
struct StationLink {
    // drive -> bus
    Mailbox<InputImage> inputs;
    /// Newest wins: an answer to an order that no longer stands is dropped anyway.
    Mailbox<DemandAnswer> demand_answer;
    // bus -> drive
    /// Every layout up to this generation has ended. Stored before the outputs of the next layout are
    /// published, read after them: whoever sees a new layout also sees the end of the old one. It only grows,
    /// so no end is overwritten.
    std::atomic<Generation> ended{0};
    Mailbox<OutputImage> outputs;
    Ring<DemandOrder, 16> demand_orders;
    // bus -> main
    Mailbox<dp::Snapshot> bus_snapshot;
    Ring<dp::Event, 64> events;
    // drive -> main
    Mailbox<drive::UnitSnapshot> drive_snapshot;
    // main -> bus
    Mailbox<BusOrders> bus_orders;
    // main -> drive
    /// When the outputs go to zero after the loss of the master, ms; kNeverToZero = never. Settable while the
    /// program runs (RIDE THROUGH).
    std::atomic<std::int64_t> zero_after_ms{0};
};

/// The bus as a whole, bus -> main.
struct BusSnapshot {
    Baud baud = Baud::k9_6;
    fdl::BaudState baud_state = fdl::BaudState::fixed;
    bool port_open = false;
    Instant last_telegram{}; ///< default = none was heard yet
    fdl::Counters counters{};
    std::uint64_t write_errors = 0;
    bool valid = false; ///< false: nothing was published yet
};
struct BusLink {
    Mailbox<BusSnapshot> snapshot;
    /// Counts the rounds of the bus thread: while it moves, the watchdog of systemd is fed.
    std::atomic<std::uint64_t> heartbeat{0};
    /// A thread had to give up (said in the log): the main thread ends the program.
    std::atomic<bool> failed{false};
};

/// What a drive said no to, in words; the newest few of a line.
struct Trouble {
    std::uint32_t station = 0; ///< index in config.stations
    std::uint16_t tag = 0;
    bool is_write = false;        ///< a tag may be read and refuse to be written
    std::array<char, 160> text{}; ///< ends with NUL
};
struct TroubleList {
    std::array<Trouble, 16> troubles{};
    std::uint8_t count = 0;
};

/// A drive line and the main thread.
struct LineLink {
    Ring<drive::OperateOrder, 16> orders;   // main -> drive
    Ring<drive::OperateAnswer, 16> answers; // drive -> main
    Mailbox<TroubleList> troubles;          // drive -> main
    std::atomic<bool> port_open{false};
};

} // namespace dpslave::app
