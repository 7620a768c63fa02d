// SPDX-License-Identifier: Apache-2.0
#include "dpctl/metrics/metrics.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/whole_file.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

#include "dpslave/base/printable.hpp"

namespace dpslave::dpctl {
namespace {

struct MetricsOptions {
    std::string output; ///< a file; empty = standard output
};

void set_up(CLI::App& app, MetricsOptions& options)
{
    add_output(
        app, options.output,
        "Write to FILE, which is replaced in one step. If no daemon answers, FILE has only dpslaved_up 0");
}

/// The replies of the three methods by their keys, unchanged; or why there are none.
Result<Json, Stopped> figures_of(Session& session)
{
    Json all = Json::object();
    for (const auto& [key, method] :
         {std::pair{"version", "GetVersion"}, {"status", "GetStatus"}, {"counters", "GetCounters"}}) {
        auto reply = session.call(method);
        if (!reply) return Failure{reply.error()};
        all[key] = *std::move(reply);
    }
    return all;
}

/// Prints `text`, or writes it where --output says.
int put_metrics(const std::string& text, const MetricsOptions& options, Terminal& terminal)
{
    if (options.output.empty()) {
        terminal.out << text << std::flush;
        return kFine;
    }
    const auto failed = write_file(options.output, text, true);
    if (!failed) return kFine;
    terminal.err << "dpctl: " << printable(options.output) << ": " << failed->why << '\n';
    return kNo;
}

/// A file is written without a daemon too: the figures of before would go on as if they were those of now.
int run(const MetricsOptions& options, Session& session)
{
    Terminal& terminal = session.terminal();
    const auto json = figures_of(session);
    if (!json) {
        const int code = session.print_stopped(json.error());
        if (!options.output.empty() && !session.json())
            put_metrics(render_metrics_of_none(session.socket()), options, terminal);
        return code;
    }
    if (session.json() && options.output.empty()) {
        session.print(*json, {});
        return kFine;
    }
    if (session.json()) return put_metrics(json_text(*json) + '\n', options, terminal);
    const Figures figures{report::read<report::GetVersionReply>((*json)["version"]),
                          report::read<report::GetStatusReply>((*json)["status"]),
                          report::read<report::GetCountersReply>((*json)["counters"])};
    return put_metrics(render_metrics(figures, session.socket()), options, terminal);
}

} // namespace

const Command kMetrics{"metrics",
                       kWatch,
                       "Prints the figures for Prometheus, in its text format",
                       add<MetricsOptions>,
                       kOwnForm,
                       "dpctl metrics | promtool check metrics\n"
                       "dpctl metrics --output /var/lib/prometheus/node-exporter/dpslaved.prom",
                       "1 also if the file cannot be written"};

} // namespace dpslave::dpctl
