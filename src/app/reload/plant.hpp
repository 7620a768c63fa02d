// SPDX-License-Identifier: Apache-2.0
/// The stations and the drive lines that a configuration asks for: their links, ports and threads, and how
/// they are exchanged for those of another configuration while the others go on. The main thread's own.
#pragma once

#include "app/bus/bus_station.hpp"
#include "app/line/drive_line.hpp"
#include "app/state/station.hpp"
#include "reload_plan.hpp"

#include "dpslave/config/config.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dpslave::app {

class Plant {
public:
    /// `bus` outlives this object: BusLink::failed is set when a thread had to end early. After a failed
    /// self-test every station stays silent.
    Plant(BusLink& bus, bool self_test_passed) : bus_(bus), self_test_passed_(self_test_passed) {}

    /// Makes the lines and the stations, before there are any. Opens nothing.
    void open(const config::Config& config);
    /// Starts the threads of the lines, each of which opens its port.
    void start();
    /// They are to end: the outputs go to their safe state, on all lines at the same time, until `ends_by`.
    void request_end(Instant ends_by);
    /// After request_end(): waits for them, until `limit` at most. The result: those that hang.
    std::vector<const DriveLine*> end(Instant limit);

    /// In the order of the configuration. The main thread keeps in them what it knows.
    std::vector<Station>& stations() { return stations_; }
    const std::vector<Station>& stations() const { return stations_; }
    /// Stations and lines that bus and drives are not yet done with, also those of former reloads: a line
    /// that stalls keeps them. take_leaving() is due when one_has_left(), and returns stations that have.
    const std::vector<Station>& leaving() const { return leaving_stations_; }
    const DriveLines& leaving_lines() const { return leaving_lines_; }
    bool one_has_left() const;
    std::vector<Station> take_leaving();
    const DriveLines& lines() const { return lines_; }
    /// For the bus: those that are there now.
    std::unique_ptr<BusStations> bus_stations() const;

    /// Makes what `plan` asks for and takes over what stays: stations() and lines() are the new ones, and
    /// finish() is due when the bus has removed the stations that left. A line that has not taken its change
    /// of before gets both in one.
    void exchange(const Plan& plan);
    /// A sentence for each port of `plan` that cannot be opened; but for those that the present lines have.
    /// `troubles`: io::port_trouble() of each line of the plan.
    std::vector<std::string> missing_ports(const Plan& plan,
                                           const std::vector<std::optional<std::string>>& troubles) const;
    /// The bus has removed the stations that left: the lines write the safe state of drives that left, then
    /// they ask the new drives. Does not wait: call it again until have_taken().
    void finish();
    /// True: every line has taken its change, but for those that stall.
    bool have_taken(Instant now) const;
    /// True: every line has carried out its change, and the threads of lines that left have ended, but for
    /// those that stall.
    bool is_settled(Instant now) const;
    /// A sentence for each line that has not taken what it is to do, or that stalls before it is done.
    std::vector<std::string> late(Instant now) const;

private:
    struct Change {
        std::shared_ptr<DriveLine> line;
        std::unique_ptr<LineChange> change;
    };
    struct Next;

    Station new_station(const config::StationConfig& config, const std::shared_ptr<DriveLine>& line);
    bool has_port(const std::string& port, const RealPaths& real) const;
    bool has_gpio_line(const config::LineConfig& wanted, const RealPaths& real) const;
    bool is_held(const config::LineConfig& wanted, const RealPaths& real) const;
    void make_lines(const Plan& plan, Next& next) const;
    void make_stations(const Plan& plan, Next& next);
    void plan_port(const Plan& plan, std::size_t index, LineChange& change) const;
    void make_changes(const Plan& plan, Next& next) const;
    void commit(const Plan& plan, Next next);
    void start(DriveLine& line);
    bool has_taken(const DriveLine& line) const;
    bool is_done(const DriveLine& line) const;
    bool has_left(const Station& station) const;

    BusLink& bus_;
    bool self_test_passed_;
    DriveLines lines_;
    std::vector<Station> stations_;
    std::vector<Station> leaving_stations_;
    DriveLines leaving_lines_;
    std::vector<Change> changes_; ///< to be offered by finish()
    std::uint32_t last_number_ = 0;
};

/// "FILE:LINE: ", where the key stands that named a device.
std::string place(const config::Config& config, unsigned line);

/// Runs `work` under the thread name `name`. An exception is logged and sets `failed`: the program then ends
/// in order.
void guarded(std::atomic<bool>& failed, const char* name, const std::function<void()>& work);

} // namespace dpslave::app
