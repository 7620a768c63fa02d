// SPDX-License-Identifier: Apache-2.0
/// What the command line says, and the functions that do it. Each returns the exit code.
#pragma once

#include "terminal.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::dpctl {

struct Options {
    std::string socket = "/run/dpslaved/control.sock";
    double timeout_s = 5;
    bool json = false;
    std::string station;            ///< name or address; empty = not said
    bool station_is_option = false; ///< the command takes --station, else it is a word of its own
    int tag = 0;
    std::string every;     ///< `read` and `top`: as parse_interval() reads it; empty = once
    bool list = false;     ///< `read`: the names of the tags
    std::string parameter; ///< of the TEC OPTION function block
    std::string value;
    bool dry_run = false; ///< `reload`
    bool all = false;     ///< `tag`: also names that say more than the query; `doctor`: every rule

    // Of status and io.
    bool follow = false;          ///< go on, show each change
    std::optional<double> wait_s; ///< status: wait at most so long for the exchange
    bool with_drive = false;      ///< status, with wait_s: the drive must answer, too
    bool quiet = false;           ///< status, with wait_s: the exit code says it

    std::string level; ///< `log-level`; empty = which one is it

    // Of survey; `table` below is the file that it writes.
    std::string tags;         ///< as parse_tag_spans() reads them; empty = all
    std::string duration;     ///< as parse_duration() reads it; empty = not said
    std::uint32_t passes = 1; ///< how often each tag is asked
    bool resume = false;      ///< goes on with the record that is there

    // Of trace.
    std::string file;          ///< a capture that is written; empty = text
    std::string link_type;     ///< of it: "profibus" or "user0"
    std::string service;       ///< a part of its name; empty = all
    bool bad = false;          ///< only what is no telegram or was not answered
    bool incidents = false;    ///< the list of them
    std::int64_t incident = 0; ///< in place of the ring the file of this one; 0 = not said
    bool decode = false;       ///< what each telegram says beneath it
    std::string gsd_folder;    ///< with `decode`: GSD files of other devices; empty = none
    std::string stop_on;       ///< as read_condition() reads it; empty = no condition
    std::string drive;         ///< a drive line in place of the bus; empty = not said

    bool csv = false; ///< `plot`: a table

    // Of the subcommands that need no daemon.
    std::vector<std::string> words; ///< query, numbers or octets; `read`: tags
    std::string profiles =
        DPSLAVE_DATA_FOLDER "/profiles"; ///< the tag tables lie in ../tags (given by CMake)
    std::string profile;                 ///< empty = not said
    std::string table;                   ///< a CSV file; empty = not said
    std::string form;                    ///< `decode --as`: prm, cfg or diag; empty = found out
    bool yes = false;                    ///< `tec set`: also what silences a station in exchange
    bool probe = false;                  ///< `doctor`: looks for the drive
    std::string port;                    ///< `tune`: a tty; empty = the daemon's
    std::string output;                  ///< `metrics --write`, `plot --svg`: a file; empty = standard output

    std::chrono::milliseconds timeout() const
    {
        return std::chrono::milliseconds{static_cast<std::chrono::milliseconds::rep>(timeout_s * 1000)};
    }
};

/// What the command line chose.
using Action = std::function<int(const Options&, Terminal&)>;

// look.cpp
int do_status(const Options&, Terminal&);
int do_io(const Options&, Terminal&);
int do_diag(const Options&, Terminal&);
int do_counters(const Options&, Terminal&);
int do_bus(const Options&, Terminal&);
int do_version(const Options&, Terminal&);

// show.cpp
int do_show(const Options&, Terminal&);

// follow.cpp: status and io with --follow
int follow_status(const Options&, Terminal&);
int follow_io(const Options&, Terminal&);

// trace.cpp
int do_trace(const Options&, Terminal&);

// status.cpp: status with --wait
int wait_for_exchange(const Options&, Terminal&);

// read.cpp
int do_read(const Options&, Terminal&);

// log_level.cpp
int do_log_level(const Options&, Terminal&);

// operate.cpp
int do_write(const Options&, Terminal&);
int do_tec_set(const Options&, Terminal&);
int do_reload(const Options&, Terminal&);

// top.cpp
int do_top(const Options&, Terminal&);

// events.cpp
int do_events(const Options&, Terminal&);

// plot.cpp
int do_plot(const Options&, Terminal&);

// metrics.cpp
int do_metrics(const Options&, Terminal&);

// survey.cpp
int do_survey(const Options&, Terminal&);

// doctor.cpp
int do_doctor(const Options&, Terminal&);

// tune.cpp: with a daemon or without
int do_tune(const Options&, Terminal&);

// tag.cpp, hex.cpp, decode.cpp: without a daemon
int do_tag(const Options&, Terminal&);
int do_hex(const Options&, Terminal&);
int do_decode(const Options&, Terminal&);

} // namespace dpslave::dpctl
