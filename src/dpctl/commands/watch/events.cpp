// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

#include <chrono>

namespace dpslave::dpctl {
namespace {

struct EventsOptions {
    std::string station;
    bool follow = false;
};

void set_up(CLI::App& app, EventsOptions& options)
{
    add_station(app, options.station);
    add_follow(app, options.follow);
}

double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void print_new(const Json& reply, Session& session)
{
    if (session.json()) return session.print_line(reply);
    session.terminal().out << render_events(report::read<report::GetEventsReply>(printable_texts(reply)),
                                            seconds_now());
}

int run(const EventsOptions& options, Session& session)
{
    const Json parameters = station_parameter(options.station);
    if (options.follow)
        return session.follow("GetEvents", parameters, [&](const Json& reply) {
            print_new(reply, session);
            return false;
        });
    return session.show("GetEvents", parameters, [](const Json& json) {
        const auto reply = report::read<report::GetEventsReply>(json);
        return reply.events.empty() ? std::string{"nothing has happened\n"}
                                    : render_events(reply, seconds_now());
    });
}

} // namespace

const Command kEvents{"events",
                      kWatch,
                      "Shows what happened, with the time, the newest last",
                      add<EventsOptions>,
                      "GetEvents, with --follow one reply a line",
                      "dpctl events --follow unwinder"};

} // namespace dpslave::dpctl
