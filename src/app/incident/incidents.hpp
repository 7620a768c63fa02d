// SPDX-License-Identifier: Apache-2.0
/// The flight recorder: notices incidents, has what surrounds them written from the rings of the trace into
/// files, and answers ListIncidents and GetIncident. Main thread only; the files are read and written by a
/// SideJob.
#pragma once

#include "app/job/side_job.hpp"
#include "app/line/drive_line.hpp"
#include "app/state/happenings.hpp"
#include "app/state/monitor.hpp"
#include "book.hpp"
#include "burst.hpp"
#include "folder.hpp"

#include "dpslave/trace/ring.hpp"

#include <array>
#include <deque>
#include <filesystem>
#include <map>

namespace dpslave::app {

class Incidents {
public:
    /// `state`: the folder for what outlives the program; empty: there is none, so nothing is kept. All
    /// outlive this object.
    Incidents(const Monitor& monitor, const BusLink& bus, const DriveLines& lines,
              const std::filesystem::path& state);

    /// Keeps what surrounds it, if it is an incident.
    void on_happening(const Happening& happening, Instant now);
    /// Looks for incidents that no happening tells, and takes the files further.
    void on_time(Instant now);

    control::Reply list() const;
    control::Reply piece(const control::Json& parameters, const control::Caller& caller);
    /// A caller waits for a file: on_time() is to be called soon.
    bool is_waited_for() const { return !asked_.empty(); }

    /// The last counts are written. False: the disk hangs, and this object cannot be destroyed.
    bool end(std::chrono::milliseconds limit);

private:
    /// An incident that was noticed, with all that its head needs.
    struct Noticed {
        IncidentKey key;
        std::string text;
        Instant now{};
        std::int64_t unix_ns = 0;
        std::optional<report::IncidentStation> station;
    };
    /// A file that is to be written.
    struct Writing {
        report::IncidentHead head;
        bool is_complete = false; ///< else the time behind the incident is not over yet
    };
    struct Asked {
        control::ReplyTo to{};
        std::uint64_t number = 0, offset = 0;
        Instant due{}; ///< the call ends then
    };
    /// The state of a station as the events say, and the parameters of the exchange that it is or was in.
    struct Exchange {
        dp::State state = dp::State::power_on;
        Instant since{};
        std::string set_prm{}, chk_cfg{}; ///< hexadecimal; empty: not known for certain
    };
    void on_bus_event(const Station& station, const dp::Event& event, const std::string& text, Instant now);
    void happened(IncidentKind kind, std::optional<report::IncidentStation> station, std::string reason,
                  std::string text, Instant now);
    void note(const Noticed& noticed);
    void look_at_exchanges(Instant now);
    void look_at_flaws(Instant now);
    void look_at_answers(Instant now);
    bool start_next(Instant now);
    bool start_search();
    bool start_writing();
    bool start_removing();
    bool start_reading();
    bool start_counts(Instant now);
    void end_late_reads(Instant now);
    bool is_written(const std::optional<std::string>& failure);
    report::IncidentCounts counts() const;

    const Monitor& monitor_;
    const BusLink& bus_;
    const DriveLines& lines_;
    std::filesystem::path folder_;
    std::string off_because_; ///< a sentence; empty: incidents are kept

    IncidentBook book_;
    bool is_searched_ = false;                 ///< the folder
    std::vector<Noticed> early_;               ///< before it was
    std::optional<report::IncidentHead> head_; ///< of the open one
    std::deque<Writing> to_write_;
    std::vector<std::uint64_t> to_remove_;
    std::deque<Asked> asked_;
    std::deque<Asked> unanswered_; ///< in the order of `due`; some of them have their reply
    bool counts_wait_ = false;
    Instant next_counts_{};
    std::uint64_t failures_ = 0;         ///< files that could not be written
    std::optional<std::string> trouble_; ///< of the last one, until one is written

    std::map<std::uint32_t, Exchange> exchanges_;        ///< by the number of the station
    std::map<std::uint32_t, drive::AnswerCounts> heard_; ///< likewise: of the drive
    Burst flaws_;
    std::array<std::uint64_t, fdl::kFlaws> flaws_before_{};
    SideJob job_{"disk", "work on files of incidents"}; ///< last: it ends first
};

} // namespace dpslave::app
