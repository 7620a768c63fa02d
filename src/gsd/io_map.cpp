// SPDX-License-Identifier: Apache-2.0
#include "dpslave/gsd/io_map.hpp"

#include "text.hpp"

#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/sent.hpp"

#include <algorithm>
#include <array>

namespace dpslave::gsd {
namespace {

/// Demand Data as HA389815 chapter 7 and the handbook of the 2408f/2404f name its four words.
constexpr std::array<std::string_view, 4> kDemandIn{"Demand Data: answer and tag",
                                                    "Demand Data: extended tag", "Demand Data: reserved",
                                                    "Demand Data: value or error code"};
constexpr std::array<std::string_view, 4> kDemandOut{"Demand Data: command and tag",
                                                     "Demand Data: extended tag", "Demand Data: reserved",
                                                     "Demand Data: value"};

constexpr std::size_t kExtendedTag = 1; ///< place of it
constexpr std::string_view kUnused{"Demand Data: reserved"};

class MapMaker {
public:
    MapMaker(const Document& document, const MapHints& hints)
        : hints_(hints),
          modules_(hints.modules ? *hints.modules : plugged_modules(document)),
          prm_(sent_by_master(document, modules_).user.octets)
    {
        at_ = hints.tags_at.value_or(prm_.size() % 2 == 1 ? 3 : 0);
        if (!hints.tags_at && !looks_like_tags()) prm_.clear();
    }

    IoMap make()
    {
        map_.fixed = !modules_.empty();
        for (const Module* module : modules_) add(*module);
        map_.advice = advice_on_lengths(map_.in_octets, map_.out_octets);
        return std::move(map_);
    }

private:
    /// For a file that does not mention tags: true if there are as many words as parameters, none zero, then
    /// zeros only.
    bool looks_like_tags() const
    {
        std::vector<std::uint8_t> octets;
        for (const Module* module : modules_)
            octets.insert(octets.end(), module->identifiers.begin(), module->identifiers.end());
        std::size_t words = 0;
        Bytes rest = octets;
        if (!rest.empty() && rest.front() == hints_.demand_identifier) rest = rest.subspan(1);
        for (auto one = first_identifier(rest); one; one = first_identifier(rest)) {
            words += parameters_of(*one);
            rest = rest.subspan(one->length);
        }
        const std::size_t end = at_ + 2 * words;
        if (end > prm_.size()) return false;
        for (std::size_t at = at_; at < end; at += 2)
            if (be16(prm_, at) == 0) return false;
        return std::all_of(prm_.begin() + static_cast<std::ptrdiff_t>(end), prm_.end(),
                           [](std::uint8_t octet) { return octet == 0; });
    }

    void add(const Module& module)
    {
        Bytes octets = module.identifiers;
        while (const auto next = first_identifier(octets)) {
            if (is_first_ && octets[0] == hints_.demand_identifier) {
                demand();
            } else if (next->in + next->out > 0) {
                parameter(module, *next);
            }
            is_first_ = false;
            octets = octets.subspan(next->length);
        }
    }

    void demand()
    {
        for (std::size_t i = 0; i < kDemandIn.size(); ++i) {
            const bool is_unused = i == kExtendedTag && !hints_.extended_tags;
            put(map_.inputs, map_.in_octets, 2, std::string{is_unused ? kUnused : kDemandIn[i]},
                std::nullopt);
            put(map_.outputs, map_.out_octets, 2, std::string{is_unused ? kUnused : kDemandOut[i]},
                std::nullopt);
            map_.inputs.back().is_demand = map_.outputs.back().is_demand = true;
        }
    }

    /// Each word is one; other forms have one value.
    static std::size_t parameters_of(const Identifier& identifier)
    {
        if (!identifier.in_words) return identifier.in + identifier.out > 0 ? 1 : 0;
        return std::max(identifier.in, identifier.out) / 2;
    }

    void parameter(const Module& module, const Identifier& identifier)
    {
        const std::size_t count = parameters_of(identifier);
        const auto octets_of = [&](std::size_t all, std::size_t i) {
            return identifier.in_words ? (2 * i < all ? 2 : 0) : all;
        };
        for (std::size_t i = 0; i < count; ++i) {
            const auto tag = next_tag();
            std::string what = module.name;
            if (tag) {
                const auto name = hints_.names.find(*tag);
                what = name == hints_.names.end() ? "tag " + std::to_string(*tag) : name->second;
            }
            if (const std::size_t in = octets_of(identifier.in, i))
                put(map_.inputs, map_.in_octets, in, what, tag);
            if (const std::size_t out = octets_of(identifier.out, i))
                put(map_.outputs, map_.out_octets, out, what, tag);
        }
    }

    static void put(std::vector<IoValue>& values, std::size_t& length, std::size_t octets, std::string what,
                    std::optional<std::uint16_t> tag)
    {
        values.push_back({length, octets, std::move(what), tag, false});
        length += octets;
    }

    /// The tags are in the order of the identifiers; a zero means no tag.
    std::optional<std::uint16_t> next_tag()
    {
        if (at_ + 2 > prm_.size()) return std::nullopt;
        const std::uint16_t tag = be16(prm_, at_);
        at_ += 2;
        if (tag == 0) return std::nullopt;
        return tag;
    }

    const MapHints& hints_;
    std::vector<const Module*> modules_;
    std::vector<std::uint8_t> prm_;
    std::size_t at_ = 0; ///< of the next tag
    bool is_first_ = true;
    IoMap map_;
};

/// Two limits of two manuals, so two sentences where both are passed.
void advise(std::vector<Advice>& advice, std::size_t octets, const std::string& direction)
{
    const std::string begin = std::to_string(octets) + ' ' + direction + " octets are more than 32 ";
    const std::string end = ", which some masters cannot take: look into the manual of yours.";
    if (octets > 32) advice.push_back({"over_32_octets", begin + "octets" + end});
    if (octets > 64) advice.push_back({"over_32_words", begin + "words" + end});
}

} // namespace

IoMap io_map(const Document& document, const MapHints& hints)
{
    return MapMaker{document, hints}.make();
}

std::vector<Advice> advice_on_lengths(std::size_t in_octets, std::size_t out_octets)
{
    constexpr std::size_t kConfiguratorWords = 117;
    std::vector<Advice> advice;
    advise(advice, in_octets, "input");
    advise(advice, out_octets, "output");
    if (in_octets + out_octets > 2 * kConfiguratorWords)
        advice.push_back(
            {"over_117_words",
             std::to_string((in_octets + out_octets) / 2) +
                 " input and output words together are more than 117, the limit of the 2408f/2404f."});
    return advice;
}

} // namespace dpslave::gsd
