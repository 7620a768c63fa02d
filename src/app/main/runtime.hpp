// SPDX-License-Identifier: Apache-2.0
/// The stations and the drive lines that a configuration asks for: their links, ports and threads, and how
/// they are exchanged for those of another configuration while the others go on. The main thread's own.
#pragma once

#include "app/bus/bus_thread.hpp"
#include "app/drive/drive_thread.hpp"
#include "app/links.hpp"
#include "reload_plan.hpp"
#include "station.hpp"

#include "dpslave/config/config.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace dpslave::app {

/// A drive line and its thread, which ends with it.
struct DriveLine {
    DriveLine(config::LineConfig line, const config::TraceConfig& trace)
        : config(std::move(line)),
          link(std::size_t{trace.drive_kib} * 1024, std::size_t{trace.samples_kib} * 1024)
    {}
    void request_stop();

    config::LineConfig config;
    LineLink link;
    std::unique_ptr<DriveThread> work;
    io::EventFd wake;
    std::uint32_t works_offered = 0;
    std::jthread thread; ///< last: it ends before what it uses is destroyed
};

class Runtime {
public:
    /// `failed` is set when a thread had to end early; it outlives this object. After a failed self-test
    /// every station stays silent.
    Runtime(std::atomic<bool>& failed, bool self_test_passed)
        : failed_(failed), self_test_passed_(self_test_passed)
    {}

    /// Opens the lines and makes the stations, before there are any. Nothing: done; else which port cannot be
    /// opened, a sentence with its place in the file.
    std::optional<std::string> open(const config::Config& config);
    /// Starts the threads of the lines.
    void start();
    /// Ends them: the outputs go to their safe state, on all lines at the same time. The bus has ended
    /// before.
    void end();

    /// In the order of the configuration. The main thread keeps in them what it knows.
    std::vector<Station>& stations() { return stations_; }
    const std::vector<Station>& stations() const { return stations_; }
    /// Stations that bus and drives are not yet done with. They are kept until take_leaving().
    const std::vector<Station>& leaving() const { return leaving_stations_; }
    std::vector<Station> take_leaving() { return std::exchange(leaving_stations_, {}); }
    const std::vector<std::shared_ptr<DriveLine>>& lines() const { return lines_; }
    /// For the bus: those that are there now.
    std::unique_ptr<BusStations> bus_stations() const;

    /// Makes what `plan` asks for and takes over what stays. Ports that none of the present lines has are
    /// opened as a trial. Nothing: done, stations() and lines() are the new ones, and finish() is due when
    /// the bus has removed the stations that left. Else why not, a sentence with its place in the file, and
    /// all is as before. Precondition: is_settled().
    std::optional<std::string> exchange(const Plan& plan);
    /// Why exchange() would refuse `plan`, as far as the file system shows; a sentence. Opens nothing.
    std::optional<std::string> trouble_of(const Plan& plan) const;
    /// The bus has removed the stations that left: the lines write the safe state of drives that left, then
    /// they ask the new drives. Does not wait.
    void finish();
    /// True: every line has done its work, and the threads of lines that left have ended.
    bool is_settled();

private:
    struct Work {
        std::shared_ptr<DriveLine> line;
        std::unique_ptr<LineWork> work;
    };
    struct Next;

    Station new_station(const config::StationConfig& config, const std::shared_ptr<DriveLine>& line);
    bool has_port(const std::string& port) const;
    bool opens_for_a_trial(const Plan& plan, std::size_t line) const;
    std::optional<std::string> make_lines(const Plan& plan, Next& next) const;
    void make_stations(const Plan& plan, Next& next);
    void plan_port(const Plan& plan, std::size_t index, LineWork& work) const;
    void make_works(const Plan& plan, Next& next) const;
    void commit(const Plan& plan, Next next);
    void start(DriveLine& line);

    std::atomic<bool>& failed_;
    bool self_test_passed_;
    std::vector<std::shared_ptr<DriveLine>> lines_;
    std::vector<Station> stations_;
    std::vector<Station> leaving_stations_;
    std::vector<std::shared_ptr<DriveLine>> leaving_lines_;
    std::vector<Work> works_; ///< to be offered by finish()
    std::uint32_t last_number_ = 0;
};

/// "FILE:LINE: ", where the key stands that named a device.
std::string place(const config::Config& config, unsigned line);

/// Runs `work` under the thread name `name`. An exception is logged and sets `failed`: the program then ends
/// in order.
void guarded(std::atomic<bool>& failed, const char* name, const std::function<void()>& work);

} // namespace dpslave::app
