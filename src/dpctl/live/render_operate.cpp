// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/render.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

std::string render_tag(const Json& reply, std::string_view verb)
{
    const std::string name = text(reply, "name", "");
    std::string out =
        fmt::format("{}: tag {}{} {} {}, raw {}\n", text(reply, "station"), number(reply, "tag"),
                    name.empty() ? "" : " " + name, verb, text(reply, "value"), word(integer(reply, "raw")));
    if (const auto master = integer(reply, "master"))
        out += fmt::format("master {} writes this tag cyclically and will overwrite it with its own value\n",
                           *master);
    return out;
}

std::string render_reload(const Json& reply, bool is_dry_run)
{
    std::string out;
    const auto add = [&](const char* key, std::string_view before) {
        for (const Json& sentence : list(reply, key))
            if (sentence.is_string()) out += fmt::format("{}{}\n", before, sentence.get<std::string>());
    };
    add("warnings", "warning: ");
    if (!list(reply, "faults").empty()) {
        add("faults", "");
        return out + "The new configuration is refused; the one until now runs on.\n";
    }
    add("changes", "");
    add("pending", "pending: ");
    if (list(reply, "changes").empty() && list(reply, "pending").empty()) out += "Nothing has changed.\n";
    if (!is_dry_run) return out;
    for (const Json& one : list(reply, "leaving"))
        out += fmt::format("leaves the bus: {} ({})\n", text(one, "station"), text(one, "reason"));
    if (list(reply, "leaving").empty()) out += "no station leaves the bus\n";
    return out + "Nothing was done: this is what a reload would do.\n";
}

} // namespace dpslave::dpctl
