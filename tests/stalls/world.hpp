// SPDX-License-Identifier: Apache-2.0
/// A daemon with one drive line on a simulated clock, in one thread. The loop of the line is the program's
/// own (app/line/drive_thread). Whatever it waits for, and wherever a call of it stalls, time passes here:
/// then the bus thread, the main thread, the PLCs and the script of the history go on beside it.
#pragma once

#include "app/bus/station_set.hpp"
#include "app/line/drive_line.hpp"
#include "plc.hpp"
#include "stall_judge.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

namespace dpslave::stalls {

/// Where a line stalls.
enum class Where : std::uint8_t {
    rest,        ///< in no call: the thread has no processor
    read,        ///< an answer has come, and the call that fetches it does not come back
    write,       ///< of any question
    write_value, ///< of one that writes
    drain,       ///< what was written has left
};
/// When the octets of a write that stalls leave.
enum class Leave : std::uint8_t {
    at_once,
    meanwhile,
    never,  ///< they are in the port when the call comes back
    partly, ///< no drive understands them
};

struct LineStall {
    Instant due{};
    Time length{};
    Where where = Where::rest;
    Leave leave = Leave::at_once;
    std::optional<Time> opens{}; ///< how long the next open stalls behind it
};
struct ThreadStall {
    Instant due{};
    Time length{};
};

/// What a seed makes of it.
struct Setting {
    config::LineConfig line;
    std::vector<StationRules> stations;
    std::vector<std::vector<LayoutEntry>> layouts;
    std::vector<drive::TagTable> tables;
    Time bus_tick = 10ms, main_tick = 50ms;
    int retries = 2;
    bool answers_late = false;
};

class World {
public:
    using Open = std::function<std::unique_ptr<drive::Backend>(World&)>;
    /// `open`: opens the port of the line.
    World(SimulatedLine& line, Setting setting, Open open);
    ~World();
    World(const World&) = delete;

    /// The one that the clock of the program shows.
    static World* current();
    Instant now() const { return now_; }

    /// Runs the loop of the line until stop(). `act`: the script, called at `acts_at`.
    void run(const std::function<void()>& act);
    void stop() { stop_.request_stop(); }
    /// The line is removed from the configuration.
    void leave()
    {
        leaves_ = true;
        judge_.leaves(now_);
        drive_line_.request_stop(now_, kNever);
        stop();
    }
    Instant acts_at = kNever;

    // The script's.
    void line_stalls(const LineStall& stall) { line_stall_ = stall; }
    void bus_stalls(const ThreadStall& stall) { bus_.stall = stall; }
    void main_stalls(const ThreadStall& stall) { main_.stall = stall; }
    bool any_stall() const;
    /// `word`: of a write.
    void order(std::size_t drive, std::uint16_t tag, std::optional<std::uint16_t> word);
    void demand(std::size_t drive, std::uint16_t tag, std::optional<std::uint16_t> word);
    Plc& plc(std::size_t drive) { return *plcs_[drive]; }
    SimulatedLine& line() { return line_; }
    StallJudge& judge() { return judge_; }

    // The line thread's, from the ports: time passes.
    /// It waits until then at most, and gives signs. The line itself may be ahead already.
    void waits_until(Instant until);
    /// It is in no call, and has no processor.
    void may_rest();
    /// It is in a call that may stall.
    void may_stall(Where where);
    /// It is in the call of a write, which sends by `leave`. False: the octets are still in the port.
    bool writes(bool is_value, const std::function<void()>& leave);
    std::unique_ptr<drive::Backend> open_port();
    /// The port is opened; what has come is lost.
    void open();
    /// It is closed, until its next write() opens it.
    void close() { ++times_closed_; }
    unsigned times_closed() const { return times_closed_; }

private:
    struct Thread {
        Timeline& timeline;
        Time tick;
        Instant turns_at{};
        std::optional<ThreadStall> stall{};
    };
    /// Demand Data that its PLC has not sent yet.
    struct Demanded {
        std::optional<std::uint16_t> word; ///< of a write
    };

    void make_station(std::size_t drive);
    void others_until(Instant until);
    bool begins_to_stall(Thread& thread);
    void bus_turn();
    void main_turn();
    void note_exchange(std::size_t drive);
    void fail_orders();
    bool is_due(Where where) const;
    void pass(Time length);
    LineStall begin_stall();
    void end_stall(const LineStall& stall);

    SimulatedLine& line_;
    const Setting setting_;
    Open open_;
    Instant now_;
    StallJudge judge_;
    std::function<void()> act_;
    Thread bus_, main_;
    std::optional<LineStall> line_stall_;
    std::optional<Time> open_stall_;
    unsigned times_closed_ = 0;
    bool leaves_ = false;

    app::ProgramSigns signs_;
    Handover<app::BusStations> next_;
    fdl::Layer2 layer2_{fdl::Layer2Settings{}};
    app::DriveLine drive_line_;
    std::vector<app::DriveUnit> units_;
    std::vector<std::shared_ptr<app::BusStation>> stations_;
    std::vector<std::unique_ptr<Plc>> plcs_;
    std::vector<std::optional<Demanded>> demanded_;
    std::vector<drive::DriveSnapshot> views_;
    std::vector<bool> view_is_old_;
    std::optional<app::StationSet> set_;
    std::vector<std::uint32_t> waiting_; ///< orders without an answer
    std::uint32_t orders_ = 0;
    std::stop_source stop_;
    io::EventFd wake_;
};

} // namespace dpslave::stalls
