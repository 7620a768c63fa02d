// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/profile/survey.hpp"

namespace dpslave::dpctl {
namespace {

std::string shown(const Json& reply)
{
    const auto log = report::read<report::SetLogLevelReply>(reply).log;
    return "level of the log: " + log_level_text(log) + '\n';
}

} // namespace

int do_log_level(const Options& options, Terminal& terminal)
{
    if (options.level.empty()) {
        const auto status = ask(options, terminal, "GetStatus", Json::object());
        if (!status) return status.error();
        const Json log = Json::object({{"log", status->value("log", Json::object())}});
        terminal.out << (options.json ? json_text(log) + '\n' : shown(log)) << std::flush;
        return kFine;
    }
    Json parameters = Json::object({{"level", options.level}});
    if (const auto time = profile::parse_duration(options.duration)) parameters["seconds"] = time->count();
    return show(options, terminal, "SetLogLevel", parameters, shown);
}

} // namespace dpslave::dpctl
