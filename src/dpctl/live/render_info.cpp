// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

std::string address(const report::Info& info)
{
    const auto pending = info.address_pending;
    std::string result = std::to_string(info.address_active) + " active";
    if (pending && pending != info.address_active)
        result += fmt::format(
            ", {} pending: it is in the configuration file and takes effect at the next start of dpslaved",
            *pending);
    return result;
}

std::string limits(const report::Info& info)
{
    return fmt::format("{} parameters, {} octets in, {} octets out, {} octets of diagnosis",
                       info.max_parameters, info.max_input_octets, info.max_output_octets,
                       info.max_diag_octets);
}

/// The two words of a controller's Comms list (2408f/2404f handbook ch. 4).
std::string comms_status(const std::string& shown)
{
    if (shown == "rdY") return "rdY (ready to run)";
    return shown == "run" ? "run (comms running)" : shown;
}

/// "9.6 kbit/s: 60 T_bit" a line.
std::string rates(const report::Info& info)
{
    std::string result;
    for (std::size_t i = 0; i < info.bauds.size(); ++i) {
        result += (result.empty() ? "" : "\n") + rate(info.bauds[i]);
        if (i < info.max_tsdr.size()) result += fmt::format(", answers within {} T_bit", info.max_tsdr[i]);
    }
    return result;
}

/// "rule 590plus, assumed: ...".
std::string mnemonics(const report::Info& info)
{
    std::string result = "rule " + *info.mnemonic_rule;
    if (info.mnemonics_assumed) result += ", assumed";
    if (info.mnemonic_source) result += ": " + *info.mnemonic_source;
    return result;
}

} // namespace

void add_info(Block& block, const report::Info& info, std::string_view version)
{
    block.add("order code", info.order_code);
    block.add("OPTION VERSION", std::string{version});
    if (info.option_software) block.add("option software", *info.option_software);
    block.add("host firmware", info.firmware);
    block.add("manual", info.manual);
    block.add("Ident_Number", fmt::format("0x{:04X}", info.ident));
    if (info.tags_at) block.add("tags at octet", fmt::format("{} of User_Prm_Data", *info.tags_at));
    if (const std::string own = joined(info.identifiers, ", "); !own.empty()) block.add("identifiers", own);
    block.add("address", address(info));
    if (info.comms_status) block.add("comms status", comms_status(*info.comms_status));
    if (info.resolution) block.add("resolution", *info.resolution);
    block.add("legal addresses", fmt::format("{} to {}", info.address_min, info.address_max));
    block.add("at most", limits(info));
    block.add("has Demand Data", yes_no(info.demand_data));
    block.add("has Sync, Freeze", yes_no(info.sync) + ", " + yes_no(info.freeze));
    block.add("rates", rates(info));
    block.add("tag table", fmt::format("{}, {}", info.tag_table, plural(info.tags_in_table, "tag")));
    if (info.mnemonic_rule)
        block.add("mnemonics", mnemonics(info), info.mnemonics_assumed ? Tone::bad : Tone::plain);
    if (const std::string notes = joined(info.notes, "\n"); !notes.empty()) block.add("notes", notes);
}

} // namespace dpslave::dpctl
