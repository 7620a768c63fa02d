// SPDX-License-Identifier: Apache-2.0
// Who else uses the serial ports of this machine. dpctl looks, for the daemon's sandbox hides other processes
// from it.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kSharedSteps =
    "End that program. If it is a login prompt: sudo systemctl mask --now serial-getty@PORT (PORT without /dev/)\n"
    "If it is the console: take console=PORT out of the kernel's command line. On a Raspberry Pi that is in cmdline.txt; then restart the machine.\n"
    "ModemManager and brltty: docs/guide/hardware.md says how to keep them away from this port.";

std::string seen_users(const Facts& f, const std::string& port)
{
    const auto& all = f.replies.ports;
    const auto one = std::ranges::find(all, port, &io::PortUsers::port);
    if (one == all.end() || !one->is_shared()) return {};
    return fmt::format("{}: {}", port, one->in_words());
}
std::string seen_users_of_bus(const Facts& f)
{
    return seen_users(f, f.bus.port);
}
std::string seen_users_of_line(const Facts& f)
{
    return seen_users(f, f.station.drive.port);
}
std::string seen_hidden(const Facts& f)
{
    std::size_t hidden = 0;
    for (const io::PortUsers& one : f.replies.ports) hidden = std::max(hidden, one.hidden);
    if (hidden == 0) return {};
    return fmt::format("the files of {} of other users cannot be seen",
                       plural(static_cast<std::int64_t>(hidden), "process", "processes"));
}

constexpr Rule kRules[] = {
    {"bus.shared", Rank::stands,
     "another process has the port of the bus open, or it is the console of the kernel",
     "Another program uses the port of the bus: it takes octets away, and may send", kSharedSteps, kGateway,
     seen_users_of_bus},
    {"drive.shared", Rank::stands,
     "another process has the port of the drive line open, or it is the console of the kernel",
     "Another program uses the port of the drive line: it takes answers away, and may send", kSharedSteps,
     kGateway, seen_users_of_line},
    {"bus.not_seen", Rank::note, "dpctl doctor runs as a user that may not look into other processes",
     "Whether another program has a port open is not known", "Run it as root: sudo dpctl doctor", kGateway,
     seen_hidden},
};

} // namespace

std::span<const Rule> port_rules()
{
    return kRules;
}

} // namespace dpslave::dpctl
