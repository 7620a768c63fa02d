// SPDX-License-Identifier: Apache-2.0
/// The port of a drive line from start to end: opened, exchanged for another, closed for a probe. The drive
/// thread's own: no other thread waits for what may stall here.
#pragma once

#include "app/links/links.hpp"
#include "line_backend.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <vector>

namespace dpslave::app {

class LinePort {
public:
    /// How long a port is waited for that another line still has: that one may leave its drives first.
    static constexpr std::chrono::seconds kPatience{3};

    /// Opens nothing yet. `is_held`: as LineChange has it. `listeners`: of LineBackend::open(); they outlive
    /// the object.
    LinePort(bool is_held, const LineBackend::Listeners& listeners);

    /// The drives from now on.
    void set_units(std::vector<DriveUnit> units);
    LineBackend* backend() { return backend_.get(); } ///< null: the port is not open yet
    /// True: there is a back-end. Tries to open the port when the time for that has come.
    bool open(const config::LineConfig& line);
    /// Looks whether another program has changed settings of the port: they are set again, and that is told.
    /// False: what was read since the last call may be other octets than those that came, or there is no
    /// back-end any more.
    /// Precondition: backend().
    bool settings_hold(const config::LineConfig& line);
    /// Another line may still have the port: nothing is asked, and no failure is told.
    bool is_awaited(Instant now) const { return !backend_ && now < awaited_until_; }
    /// The next one is the new port, or the old one set in another way.
    void exchange(bool is_held);
    /// Until the next open().
    void close();
    /// The same of a port that was told to be of no use: the next open() is told.
    void give_up();

private:
    static constexpr std::chrono::seconds kOpenAgainAfter{1};

    void begin(bool is_held);
    void log_driver(const config::LineConfig& line) const;

    std::unique_ptr<LineBackend> backend_;
    LineBackend::Listeners listeners_;
    std::vector<DriveUnit> units_;
    Instant next_open_{};
    Instant awaited_until_{};
    bool failure_told_ = false;
};

} // namespace dpslave::app
