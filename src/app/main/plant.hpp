// SPDX-License-Identifier: Apache-2.0
/// The stations and the drive lines that a configuration asks for: their links, ports and threads, and how
/// they are exchanged for those of another configuration while the others go on. The main thread's own.
#pragma once

#include "app/bus/bus_thread.hpp"
#include "app/drive/drive_thread.hpp"
#include "app/links.hpp"
#include "reload_plan.hpp"

#include "dpslave/config/config.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace dpslave::app {

/// A drive line at work. Ends its thread when it goes.
struct DriveLine {
    explicit DriveLine(config::LineConfig line) : config(std::move(line)) {}
    void tell_to_end();

    config::LineConfig config;
    LineLink link;
    std::unique_ptr<DriveThread> work;
    io::EventFd wake;
    std::uint32_t works_offered = 0;
    std::jthread thread; ///< last: it ends before what it uses goes
};

/// A station at work.
struct Station {
    std::uint32_t number = 0; ///< DriveUnit::number
    std::shared_ptr<const config::StationConfig> config;
    std::shared_ptr<StationLink> link;
    std::shared_ptr<BusStation> bus;
    std::shared_ptr<DriveLine> line;
};

class Plant {
public:
    /// `failed` is set when a thread had to give up; it outlives the plant.
    explicit Plant(std::atomic<bool>& failed) : failed_(failed) {}

    /// Opens the lines and makes the stations, before there are any. Nothing: done; else which port cannot be
    /// opened, a sentence with its place in the file.
    std::optional<std::string> open(const config::Config& config);
    /// Starts the threads of the lines.
    void start();
    /// Ends them: the outputs go to their safe state, on all lines at the same time. The bus has ended
    /// before.
    void end();

    const std::vector<Station>& stations() const { return stations_; }
    const std::vector<std::shared_ptr<DriveLine>>& lines() const { return lines_; }
    /// For the bus: those that are there now.
    std::unique_ptr<BusStations> bus_stations() const;

    /// Makes what `plan` asks for and takes over what stays. Ports that nobody of ours has are opened as a
    /// trial. Nothing: done, stations() and lines() are the new ones, and finish() is to come when the bus
    /// has let go of those that left. Else why not, a sentence with its place in the file, and all is as
    /// before. Precondition: is_settled().
    std::optional<std::string> exchange(const Plan& plan);
    /// Why exchange() would refuse `plan`, as far as the file system tells; its sentence. Opens nothing.
    std::optional<std::string> trouble_of(const Plan& plan) const;
    /// The bus has let go of the stations that left: their drives and lines say farewell, and only then the
    /// new drives are asked. Nobody waits for that.
    void finish();
    /// Everybody has said farewell. Ends the threads of lines that have.
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
    void start(DriveLine& line);

    std::atomic<bool>& failed_;
    std::vector<std::shared_ptr<DriveLine>> lines_;
    std::vector<Station> stations_;
    std::vector<std::shared_ptr<DriveLine>> leaving_;
    std::vector<Work> works_; ///< to be offered by finish()
    std::uint32_t last_number_ = 0;
};

/// "FILE:LINE: ", where the key stands that named a device.
std::string place(const config::Config& config, unsigned line);

/// What a thread does, under its name. A failure of the system sets `failed`, and the program ends in order.
void guarded(std::atomic<bool>& failed, const char* name, const std::function<void()>& work);

} // namespace dpslave::app
