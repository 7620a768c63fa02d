// SPDX-License-Identifier: Apache-2.0
#include "dpslave/dp/chk_cfg.hpp"

#include <algorithm>

namespace dpslave::dp {
namespace {

static_assert(kDemandOctets + 2 * kMaxParameters <= 244, "no legal layout exceeds a telegram");

/// Returns the identifier at `cfg`, or nullopt.
const Identifier* find(const Personality& personality, Bytes cfg)
{
    for (const Identifier& identifier : personality.identifiers)
        if (identifier.same_octets(cfg) == identifier.length) return &identifier;
    return nullptr;
}

/// No valid identifier begins at octet `at` (counted from 0): the result names the octet that differs from
/// the most similar one.
RefusalDetail no_identifier(const Personality& personality, Bytes cfg, std::size_t at)
{
    const std::uint8_t legal = personality.identifiers.empty() ? personality.demand_identifier
                                                               : personality.identifiers.front().form[0];
    RefusalDetail found = refuse(Refusal::cfg_identifier, at + 1, legal, cfg[at]).why;
    std::size_t most = 0;
    for (const Identifier& identifier : personality.identifiers) {
        const std::size_t same = identifier.same_octets(cfg.subspan(at));
        if (same <= most) continue;
        most = same;
        const bool is_there = at + same < cfg.size() && cfg[at + same] != 0; // 00 would read as an empty slot
        found =
            is_there
                ? refuse(Refusal::cfg_identifier, at + same + 1, identifier.form[same], cfg[at + same]).why
                : refuse(Refusal::cfg_identifier, at + 1, cfg[at], cfg[at]).why;
    }
    return found;
}

/// Identifiers of parameters, one after the other. An identifier that this device does not have counts as one
/// of one octet and one word.
class Walk {
public:
    Walk(const Personality& personality, Bytes cfg, std::size_t first)
        : personality_(personality), cfg_(cfg), at_(first)
    {
        look();
    }

    bool at_end() const { return at_ >= cfg_.size(); }
    const Identifier* identifier() const { return identifier_; }
    std::size_t at() const { return at_; } ///< its first octet, counted from 0
    std::size_t words() const { return identifier_ != nullptr ? identifier_->words() : 1; }
    void next()
    {
        at_ += identifier_ != nullptr ? identifier_->length : 1u;
        look();
    }

private:
    void look() { identifier_ = at_end() ? nullptr : find(personality_, cfg_.subspan(at_)); }

    const Personality& personality_;
    Bytes cfg_;
    std::size_t at_;
    const Identifier* identifier_ = nullptr;
};

/// One word of an identifier.
void add(Configuration& taken, std::uint16_t tag, const Identifier& identifier)
{
    const bool reads = identifier.reads > 0, writes = identifier.writes > 0;
    taken.layout.parameters[taken.layout.count++] = {tag, reads, writes};
    taken.in_length += reads ? 2 : 0;
    taken.out_length += writes ? 2 : 0;
    taken.reads = taken.reads || reads;
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

    std::size_t words = 0, too_many_at = 0;
    for (Walk walk{personality, cfg, first}; !walk.at_end(); walk.next()) {
        if (words <= most && words + walk.words() > most) too_many_at = walk.at();
        words += walk.words();
    }
    if (first + words > longest) // whatever they are (B-085)
        return refuse(Refusal::cfg_too_long, too_many_at + 1, first + most, first + words);
    for (Walk walk{personality, cfg, first}; !walk.at_end(); walk.next())
        if (walk.identifier() == nullptr) return Failure{no_identifier(personality, cfg, walk.at())};

    if (taken.demand) taken.in_length = taken.out_length = kDemandOctets;

    // Demand Data is in both lengths: its 8 words count as well.
    const auto fits = [&](std::size_t more) {
        return personality.max_words == 0 ||
               (taken.in_length + taken.out_length) / 2 + more <= personality.max_words;
    };
    if (!fits(0)) return refuse(Refusal::cfg_too_long, 1, 0, first + words);

    const bool has_tags = personality.prm.list != TagList::none;
    std::size_t count = 0, no_tag_at = 0;
    for (Walk walk{personality, cfg, first}; !walk.at_end(); walk.next()) {
        const Identifier& identifier = *walk.identifier();
        if (count + identifier.words() > most || !fits(std::size_t{identifier.reads} + identifier.writes))
            return refuse(Refusal::cfg_too_long, walk.at() + 1, first + count, first + words);
        if (count <= tags.size() && count + identifier.words() > tags.size()) no_tag_at = walk.at();
        // Without a list of tags the place is the number. With a list of tags an identifier beyond the list
        // is refused by the counts below.
        for (std::size_t word = 0; word < identifier.words(); ++word, ++count)
            add(taken, count < tags.size() ? tags[count] : static_cast<std::uint16_t>(count + 1), identifier);
    }
    if (count == 0 && !personality.may_have_no_parameters) return refuse(Refusal::cfg_too_few, 0, 1, 0);
    if (!has_tags) return taken;
    if (count < tags.size()) return refuse(Refusal::cfg_too_few, 0, tags.size(), count);
    if (count > tags.size()) return refuse(Refusal::cfg_too_many, no_tag_at + 1, tags.size(), count);
    return taken;
}

RefusalDetail cfg_difference(Bytes accepted, Bytes cfg)
{
    const auto [a, b] = std::mismatch(accepted.begin(), accepted.end(), cfg.begin(), cfg.end());
    const auto at = static_cast<std::size_t>(a - accepted.begin());
    return refuse(Refusal::cfg_changed, at + 1, a == accepted.end() ? 0u : *a, b == cfg.end() ? 0u : *b).why;
}

} // namespace dpslave::dp
