// SPDX-License-Identifier: Apache-2.0
/// The thread of one drive line: fetches what the master wants, lets the poller choose, carries out one
/// transaction after the other on the back-end, and hands on what came back. It may block, at most one
/// response time-out per exchange; a refused write reads EE as well (backend.hpp).
#pragma once

#include "app/limited_log.hpp"
#include "app/links.hpp"
#include "line_backend.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/io/event_fd.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace dpslave::app {

class DriveThread {
public:
    /// `backend`: as LineWork has it. More and other drives come through LineLink::work.
    DriveThread(config::LineConfig line, std::unique_ptr<LineBackend> backend,
                const std::vector<DriveUnit>& units, LineLink& link);

    /// Serves the drives until `stop`; then the outputs go to their safe state, for kFarewell at most.
    void run(std::stop_token stop, io::EventFd& wake);

private:
    static constexpr std::chrono::milliseconds kTickWithLayout{
        2}; ///< how soon an order of the master is noticed
    static constexpr std::chrono::milliseconds kTickIdle{20};
    static constexpr std::chrono::seconds kFarewell{2};
    static constexpr std::chrono::seconds kOpenAgainAfter{1};
    /// A port that another line of ours is about to let go of: that one may leave its drives first.
    static constexpr std::chrono::milliseconds kPortPatience{kFarewell + std::chrono::seconds{1}};

    struct Unit {
        explicit Unit(const DriveUnit& made_of);
        std::uint32_t number = 0;
        std::shared_ptr<const config::StationConfig> config;
        std::shared_ptr<StationLink> link;
        std::int64_t zero_after_ms = 0;           ///< as said to the poller last
        Generation ended = 0;                     ///< as said to the poller last
        Generation layout = 0;                    ///< whose outputs the poller has; 0 = none
        bool was_known = false, answered = false; ///< as said in the log last
        std::optional<Instant> ride_ends;         ///< as said in the log last
        Generation ride_layout = 0;               ///< whose outputs stand in a ride
        bool leaves = false;                      ///< it is not among the drives that come next
    };

    void fetch();
    void fetch_orders();
    void operate(LineOrder order);
    void carry_out(const drive::Transaction& transaction);
    drive::Outcome exchange_with(const Unit& unit, const drive::Transaction& transaction);
    void publish();
    void say_link_changes();
    void say_ride(std::size_t index);
    void remember_trouble(const Unit& unit, const drive::Transaction& access, AccessError cause,
                          const std::string& text);
    void forget_trouble(const Unit& unit, const drive::Transaction& access);
    void probe_line(const ProbeOrder& order, const std::stop_token& stop);
    void rest(int wake, std::chrono::nanoseconds wait);
    std::chrono::nanoseconds rest_time(Instant now) const;
    void farewell();

    void take_work();
    bool leaving_is_over() const;
    void take_over();
    void forget_troubles_of_the_gone();
    void forget_troubles_of_other_rows(const Unit& unit, const config::StationConfig& now);
    template <class IsOver>
    void forget_troubles_where(IsOver is_over);
    void take_port();
    bool is_open();
    bool waits_for_port(Instant now) const { return !backend_ && now < port_comes_until_; }

    config::LineConfig line_;
    std::unique_ptr<LineBackend> backend_; ///< null: the port could not be opened yet
    Instant next_open_{};
    Instant port_comes_until_{}; ///< until then another line of ours may still have it: nothing is asked
    bool open_failure_said_ = false;
    std::vector<Unit> units_;
    drive::Poller poller_;
    LineLink& link_;
    std::unique_ptr<LineWork> next_; ///< to be taken over when those who leave have said their last word
    Instant leave_until_{};
    std::vector<LineOrder> early_orders_; ///< for drives that are among the next ones
    TroubleList troubles_;
    LimitedLog log_;
    std::vector<std::uint16_t> words_;
    std::string trouble_; ///< of the survey read under way
};

} // namespace dpslave::app
