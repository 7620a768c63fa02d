// SPDX-License-Identifier: Apache-2.0
/// What the command line says, and the functions that do it. Each returns the exit code.
#pragma once

#include "terminal.hpp"

#include <chrono>
#include <string>

namespace dpslave::dpctl {

struct Options {
    std::string socket = "/run/dpslaved/control.sock";
    double timeout_s = 5;
    bool json = false;
    std::string station; ///< name or address; empty = not said
    int tag = 0;
    std::string value;

    std::chrono::milliseconds timeout() const
    {
        return std::chrono::milliseconds{static_cast<std::chrono::milliseconds::rep>(timeout_s * 1000)};
    }
};

// look.cpp
int do_status(const Options&, Terminal&);
int do_stations(const Options&, Terminal&);
int do_info(const Options&, Terminal&);
int do_io(const Options&, Terminal&);
int do_diag(const Options&, Terminal&);
int do_counters(const Options&, Terminal&);
int do_leds(const Options&, Terminal&);
int do_version(const Options&, Terminal&);
int do_is_exchanging(const Options&, Terminal&);

// operate.cpp
int do_read(const Options&, Terminal&);
int do_write(const Options&, Terminal&);

// watch.cpp
int do_watch(const Options&, Terminal&);

} // namespace dpslave::dpctl
