// SPDX-License-Identifier: Apache-2.0
/// All that crosses between the threads: one struct per pair of neighbours, made of Mailbox, Ring, Handover
/// and atomics. Each member names its one writer and its one reader (docs/internals/architecture.md, "Five
/// kinds of threads").
#pragma once

#include "line_happenings.hpp"
#include "line_trace.hpp"
#include "order_states.hpp"
#include "probe_report.hpp"

#include "dpslave/base/handover.hpp"
#include "dpslave/base/histogram.hpp"
#include "dpslave/base/mailbox.hpp"
#include "dpslave/base/process_image.hpp"
#include "dpslave/base/ring.hpp"
#include "dpslave/config/config.hpp"
#include "dpslave/dp/bus_members.hpp"
#include "dpslave/dp/pending_events.hpp"
#include "dpslave/dp/snapshot.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/fdl/layer2.hpp"
#include "dpslave/io/changed_settings.hpp"
#include "dpslave/io/switched_port.hpp"
#include "dpslave/io/thread_sign.hpp"
#include "dpslave/trace/samples.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::app {

/// What a station on the bus is to be, main -> bus.
struct BusOrders {
    bool enabled = true; ///< false: the station is silent (TEC OPTION: FAULT is not NONE)
    std::uint8_t address = 0;
    ByteBuffer<8> ext_diag;      ///< the block of the extended diagnosis; empty = the device has none
    bool ext_diag_fault = false; ///< it reports a fault, and the Ext_Diag bit shall say so
    /// How long the line of its drive may stall (drive_lost_after_s).
    std::chrono::nanoseconds drive_lost_after = std::chrono::seconds{2};
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

/// The signs of the threads that every line works for; of none before it begins.
struct ProgramSigns {
    SignOfLife bus, main;
};
/// How long they may give none. Behind kProgramMayStall the watchdog ends the program, or the one that
/// still goes round does.
inline constexpr std::chrono::milliseconds kBusThreadMayStall{1000}, kMainThreadMayStall{2500},
    kProgramMayStall{5000};

/// One station between its bus, its drive line and the main thread.
struct StationLink {
    /// `sign`: of the line of its drive; null: nothing judges it.
    explicit StationLink(std::shared_ptr<io::ThreadSign> sign = {}) : line_sign(std::move(sign)) {}

    /// When the line of its drive went round last.
    const std::shared_ptr<io::ThreadSign> line_sign;
    // drive -> bus
    /// Counts how often the station has left for a drive that is gone, and has come back: odd while it
    /// is away. A bus thread that missed both still leaves once. 2 more: the line took the master for lost,
    /// since the bus thread or the main thread had stalled.
    std::atomic<std::uint32_t> departures{0};
    Mailbox<InputImage> inputs;
    /// Newest wins: an answer to an order that no longer stands is dropped anyway.
    Mailbox<DemandAnswer> demand_answer;
    /// The stalls of its line that this one has taken note of: what follows from them for this station
    /// was published before.
    std::atomic<std::uint32_t> stalls_noted{0};
    // bus -> drive
    /// How often the drive counted as gone because its line stalled.
    std::atomic<std::uint32_t> stalls{0};
    /// The newest order of Demand Data that came while its line stalled; none before it stands. Numbers go
    /// round; 0: none came.
    std::atomic<std::uint32_t> stands_from{0};
    /// Every layout up to this generation has ended. Stored before the outputs of the next layout are
    /// published, read after them: a thread that sees a new layout also sees the end of the old one. It only
    /// grows, so no end is overwritten.
    std::atomic<Generation> ended{0};
    Mailbox<OutputImage> outputs;
    Ring<DemandOrder, 16> demand_orders;
    // bus -> main
    /// Writes of Demand Data that were never made: newer orders came while the line stalled.
    std::atomic<std::uint64_t> orders_dropped{0};
    Mailbox<dp::Snapshot> bus_snapshot;
    Ring<dp::Event, 64> events;
    // drive -> main
    Mailbox<drive::DriveSnapshot> drive_snapshot;
    // main -> bus
    Mailbox<BusOrders> bus_orders;
    // main -> drive
    /// When the outputs go to zero after the loss of the master, ms; kNeverToZero = never. Settable while the
    /// program runs (RIDE THROUGH).
    std::atomic<std::int64_t> zero_after_ms{0};
};

class BusStation;
/// The stations of the bus, at most 127, in any order. A station that is in the present set and in the next
/// one stays on the bus without a break.
using BusStations = std::vector<std::shared_ptr<BusStation>>;

/// What happened to the port of the bus, for the log.
enum class PortEvent : std::uint8_t {
    lost,
    back,
    driver_lost, ///< an edge of the driver enable failed: nothing is sent until it works again
    driver_back,
    driver_guarded, ///< only the guard made it inactive; reported once until the port is opened again
};

/// A sentence about the port, with its path, each reason once.
struct PortMessage {
    bool is_warning = false; ///< else the port is closed
    std::string text;
};

/// The bus as a whole, bus -> main.
struct BusSnapshot {
    Baud baud = Baud::k9_6;
    fdl::BaudState baud_state = fdl::BaudState::fixed;
    bool port_open = true; ///< the daemon starts with an open port
    Instant taken_at{};
    Instant last_telegram{}; ///< with a right checksum, of any station; default = none was heard yet
    fdl::Counters counters{};
    dp::BusMembers::UnansweredList unanswered{}; ///< addresses that do not answer, ours among them
    std::uint64_t write_errors = 0;
    std::uint64_t settings_changed = 0; ///< times that another program had changed the settings of the port
    std::uint64_t unsent = 0;           ///< replies not sent: write errors, no port, or no driver enable
    /// Of each reply, from the read of the request's last octet to the end of the write: us, and T_bit of the
    /// rate of then.
    Histogram turnaround_us, turnaround_tbit;
    std::uint64_t too_late = 0;       ///< replies whose write began within their window and ended behind it
    bool driver_works = true;         ///< false: an edge of the driver enable has failed, nothing is sent
    std::uint64_t driver_errors = 0;  ///< edges of the driver enable that failed
    std::uint64_t driver_guarded = 0; ///< times that only the guard made the driver enable inactive
    std::uint64_t echo_broken = 0;    ///< echoes that were not what was sent
    std::uint64_t echo_missing = 0;   ///< echoes that were due and did not come
    std::uint64_t page_faults = 0;    ///< of the bus thread since it serves with locked memory
    bool valid = false;               ///< false: nothing was published yet
};
struct BusLink {
    /// `trace_octets`: the size of the ring of the trace; 0: nothing is recorded.
    explicit BusLink(std::size_t trace_octets = 0) : trace(trace_octets) {}

    Mailbox<BusSnapshot> snapshot;
    /// Who is on the bus, bus -> main; twice a second.
    Mailbox<dp::BusMembers::Table> members;
    ProgramSigns signs; ///< bus and main -> whoever judges
    /// A thread has failed (the log says how): the main thread ends the program.
    std::atomic<bool> failed{false};
    /// The stations from now on, main -> bus, and back the set of before.
    Handover<BusStations> stations;
    Ring<PortEvent, 8> port_events; ///< bus -> main
    /// What other programs changed of the settings of the port, bus -> main. They are set right.
    Ring<io::ChangedSettings, 4> settings_changed;
    /// Why the port is closed and stays so, or what it cannot do since it is open again, bus -> main.
    Handover<PortMessage> port_messages;
    std::atomic<Baud> baud{Baud::k9_6}; ///< the rate of replies, bus -> guard of the driver enable
    std::atomic<bool> ended{false};     ///< the bus thread has ended
    /// Is called on the bus thread when the main thread has stalled for kProgramMayStall and no service
    /// manager ends the program; null: one does.
    std::function<void()> end_program;
    /// Main -> bus: the memory is locked, if it is to be. The bus is served before.
    std::atomic<bool> memory_is_ready{true};
    trace::Ring trace; ///< what was heard and sent, bus -> whoever looks
    /// How long the port may keep a received character, bus -> main.
    std::atomic<std::int64_t> hold_back_ns{0};
};

/// What a drive refused, in words; the newest few of a line.
struct Trouble {
    std::uint32_t station = 0; ///< DriveUnit::number
    std::uint16_t tag = 0;
    bool is_write = false; ///< a tag may be read and refuse to be written
    AccessError error = AccessError::none;
    std::array<char, 240> text{}; ///< ends with NUL
};
struct TroubleList {
    std::array<Trouble, 16> troubles{};
    std::uint8_t count = 0;
};

/// One drive of a line: the station that it stands for.
struct DriveUnit {
    std::uint32_t number = 0; ///< of the station: never given twice while the program runs
    std::shared_ptr<const config::StationConfig> config;
    std::shared_ptr<StationLink> link;
};

/// What a reload changes at a line.
struct LineChange {
    /// One that was there before goes on without a break, with its `config` of now.
    std::vector<DriveUnit> units;
    std::optional<config::LineConfig> line; ///< a key of it is different
    bool opens_port = false;                ///< the port is another one, or set in another way
    bool is_other_port = false;             ///< with `opens_port`: standing outputs are written there at once
    bool leaves_drives = false; ///< with `is_other_port`: the drives at the old one go to the safe state
    bool is_held = false;       ///< with `opens_port`: another line has it still, and will close it

    /// It comes in place of `older`, which the line has not taken: both are one.
    void replaces(LineChange older)
    {
        if (!line) line = std::move(older.line);
        if (older.is_other_port) leaves_drives = older.leaves_drives; // the line is still where it was then
        if (!opens_port) is_held = older.is_held;
        opens_port = opens_port || older.opens_port;
        is_other_port = is_other_port || older.is_other_port;
    }
    /// `port`: the one that the line has. Two changes in one may lead back to it.
    void begins_at(const std::string& port)
    {
        if (line && line->port == port) is_other_port = leaves_drives = false;
    }
};

/// An order of `dpctl`; its `unit` is found by the number of the station.
struct LineOrder {
    std::uint32_t station = 0; ///< DriveUnit::number
    drive::OperateOrder order;
    bool is_survey = false;                                 ///< Poller::survey() in place of operate()
    std::optional<drive::MnemonicRule> rule = std::nullopt; ///< of a survey; nothing = that of the profile
};

/// A drive line and the main thread.
struct LineLink {
    /// `trace_octets`, `sample_octets`: the sizes of the rings of its trace and of its samples; 0: nothing is
    /// kept.
    explicit LineLink(std::size_t trace_octets = 0, std::size_t sample_octets = 0)
        : samples(sample_octets), trace(std::make_shared<LineTrace>(trace_octets))
    {}

    Ring<LineOrder, 16> orders;                // main -> drive
    Ring<drive::OperateAnswer, 16> answers;    // drive -> main
    OrderStates order_states;                  ///< of these orders, main and drive
    Ring<ProbeOrder, 2> probes;                // main -> drive
    Ring<ProbeReport, 2> probe_reports;        // drive -> main
    std::atomic<std::uint32_t> probe_tried{0}; ///< drive -> main: questions of the probe that runs
    OrderStates probe_states;                  ///< of these orders, main and drive
    Mailbox<TroubleList> troubles;             // drive -> main
    LineHappenings happenings;                 // drive -> main
    /// Drive -> main: what other programs changed of the settings of the port, and how often. They are set
    /// right.
    std::atomic<std::uint64_t> settings_changed{0};
    Mailbox<io::ChangedSettings> changed_settings;
    /// Drive -> main. It counts as open until it could not be opened.
    std::atomic<bool> port_open{true};
    io::TransceiverCounts transceiver;          ///< of a line that the program switches, drive -> main
    trace::Ring samples;                        ///< trace/samples.hpp, drive -> whoever looks
    Handover<LineChange> change;                // main -> drive
    std::atomic<std::uint32_t> changes_done{0}; ///< drive -> main: how many of them were carried out
    std::atomic<bool> ended{false};             ///< drive -> main: the thread is about to end
    /// Main -> drive: until then the safe state may be written at the end.
    std::atomic<Instant> ends_by{kNever};
    const std::shared_ptr<io::ThreadSign> sign =
        std::make_shared<io::ThreadSign>(); ///< drive -> whoever judges
    /// Its frames, drive -> whoever looks, who may keep it longer than the line is there.
    const std::shared_ptr<LineTrace> trace;
};

} // namespace dpslave::app
