// SPDX-License-Identifier: Apache-2.0
/// Who is on the bus, as the control interface has it.
#include "report.hpp"

#include <algorithm>
#include <chrono>

namespace dpslave::app {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;

std::optional<double> ago(Instant at, Instant now)
{
    if (at == Instant{}) return std::nullopt;
    return Milliseconds{std::max(now, at) - at}.count();
}

report::Member member_report(const dp::Member& member, const dp::Recurrence::Figures& figures, Instant now)
{
    report::Member result;
    result.master = member.is_master;
    result.slave = member.is_slave;
    result.state = dp::text(member.state);
    if (member.ident) result.ident = integer(*member.ident);
    if (member.last_asked != Instant{}) result.asked_by = integer(member.asked_by);
    result.asked = integer(member.asked);
    result.answers = integer(member.answers);
    result.retries = integer(member.retries);
    result.unanswered = integer(member.unanswered);
    result.last_heard_age_ms = ago(member.last_heard, now);
    result.last_asked_age_ms = ago(member.last_asked, now);
    if (figures.intervals != 0)
        result.cycle = report::Spacing{Milliseconds{figures.min}.count(), Milliseconds{figures.mean}.count(),
                                       Milliseconds{figures.max}.count()};
    return result;
}

} // namespace

bool is_ours(const View& view, std::uint8_t address)
{
    return std::any_of(view.stations.begin(), view.stations.end(),
                       [address](const Station& station) { return station.address == address; });
}

report::GetBusReply members_report(const View& view, Instant now)
{
    report::GetBusReply reply;
    reply.port = view.config->bus.port;
    reply.baud = integer(view.bus.baud);
    reply.baud_state = fdl::text(view.bus.baud_state);
    const double bits_per_octet = 100.0 * kCharacter.count / static_cast<double>(reply.baud);
    for (std::size_t address = 0; address < view.members.size(); ++address) {
        const dp::Member& member = view.members[address];
        if (!member.was_seen()) continue;
        const auto figures = member.recurrence.figures(now);
        report::Member one = member_report(member, figures, now);
        one.address = integer(address);
        one.ours = is_ours(view, static_cast<std::uint8_t>(address));
        one.load_percent = figures.octets_per_second * bits_per_octet;
        reply.load_percent += one.load_percent;
        reply.members.push_back(std::move(one));
    }
    return reply;
}

} // namespace dpslave::app
