// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"

#include <chrono>
#include <optional>

namespace dpslave::dpctl {
namespace {

struct LogLevelOptions {
    std::string level;                            ///< empty = which one is it
    std::optional<std::chrono::nanoseconds> time; ///< nothing: as long as the daemon has it
};

void set_up(CLI::App& app, LogLevelOptions& options)
{
    auto* level = add_choice(app, "LEVEL", options.level, {"debug", "info"},
                             "debug or info; without it: which one it is");
    add_time(app, "TIME", options.time, "With debug: until it is info again: 90s, 10m, 2h. Default: 10m",
             {std::chrono::seconds{1}, std::chrono::hours{30 * 24}})
        ->needs(level);
}

std::string log_level_line(const Json& reply)
{
    const auto log = report::read<report::SetLogLevelReply>(reply).log;
    return "level of the log: " + log_level_text(log) + '\n';
}

int run(const LogLevelOptions& options, Session& session)
{
    if (options.level.empty()) {
        const auto status = session.ask("GetStatus");
        if (!status) return status.error();
        const Json log = Json::object({{"log", status->value("log", Json::object())}});
        session.print(log, [&] { return log_level_line(log); });
        return kFine;
    }
    Json parameters = Json::object({{"level", options.level}});
    if (options.time) parameters["seconds"] = std::chrono::ceil<std::chrono::seconds>(*options.time).count();
    return session.show("SetLogLevel", parameters, log_level_line);
}

} // namespace

const Command kLogLevel{
    "log-level",
    kOperate,
    "Shows the level of the log, or sets it to debug for a while (root and the operator group)",
    add<LogLevelOptions>,
    "SetLogLevel",
    "dpctl log-level debug 10m   each call and each request to a drive is a line of the log\n"
    "dpctl log-level info        ends it now"};

} // namespace dpslave::dpctl
