// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

std::string render_tag(const Json& json, std::string_view verb)
{
    const auto reply = report::read<report::WriteTagReply>(json); // that of ReadTag has no master
    std::string out = fmt::format("{}: tag {}{} {} {}, raw {}\n", reply.station, reply.tag,
                                  reply.name ? " " + *reply.name : "", verb, reply.value, word(reply.raw));
    if (reply.master)
        out += fmt::format("master {} writes this tag cyclically and will overwrite it with its own value\n",
                           *reply.master);
    return out;
}

std::string render_reload(const report::ReloadReply& reply, bool is_dry_run)
{
    std::string out;
    const auto add = [&](const std::vector<std::string>& sentences, std::string_view before) {
        for (const std::string& sentence : sentences) out += fmt::format("{}{}\n", before, sentence);
    };
    add(reply.warnings, "warning: ");
    if (!reply.faults.empty()) {
        add(reply.faults, "");
        return out + "The new configuration is refused; the old one stays in use.\n";
    }
    add(reply.changes, "");
    add(reply.pending, "pending: ");
    if (reply.changes.empty() && reply.pending.empty()) out += "Nothing has changed.\n";
    if (!is_dry_run) return out;
    for (const report::LeavingStation& one : reply.leaving)
        out += fmt::format("leaves the bus: {} ({})\n", one.station, one.reason);
    if (reply.leaving.empty()) out += "no station leaves the bus\n";
    return out + "Nothing was changed: this is what a reload would do.\n";
}

} // namespace dpslave::dpctl
