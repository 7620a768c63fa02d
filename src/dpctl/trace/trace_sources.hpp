// SPDX-License-Identifier: Apache-2.0
/// What `dpctl trace --decode` knows before the first telegram: the stations of the daemon, and GSD files.
#pragma once

#include "dpctl/cli/session.hpp"
#include "trace_decode.hpp"
#include "trace_options.hpp"

#include "dpslave/base/result.hpp"

#include <bitset>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// A station of the daemon.
struct TraceStation {
    std::uint8_t address = 0;
    profile::Profile device; ///< with the tag table, the ident and the resolution of the station
    std::vector<std::uint8_t> last_prm, last_cfg; ///< those in force; empty: none
};

struct TraceSources {
    std::vector<TraceStation> stations;
    TraceDecoder decoder; ///< with the devices and the texts, without layouts
};

/// Asks the daemon and reads the files of --gsd. A station whose files cannot be read is decoded without
/// names, which is printed. The failure is an exit code; why is printed.
Result<TraceSources, int> trace_sources(const TraceOptions& options, Session& session);

/// Of a capture, without a daemon: the files of --gsd; and the device of --profile for the slaves with its
/// ident
/// (`idents`, by address), with those that are open for each.
Result<TraceSources, int> sources_of_capture(const TraceOptions& options,
                                             const std::map<std::uint8_t, std::uint16_t>& idents,
                                             Terminal& terminal);

/// Gives `sources.decoder` the layouts in force, but not those of the slaves in `changed`: an older telegram
/// of them may have had another layout.
void set_layouts(TraceSources& sources, const std::bitset<128>& changed);

} // namespace dpslave::dpctl
