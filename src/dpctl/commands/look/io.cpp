// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/commands/commands.hpp"
#include "dpctl/live/follow.hpp"

namespace dpslave::dpctl {
namespace {

struct IoOptions {
    std::string station;
    bool follow = false;
};

void set_up(CLI::App& app, IoOptions& options)
{
    add_station(app, options.station);
    add_follow(app, options.follow);
}

int run(const IoOptions& options, Session& session)
{
    if (options.follow) return follow_pictures({render_followed_io, io_changes}, options.station, session);
    const auto reply = session.ask_of_stations("GetIo", options.station);
    if (!reply) return reply.error();
    session.print(*reply, [&] { return render_io(*reply, session.terminal().look()); });
    return kFine;
}

} // namespace

const Command kIo{"io", kLook, "Shows inputs and outputs by tag: raw, scaled, state and age", add<IoOptions>,
                  "GetIo, with --follow those of Watch, one a line"};

} // namespace dpslave::dpctl
