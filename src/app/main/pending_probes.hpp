// SPDX-License-Identifier: Apache-2.0
/// The method ProbeDrive: a line looks for a drive with other rates, formats and units. Main thread only.
#pragma once

#include "monitor.hpp"
#include "replies.hpp"

#include <map>

namespace dpslave::app {

class PendingProbes {
public:
    /// All outlive this object.
    PendingProbes(const Monitor& monitor, const Runtime& runtime, Replies& replies)
        : monitor_(monitor), runtime_(runtime), replies_(replies)
    {}

    /// A call with "more" gets the progress; the probe ends with its stream.
    control::Reply start(const Station& station, const control::Json& parameters,
                         const control::Caller& caller);
    /// Sends progress and results, and ends the probes whose stream has ended.
    void answer();

private:
    struct Probe {
        std::shared_ptr<const config::StationConfig> config;
        std::string line, port;
        ProbeLength length;
        std::optional<std::uint64_t> stream; ///< none: the result is the only reply
        std::uint32_t sent = 0;              ///< questions, as sent to the stream last
    };

    static report::ProbeDriveReply progress(const Probe& probe, std::uint32_t tried);
    void answer(const DriveLine& line, const ProbeReport& report);

    const Monitor& monitor_;
    const Runtime& runtime_;
    Replies& replies_;
    std::map<std::uint32_t, Probe> pending_; ///< by the number of the order
};

} // namespace dpslave::app
