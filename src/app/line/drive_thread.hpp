// SPDX-License-Identifier: Apache-2.0
/// The loop of one drive line: fetches what the master wants, lets the poller choose, carries out one
/// transaction after the other on the back-end, and publishes what came back. It may block, at most one
/// response timeout per exchange; a refused write reads EE as well (backend.hpp).
#pragma once

#include "app/links/links.hpp"
#include "app/log/limited_log.hpp"
#include "line_orders.hpp"
#include "line_port.hpp"
#include "line_unit.hpp"
#include "other_threads.hpp"
#include "trouble_log.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace dpslave::app {

class DriveThread final : private io::SignListener {
public:
    /// How long the safe state of drives that leave is tried.
    static constexpr std::chrono::seconds kSafeStateLimit{2};
    /// Any drive answers within this time. What is longer is not waited for when the outputs are to go to
    /// their safe state.
    static constexpr std::chrono::milliseconds kLastAnswer{500};

    /// Opens nothing: run() does. `port_is_held`: LineChange::is_held. More and other drives come through
    /// LineLink::change.
    DriveThread(config::LineConfig line, bool port_is_held, const std::vector<DriveUnit>& units,
                LineLink& link, const ProgramSigns& signs);

    /// Serves the drives until `stop`; then the outputs go to their safe state, until LineLink::ends_by, and
    /// the port is closed.
    void run(const std::stop_token& stop, io::EventFd& wake);

private:
    static constexpr std::chrono::milliseconds kTickWithLayout{
        2}; ///< how soon an order of the master is noticed
    static constexpr std::chrono::milliseconds kTickIdle{20};
    static constexpr std::chrono::milliseconds kTickLost{100}; ///< no order can reach a drive of the line
    static_assert(LinePort::kPatience > kSafeStateLimit, "a line that leaves a port writes there first");

    void fetch();
    void carry_out(const drive::Transaction& transaction);
    drive::Outcome exchange_with(const LineUnit& unit, const drive::Transaction& transaction);
    void publish();
    void note_heard();
    void on_sign(Instant now) override;
    void recover();
    void note_stalls();
    void lose_master();
    void probe(const ProbeOrder& order, const std::stop_token& stop);
    void rest(int wake, std::chrono::nanoseconds wait);
    std::chrono::nanoseconds rest_time(Instant now) const;
    void write_safe_state();
    bool is_pending(std::size_t unit) const;
    std::string not_written(std::size_t unit) const;

    void take_change();
    bool leaving_is_over() const;
    void apply_change();

    config::LineConfig line_;
    LineLink& link_;
    const ProgramSigns& signs_;
    OtherThreads others_;
    bool master_is_lost_ = false; ///< one of `others_` has stalled, and nothing was done about it yet
    LinePort port_;
    std::vector<LineUnit> units_;
    drive::Poller poller_;
    LineOrders orders_;
    std::unique_ptr<LineChange> next_; ///< applied when the drives that leave are in their safe state
    Instant leave_until_{};
    TroubleLog troubles_;
    std::vector<std::uint16_t> words_;
    std::string survey_trouble_; ///< of the survey read under way
};

} // namespace dpslave::app
