// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

struct VersionOptions {};

int run(const VersionOptions& /*options*/, Session& session)
{
    std::ostream& out = session.terminal().out;
    const auto reply = session.call("GetVersion");
    const auto failed = reply ? std::nullopt : reply.error().failed;
    const bool no_daemon = failed && failed->kind == control::ClientError::Kind::no_daemon;
    if (!session.json()) out << "dpctl " << DPSLAVE_VERSION << std::endl;
    if (!reply && !no_daemon) return session.print_stopped(reply.error());
    const Json document =
        no_daemon
            ? Json::object(
                  {{"program", "dpctl"}, {"version", DPSLAVE_VERSION}, {"interface", "org.dpslaved.Control"}})
            : *reply;
    session.print(document, [&] {
        if (no_daemon) return fmt::format("no daemon: {}\n", failed->text);
        const auto daemon = report::read<report::GetVersionReply>(printable_texts(document));
        return fmt::format("{} {} ({})\n", daemon.program, daemon.version, daemon.interface);
    });
    return kFine;
}

} // namespace

const Command kVersion{"version",
                       kLook,
                       "Shows the versions of dpctl and of the daemon",
                       add<VersionOptions>,
                       "GetVersion",
                       "",
                       "0 also without a daemon, 3 this user may not open the socket"};

} // namespace dpslave::dpctl
