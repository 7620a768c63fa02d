// SPDX-License-Identifier: Apache-2.0
/// The thread of one drive line: fetches what the master wants, lets the poller choose, carries out one
/// transaction after the other on the back-end, and hands on what came back. It may block, at most one
/// response time-out per exchange; a refused write reads EE as well (backend.hpp).
#pragma once

#include "dpslave/app/config.hpp"
#include "dpslave/app/links.hpp"
#include "dpslave/drive/backend.hpp"
#include "dpslave/drive/poller.hpp"
#include "dpslave/io/event_fd.hpp"

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace dpslave::app {

class DriveThread {
public:
    /// `line`: index into config.lines. `stations`: all links, in the order of config.stations; this thread
    /// uses those on its line.
    DriveThread(const Config& config, std::size_t line, std::unique_ptr<drive::Backend> backend,
                std::vector<std::unique_ptr<StationLink>>& stations, LineLink& link);

    /// Serves the drives until `stop`; then the outputs go to their safe state, for kFarewell at most.
    void run(std::stop_token stop, io::EventFd& wake);

private:
    static constexpr std::chrono::milliseconds kTickWithLayout{
        2}; ///< how soon an order of the master is noticed
    static constexpr std::chrono::milliseconds kTickIdle{20};
    static constexpr std::chrono::seconds kFarewell{2};

    struct Unit {
        const StationConfig* config = nullptr;
        std::uint32_t station = 0; ///< index in config.stations
        StationLink* link = nullptr;
        std::int64_t zero_after_ms = 0; ///< as said to the poller last
        Generation ended = 0;           ///< as said to the poller last
        bool has_layout = false;
        bool was_known = false, answered = false; ///< as said in the log last
    };

    void fetch();
    void carry_out(const drive::Transaction& transaction);
    void publish();
    void say_link_changes();
    void remember_trouble(const Unit& unit, const drive::Transaction& access, const std::string& text);
    void forget_trouble(const Unit& unit, const drive::Transaction& access);
    void rest(int wake, Instant now) const;
    void farewell();

    std::vector<Unit> units_;
    std::unique_ptr<drive::Backend> backend_;
    drive::Poller poller_;
    LineLink& link_;
    TroubleList troubles_;
    std::vector<std::uint16_t> words_;
};

} // namespace dpslave::app
