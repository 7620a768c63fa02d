// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// So many requests in a row without an answer: a master repeats a request once or twice before it goes on.
constexpr std::int64_t kSilent = 4;

bool is_silent(const report::Member& member)
{
    return member.unanswered >= kSilent;
}

std::string kind(const report::Member& member)
{
    if (member.ours) return "gateway";
    if (member.master && member.slave) return "both";
    if (member.master) return "master";
    return member.slave ? "slave" : "not heard";
}

Cell state(const report::Member& member)
{
    // Our own one is silent because its drive is gone or its function block is off: status says which.
    if (is_silent(member)) return {member.ours ? "silent" : "no answer", Tone::bad};
    if (!member.slave) return "-";
    return {member.state, member.state == "Data_Exch" ? Tone::good : Tone::plain};
}

/// "9.8/10.0/12.4".
std::string cycle(const std::optional<report::Spacing>& spacing)
{
    if (!spacing) return "-";
    return fmt::format("{:.1f}/{:.1f}/{:.1f}", spacing->min_ms, spacing->mean_ms, spacing->max_ms);
}

std::string share(double percent)
{
    return percent > 0 && percent < 0.05 ? "< 0.1 %" : fmt::format("{:.1f} %", percent);
}

Table members(const report::GetBusReply& reply)
{
    Table table({">ADDR", "WHAT", "IDENT", "STATE", ">BY", ">CYCLE ms", ">RETRIES", ">LOAD", ">HEARD"});
    for (const report::Member& one : reply.members)
        table.add({std::to_string(one.address), kind(one),
                   one.ident ? fmt::format("{:04X}", *one.ident) : std::string{"-"}, state(one),
                   number(one.asked_by), cycle(one.cycle), std::to_string(one.retries),
                   share(one.load_percent), age(one.last_heard_age_ms)});
    return table;
}

} // namespace

std::string render_bus(const report::GetBusReply& reply, Look look)
{
    std::string out = headline("bus  ",
                               fmt::format("{}, {}, {}, load {}", reply.port, rate(reply.baud),
                                           reply.baud_state, share(reply.load_percent)),
                               look);
    if (reply.members.empty()) return out + "  no station was heard yet; ask for the cause: dpctl doctor\n";
    out += '\n' + members(reply).str(look, 2);
    std::string unanswered;
    for (const report::Member& one : reply.members)
        if (is_silent(one) && one.asked_by)
            unanswered +=
                paragraph("  ",
                          fmt::format("Master {} asks for address {} and gets no answer: {}, last {} ago.",
                                      *one.asked_by, one.address, plural(one.unanswered, "request"),
                                      age(one.last_asked_age_ms)),
                          look.width);
    if (!unanswered.empty()) out += '\n' + unanswered;
    return out + "\n  CYCLE: shortest, mean and longest of the last ten seconds; of a slave from one\n"
                 "  Data_Exchange to the next, of a master from one token to the next.\n";
}

} // namespace dpslave::dpctl
