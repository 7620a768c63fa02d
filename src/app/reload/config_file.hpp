// SPDX-License-Identifier: Apache-2.0
/// The configuration file on the disk, and what else of the disk and the name service the main thread needs:
/// all of it is asked beside the main thread, one piece at a time. No call of the control interface has the
/// file read but Reload. Main thread only.
#pragma once

#include "app/job/side_job.hpp"
#include "real_paths.hpp"

#include "dpslave/app/service.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/config/config.hpp"
#include "dpslave/io/tty.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::app {

/// What was read, and what the system says of it.
struct ReadConfig {
    Result<config::Config, input::Faults> config;
    std::optional<gid_t> group{};                    ///< of the operators; nothing: the system has none
    std::vector<std::optional<std::string>> ports{}; ///< of each line: io::port_trouble()
    RealPaths real_paths{};                          ///< of the lines, of now and from now on
};

/// What may block. Called on a thread of its own.
struct ConfigSources {
    std::function<decltype(config::load_config)> load = config::load_config;
    std::function<decltype(config::operator_group_of)> group = config::operator_group_of;
    std::function<decltype(io::port_trouble)> port_trouble = io::port_trouble;
    std::function<decltype(config::canonical)> canonical = config::canonical;
};

class ConfigFile {
public:
    using Group = std::function<void(std::optional<gid_t>)>;

    /// `present`: what was read from it at the start, before `now`.
    ConfigFile(const config::Config& present, std::filesystem::path profiles, Instant now,
               std::shared_ptr<const ConfigSources> sources = std::make_shared<const ConfigSources>());
    ~ConfigFile(); ///< what hangs is left to the end of the process

    const std::filesystem::path& path() const { return file_; }
    /// Has the whole of it read and judged, and calls `then` when that is over. One reading at a time: a
    /// further one takes the place of the one before, whose `then` is not called. `present`: the lines that
    /// it will be compared with.
    void read(std::vector<config::LineConfig> present, std::function<void(ReadConfig&)> then);
    /// The result of read() is thrown away whenever it comes.
    void forget();
    /// Has the group of the operators looked up, and calls `then`.
    void find_group(const config::ControlConfig& control, Group then);
    /// Has other work done that may block; it owns all that it uses. `what`: who has not answered if it
    /// hangs, "the disk with FILE".
    void add(std::string what, SideJob::Work work);
    /// Has the driver enables that are in use written down (keep() of dpslave/app/service.hpp).
    void keep(std::vector<DriverInUse> drivers);

    /// Calls what waits for an answer that has come, and begins what is next: else a look whether the file
    /// has changed, once a second at most.
    void on_time(Instant now);
    /// Who has not answered yet: "the name service", "the disk with FILE".
    const std::string& waits_for() const { return running_; }
    /// What was added is done, and no reading any more; waits for that until `limit` is over. False: it
    /// hangs.
    bool settle(std::chrono::milliseconds limit);

    /// The address of a station in it, as of the last reading: what a restart would bring. Nothing:
    /// it has no such station, or it has faults.
    std::optional<std::uint8_t> address_of(const std::string& station) const;

private:
    struct Piece {
        std::string what;
        SideJob::Work work;
        unsigned reading = 0; ///< the number of the reading that it is of; 0: of none
    };

    void note(const Result<config::Config, input::Faults>& read);
    bool start_next();
    void look();
    void begin(std::string what, SideJob::Work work);
    void go_on(unsigned reading, const std::shared_ptr<ReadConfig>& read);
    void look_at_ports(unsigned reading, const std::shared_ptr<ReadConfig>& read);

    std::filesystem::path file_, profiles_;
    std::shared_ptr<const ConfigSources> sources_;
    Instant next_look_;
    std::filesystem::file_time_type written_{}; ///< when it was read by a look; the first look reads it
    std::map<std::string, std::uint8_t, std::less<>> addresses_;
    unsigned reading_ = 0;                    ///< the newest
    std::function<void(ReadConfig&)> then_;   ///< of that one
    std::vector<config::LineConfig> present_; ///< of that one
    std::vector<Piece> waiting_;
    std::string running_; ///< Piece::what
    SideJob job_{"config", "the configuration file"};
};

} // namespace dpslave::app
