// SPDX-License-Identifier: Apache-2.0
#include "metrics.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/gsd/gsd_files.hpp"

#include "dpslave/base/printable.hpp"

namespace dpslave::dpctl {
namespace {

/// The replies of the three methods by their keys, unchanged, over one connection; or why there are none.
Result<Json, control::ClientError> figures_of(const Options& options)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return Failure{client.error()};
    Json all = Json::object();
    for (const auto& [key, method] :
         {std::pair{"version", "GetVersion"}, {"status", "GetStatus"}, {"counters", "GetCounters"}}) {
        auto reply = client->call(method);
        if (!reply) return Failure{reply.error()};
        if (!reply->error.empty())
            return Failure{control::ClientError{control::ClientError::Kind::nonsense,
                                                "the daemon refused " + std::string{method} + ": " +
                                                    printable(reply->error)}};
        all[key] = std::move(reply->parameters);
    }
    return all;
}

/// Prints `text`, or writes it where --write says.
int put(const std::string& text, const Options& options, Terminal& terminal)
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

} // namespace

/// A file is written without a daemon too: the figures of before would go on as if they were those of now.
int do_metrics(const Options& options, Terminal& terminal)
{
    const auto json = figures_of(options);
    if (!json) {
        const int code = print_error(json.error(), terminal);
        if (!options.output.empty() && !options.json)
            put(render_metrics_of_none(options.socket), options, terminal);
        return code;
    }
    if (options.json) return put(json_text(*json) + '\n', options, terminal);
    const Figures figures{report::read<report::GetVersionReply>((*json)["version"]),
                          report::read<report::GetStatusReply>((*json)["status"]),
                          report::read<report::GetCountersReply>((*json)["counters"])};
    return put(render_metrics(figures, options.socket), options, terminal);
}

} // namespace dpslave::dpctl
