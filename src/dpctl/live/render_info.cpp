// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

std::string address(const Json& info)
{
    const auto active = integer(info, "address_active"), pending = integer(info, "address_pending");
    std::string result = number(info, "address_active") + " active";
    if (pending && pending != active)
        result += fmt::format(
            ", {} pending: the configuration file has it, the next start of dpslaved takes it", *pending);
    return result;
}

std::string limits(const Json& info)
{
    return fmt::format("{} parameters, {} octets in, {} octets out, {} octets of diagnosis",
                       number(info, "max_parameters"), number(info, "max_input_octets"),
                       number(info, "max_output_octets"), number(info, "max_diag_octets"));
}

/// The two words of a controller's Comms list (2408f/2404f handbook ch. 4).
std::string comms_status(const std::string& shown)
{
    if (shown == "rdY") return "rdY (ready to run)";
    return shown == "run" ? "run (comms running)" : shown;
}

/// "9.6 kbit/s: 60 T_bit" a line.
std::string rates(const Json& info)
{
    const Json& bauds = list(info, "bauds");
    const Json& tsdr = list(info, "max_tsdr");
    std::string result;
    for (std::size_t i = 0; i < bauds.size(); ++i) {
        if (!bauds[i].is_number_integer()) continue;
        result += (result.empty() ? "" : "\n") + rate(bauds[i].get<std::int64_t>());
        if (i < tsdr.size() && tsdr[i].is_number_integer())
            result += fmt::format(", answers within {} T_bit", tsdr[i].get<std::int64_t>());
    }
    return result;
}

} // namespace

void add_info(Block& block, const Json& info, std::string_view version)
{
    block.add("order code", text(info, "order_code"));
    block.add("OPTION VERSION", std::string{version});
    if (const std::string software = text(info, "option_software", ""); !software.empty())
        block.add("option software", software);
    block.add("host firmware", text(info, "firmware"));
    block.add("manual", text(info, "manual"));
    block.add("Ident_Number", fmt::format("0x{:04X}", integer(info, "ident").value_or(0)));
    block.add("address", address(info));
    if (const std::string status = text(info, "comms_status", ""); !status.empty())
        block.add("comms status", comms_status(status));
    if (const std::string resolution = text(info, "resolution", ""); !resolution.empty())
        block.add("resolution", resolution);
    block.add("legal addresses",
              fmt::format("{} to {}", number(info, "address_min"), number(info, "address_max")));
    block.add("at most", limits(info));
    block.add("has Demand Data", yes_no(flag(info, "demand_data")));
    block.add("has Sync, Freeze", yes_no(flag(info, "sync")) + ", " + yes_no(flag(info, "freeze")));
    block.add("rates", rates(info));
    block.add("tag table", fmt::format("{}, {}", text(info, "tag_table"),
                                       plural(integer(info, "tags_in_table").value_or(0), "tag")));
    if (const std::string notes = joined(list(info, "notes"), "\n"); !notes.empty())
        block.add("notes", notes);
}

} // namespace dpslave::dpctl
