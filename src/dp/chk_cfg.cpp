// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/chk_cfg.hpp"

#include <algorithm>

namespace dpslave::dp {
namespace {

static_assert(kDemandOctets + 2 * kMaxParameters <= 244, "no legal layout exceeds a telegram");

const Identifier* find(const Personality& personality, std::uint8_t octet)
{
    for (const Identifier& identifier : personality.identifiers)
        if (identifier.octet == octet) return &identifier;
    return nullptr;
}

std::uint8_t a_legal_one(const Personality& personality)
{
    return personality.identifiers.empty() ? personality.demand_identifier
                                           : personality.identifiers.front().octet;
}

void add(Configuration& taken, std::uint16_t tag, const Identifier& identifier)
{
    taken.layout.parameters[taken.layout.count++] = {tag, identifier.reads, identifier.writes};
    taken.in_length += identifier.reads ? 2 : 0;
    taken.out_length += identifier.writes ? 2 : 0;
    taken.reads = taken.reads || identifier.reads;
}

} // namespace

Result<Configuration, RefusalDetail> check_chk_cfg(const Personality& personality,
                                                   std::span<const std::uint16_t> tags, Bytes cfg)
{
    if (cfg.empty()) return refuse(Refusal::cfg_empty, 0, 1, 0);

    Configuration taken;
    taken.demand = personality.demand_identifier != 0 && cfg[0] == personality.demand_identifier;
    const std::size_t first = taken.demand ? 1 : 0;
    const std::size_t most = std::min(personality.max_parameters, kMaxParameters);
    const std::size_t longest = most + (personality.demand_identifier != 0 ? 1 : 0);
    if (cfg.size() > longest) // whatever they are (B-085)
        return refuse(Refusal::cfg_too_long, first + most + 1, first + most, cfg.size());
    for (std::size_t i = first; i < cfg.size(); ++i)
        if (find(personality, cfg[i]) == nullptr)
            return refuse(Refusal::cfg_identifier, i + 1, a_legal_one(personality), cfg[i]);

    if (taken.demand) taken.in_length = taken.out_length = kDemandOctets;

    // Demand Data is in both lengths: its 8 words count as well.
    const auto fits = [&](const Identifier& one) {
        const std::size_t more = (one.reads ? 1u : 0u) + (one.writes ? 1u : 0u);
        const std::size_t words = (taken.in_length + taken.out_length) / 2 + more;
        return personality.max_words == 0 || words <= personality.max_words;
    };
    if (!fits({})) return refuse(Refusal::cfg_too_long, 1, 0, cfg.size());

    const std::size_t count = cfg.size() - first;
    const bool has_tags = personality.prm.list != TagList::none;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t octet = first + i + 1;
        const Identifier& identifier = *find(personality, cfg[first + i]);
        if (i == most || !fits(identifier))
            return refuse(Refusal::cfg_too_long, octet, first + i, cfg.size());
        // Without tags the place is the number. With a list of tags an identifier beyond the list is refused
        // by the counts below.
        add(taken, i < tags.size() ? tags[i] : static_cast<std::uint16_t>(i + 1), identifier);
    }
    if (count == 0 && !personality.may_have_no_parameters) return refuse(Refusal::cfg_too_few, 0, 1, 0);
    if (!has_tags) return taken;
    if (count < tags.size()) return refuse(Refusal::cfg_too_few, 0, tags.size(), count);
    if (count > tags.size())
        return refuse(Refusal::cfg_too_many, first + tags.size() + 1, tags.size(), count);
    return taken;
}

RefusalDetail cfg_difference(Bytes accepted, Bytes cfg)
{
    const auto [a, b] = std::mismatch(accepted.begin(), accepted.end(), cfg.begin(), cfg.end());
    const auto at = static_cast<std::size_t>(a - accepted.begin());
    return refuse(Refusal::cfg_changed, at + 1, a == accepted.end() ? 0u : *a, b == cfg.end() ? 0u : *b).why;
}

} // namespace dpslave::dp
