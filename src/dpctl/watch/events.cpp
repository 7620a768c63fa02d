// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <chrono>

namespace dpslave::dpctl {
namespace {

std::chrono::system_clock::time_point moment(double seconds)
{
    using std::chrono::system_clock;
    return system_clock::time_point{
        std::chrono::duration_cast<system_clock::duration>(std::chrono::duration<double>{seconds})};
}

double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

void print(const Json& reply, const Options& options, Terminal& terminal)
{
    if (options.json)
        terminal.out << printable_json(reply.dump(-1, ' ', false, Json::error_handler_t::replace)) << '\n';
    else
        terminal.out << render_events(report::read<report::GetEventsReply>(printable_texts(reply)),
                                      seconds_now());
    terminal.out << std::flush;
}

} // namespace

std::string render_events(const report::GetEventsReply& reply, double now)
{
    std::string out;
    if (reply.lost > 0)
        out += fmt::format("{} before these {} not kept any more\n", plural(reply.lost, "event"),
                           reply.lost == 1 ? "is" : "are");
    for (const report::Event& one : reply.events) {
        const std::string count = one.count > 1 ? fmt::format(" ({} times)", one.count) : std::string{};
        out += fmt::format("{} {}{}\n", date_and_time(moment(now - one.age_ms / 1000)), one.text, count);
    }
    return out;
}

int do_events(const Options& options, Terminal& terminal)
{
    if (options.follow)
        return follow_replies(options, terminal, "GetEvents", station_parameter(options),
                              [&](const control::ReplyMessage& reply) {
                                  print(reply.parameters, options, terminal);
                                  return false;
                              });
    return show(options, terminal, "GetEvents", station_parameter(options), [](const Json& json) {
        const auto reply = report::read<report::GetEventsReply>(json);
        return reply.events.empty() ? std::string{"nothing has happened\n"}
                                    : render_events(reply, seconds_now());
    });
}

} // namespace dpslave::dpctl
