// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

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

} // namespace dpslave::dpctl
