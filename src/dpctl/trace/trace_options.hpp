// SPDX-License-Identifier: Apache-2.0
/// What the command line of `dpctl trace` says.
#pragma once

#include "dpctl/cli/profiles_option.hpp"

#include <cstdint>
#include <string>

namespace dpslave::dpctl {

struct TraceOptions : ProfilesOption {
    bool follow = false;
    bool incidents = false;    ///< the list of them
    std::int64_t incident = 0; ///< in place of the ring the file of this one; 0 = not said
    std::string read;          ///< a capture that is read in place of the daemon; empty = not said
    std::string station;       ///< name or address; empty = all
    std::string service;       ///< a part of its name; empty = all
    bool bad = false;          ///< only what is no telegram or was not answered
    std::string stop_on;       ///< as read_condition() reads it; empty = no condition
    std::string file;          ///< a capture that is written; empty = text
    std::string link_type;     ///< of it: "profibus" or "user0"
    bool decode = false;       ///< what each telegram says beneath it
    std::string line;          ///< a drive line in place of the bus; empty = not said
    std::string gsd_folder;    ///< with `decode`: GSD files of other devices; empty = none
    std::string profile;       ///< with `read`; empty = not said
};

} // namespace dpslave::dpctl
