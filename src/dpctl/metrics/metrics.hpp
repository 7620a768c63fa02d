// SPDX-License-Identifier: Apache-2.0
/// The figures of the daemon for Prometheus. Pure: replies in, text out. docs/guide/metrics.md lists them.
#pragma once

#include "dpslave/report/replies.hpp"

#include <string>

namespace dpslave::dpctl {

/// What the daemon replied, unchanged: its texts may have any characters.
struct Figures {
    report::GetVersionReply version;
    report::GetStatusReply status;
    report::GetCountersReply counters;
};

/// In the text format 0.0.4. `socket`: where they come from.
std::string render_metrics(const Figures& figures, const std::string& socket);
/// The same of a daemon that does not answer: only dpslaved_up, which is 0.
std::string render_metrics_of_none(const std::string& socket);

} // namespace dpslave::dpctl
