// SPDX-License-Identifier: Apache-2.0
// Data_Exchange by the configuration that a Chk_Cfg before it has made: Demand Data, then each word with its
// tag (wire reference 4.7; HA389815 ch. 7).
#include "decode.hpp"
#include "dpctl/cli/words.hpp"

#include "dpslave/report/demand.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

/// As the device displays it; of a row whose decimals are those of its display, which nothing here tells, the
/// number.
std::string shown(const profile::Profile& device, std::uint16_t tag, std::uint16_t word)
{
    const drive::Tag* row = device.tags.find(tag);
    if (row == nullptr) return fmt::format(">{:04X}", word);
    if (row->follows_display) return drive::displayed(*row, word) + " (without the decimals of the display)";
    return drive::displayed(*row, word);
}

std::string demand_line(Bytes data, bool is_request, DecodeContext& context)
{
    const profile::Profile& device = *context.device;
    const bool extended = device.personality.demand == dp::DemandForm::extended;
    report::DemandNames names;
    names.value = [&device](std::uint16_t tag, std::uint16_t word) { return shown(device, tag, word); };
    names.tag = [&device](std::uint16_t tag) { return tag_words(tag, device); };
    const report::DemandWords words{be16(data, 0), be16(data, 2), be16(data, 4), be16(data, 6)};
    if (is_request) {
        context.demand = words;
        return report::demand_request(words, extended, names);
    }
    return context.demand ? report::demand_words(*context.demand, words, extended, names)
                          : report::demand_reply(words, names);
}

} // namespace

std::string tag_words(std::uint16_t tag, const profile::Profile& device)
{
    const drive::Tag* row = device.tags.find(tag);
    return row == nullptr || row->name.empty() ? std::to_string(tag) : fmt::format("{} {}", tag, row->name);
}

bool decode_exchange(Bytes data, bool is_request, DecodeContext& context, Decoded& into)
{
    if (context.device == nullptr || !context.configuration || data.empty()) return false;
    const dp::Configuration& configuration = *context.configuration;
    const std::size_t length = is_request ? configuration.out_length : configuration.in_length;
    if (data.size() != length) {
        into.faults.push_back(fmt::format("the configuration has {} of {}, here are {}",
                                          plural(static_cast<std::int64_t>(length), "octet"),
                                          is_request ? "outputs" : "inputs", data.size()));
        return false;
    }
    if (configuration.demand) {
        into.lines.push_back({"Demand Data", demand_line(data, is_request, context)});
        data = data.subspan(dp::kDemandOctets);
    }
    for (std::size_t i = 0; i < configuration.layout.count; ++i) {
        const LayoutEntry& one = configuration.layout.parameters[i];
        if (!(is_request ? one.writes : one.reads)) continue;
        into.lines.push_back(
            {tag_words(one.tag, *context.device), shown(*context.device, one.tag, be16(data, 0))});
        data = data.subspan(2);
    }
    return true;
}

} // namespace dpslave::dpctl
