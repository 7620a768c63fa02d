// SPDX-License-Identifier: Apache-2.0
#include "dpslave/report/demand.hpp"

#include <fmt/format.h>

namespace dpslave::report {
namespace {

/// Commands 1 and 2 have the tag in register 1, 3 and 4 in register 2.
struct Request {
    bool is_extended = false, reads = false, writes = false;
    std::uint16_t tag = 0;
};

Request request_of(const DemandWords& request, bool extended)
{
    const unsigned command = request[0] >> 12;
    Request out;
    out.is_extended = extended && (command == 3 || command == 4);
    out.tag = static_cast<std::uint16_t>(out.is_extended ? request[1] : request[0] & 0x07FF);
    out.reads = command == 1 || (out.is_extended && command == 3);
    out.writes = command == 2 || (out.is_extended && command == 4);
    return out;
}

} // namespace

std::string demand_request(const DemandWords& request, bool extended, const DemandNames& names)
{
    const unsigned command = request[0] >> 12;
    if (command == 0) return "no command";
    const Request asked = request_of(request, extended);
    if (asked.reads) return "read tag " + names.tag(asked.tag);
    if (asked.writes)
        return fmt::format("write {} to tag {}", names.value(asked.tag, request[3]), names.tag(asked.tag));
    return fmt::format("command {} with tag {}", command, names.tag(asked.tag));
}

std::string demand_words(const DemandWords& request, const DemandWords& reply, bool extended,
                         const DemandNames& names)
{
    std::string asked = demand_request(request, extended, names);
    if (request[0] >> 12 == 0) return asked;
    const Request of = request_of(request, extended);
    std::string none_yet = asked + ": not answered yet";
    const unsigned answer = reply[0] >> 12;
    const unsigned echo = of.is_extended ? reply[1] : reply[0] & 0x07FF;
    if (answer == 0 || echo != of.tag) return none_yet;
    // 7; or more, where the tag of worked example 2 runs into the command: 7000 + 2088 = 9088.
    if (answer >= 7) return fmt::format("{}: rejected with error code {}", asked, reply[3]);
    if (of.writes && reply[3] != request[3]) return none_yet;
    return fmt::format("{}: done, value {}", asked, names.value(of.tag, reply[3]));
}

std::string demand_reply(const DemandWords& reply, const DemandNames& names)
{
    const unsigned answer = reply[0] >> 12;
    if (answer == 0) return "no command";
    const auto tag = static_cast<std::uint16_t>(reply[1] > 0x07FF ? reply[1] : reply[0] & 0x07FF);
    if (answer >= 7) return fmt::format("tag {}: rejected with error code {}", names.tag(tag), reply[3]);
    return fmt::format("tag {}: done, value {}", names.tag(tag), names.value(tag, reply[3]));
}

} // namespace dpslave::report
