// SPDX-License-Identifier: Apache-2.0
// Who else uses the port (wire reference 11: nobody may).
#include "dpctl/cli/words.hpp"
#include "tune.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

std::optional<TuneFinding> shared_port(const io::PortUsers& users)
{
    if (users.is_shared())
        return TuneFinding{
            Severity::mend,
            "port.shared",
            fmt::format("{} is used by others: {}", users.port, users.in_words()),
            "octets of the bus are taken away, and others may be sent",
            {"End that program. If it is a login prompt: sudo systemctl mask --now serial-getty@PORT (PORT without /dev/)",
             "If it is the console: take console=PORT out of the kernel's command line, and restart the machine. On a Raspberry Pi that is in cmdline.txt",
             "ModemManager and brltty: docs/guide/hardware.md says how to keep them away from this port"}};
    if (users.hidden == 0) return std::nullopt;
    return TuneFinding{
        Severity::know,
        "port.not_seen",
        fmt::format(
            "whether another program has {} open is not known: the files of {} of other users cannot be seen",
            users.port, plural(static_cast<std::int64_t>(users.hidden), "process", "processes")),
        {},
        {"Run it as root: sudo dpctl tune"}};
}

} // namespace dpslave::dpctl
