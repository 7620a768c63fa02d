// SPDX-License-Identifier: Apache-2.0
#include "plant_keys.hpp"

#include "dpslave/dp/set_prm.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/sent.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

class Finder {
public:
    Finder(const profile::Profile& profile, const gsd::Document& document,
           const std::optional<std::vector<const gsd::Module*>>& modules)
        : profile_(profile), document_(document), modules_(modules)
    {
        const gsd::Sent sent =
            gsd::sent_by_master(document, modules ? *modules : gsd::plugged_modules(document));
        user_ = sent.user.octets;
        set_prm_ = gsd::set_prm_of(sent);
        is_open_ = !modules && gsd::plugging_of(document) == gsd::Plugging::choice &&
                   gsd::any_own_parameters(document);
    }

    PlantKeys find()
    {
        PlantKeys plain{.keys = {}, .verdict = judged({})};
        if (!plain.verdict.refused || !can_be_mended(plain.verdict.refused->detail.why)) return plain;
        const std::vector<dp::Identifier> identifiers = own_identifiers();
        if (!identifiers.empty())
            if (const profile::StationKeys keys{.identifiers = identifiers}; taken(keys)) return found(keys);
        for (const auto& each : {std::vector<dp::Identifier>{}, identifiers})
            if (const auto keys = with_tags_at(each)) return found(*keys);
        plain.no_identifiers = std::move(no_identifiers_);
        return plain;
    }

private:
    /// Returns whether another place of the tags, or other identifiers, can correct it.
    static bool can_be_mended(dp::Refusal why)
    {
        return why != dp::Refusal::prm_ident && why != dp::Refusal::prm_not_supported &&
               why != dp::Refusal::prm_watchdog;
    }

    profile::FileVerdict judged(const profile::StationKeys& keys) const
    {
        return profile::judge_file(personality_of(profile_, with_ident(keys)), document_, modules_);
    }
    /// The mapping has the ident of the file.
    profile::StationKeys with_ident(profile::StationKeys keys) const
    {
        if (const auto ident = document_.number("Ident_Number"); ident && *ident > 0 && *ident <= 0xFFFF)
            keys.ident = static_cast<std::uint16_t>(*ident);
        return keys;
    }
    /// Only zeros are before a tag at this place: octets that may be a tag are never left out.
    bool is_place_of_a_tag(std::size_t at) const
    {
        const std::size_t own = profile_.personality.prm.dpv1_status ? dp::kDpv1Status : 0;
        if (at + 2 > user_.size() || at < own) return false;
        return std::all_of(user_.begin() + static_cast<std::ptrdiff_t>(own),
                           user_.begin() + static_cast<std::ptrdiff_t>(at),
                           [](std::uint8_t octet) { return octet == 0; });
    }
    /// Returns whether Set_Prm alone is accepted: most places fail there, and lists of modules need not be
    /// searched.
    bool may_be_taken(const profile::StationKeys& keys) const
    {
        if (!profile::wrong_keys(profile_, keys).empty()) return false;
        if (is_open_) return true;
        return static_cast<bool>(dp::check_set_prm(personality_of(profile_, with_ident(keys)), set_prm_));
    }
    bool taken(const profile::StationKeys& keys) const
    {
        return profile::wrong_keys(profile_, keys).empty() && !judged(keys).refused;
    }
    PlantKeys found(const profile::StationKeys& keys) const
    {
        return {keys, judged(keys), {}, is_ambiguous_};
    }

    /// The first place of the tags that does; `is_ambiguous_`: another does as well.
    std::optional<profile::StationKeys> with_tags_at(const std::vector<dp::Identifier>& identifiers)
    {
        std::optional<profile::StationKeys> first;
        for (std::size_t at = 0; at + 2 <= dp::kMaxUserPrm; ++at) {
            if (at == profile_.personality.prm.tags_at || !is_place_of_a_tag(at)) continue;
            const profile::StationKeys keys{.tags_at = at, .identifiers = identifiers};
            if (!may_be_taken(keys) || !taken(keys)) continue;
            is_ambiguous_ = first.has_value();
            if (!first) first = keys;
            if (is_ambiguous_) break;
        }
        return first;
    }

    /// Those of the modules that a station can have. It is empty if there is none, or they are the profile's.
    std::vector<dp::Identifier> own_identifiers()
    {
        const std::uint8_t demand = profile_.personality.demand_identifier;
        std::vector<dp::Identifier> all;
        for (const gsd::Module& module : document_.modules) {
            Bytes rest = module.identifiers;
            if (demand != 0 && !rest.empty() && rest[0] == demand) rest = rest.subspan(1);
            while (const auto next = gsd::first_identifier(rest)) {
                const auto identifier = profile::identifier_of(rest.first(next->length));
                if (!identifier)
                    no_identifiers_.push_back(identifier.error());
                else if (std::find(all.begin(), all.end(), *identifier) == all.end())
                    all.push_back(*identifier);
                rest = rest.subspan(next->length);
            }
        }
        return all == profile_.personality.identifiers ? std::vector<dp::Identifier>{} : all;
    }

    const profile::Profile& profile_;
    const gsd::Document& document_;
    const std::optional<std::vector<const gsd::Module*>>& modules_;
    std::vector<std::uint8_t> user_, set_prm_; ///< as the master sends them
    bool is_open_ = false;                     ///< a choice of modules adds to them
    bool is_ambiguous_ = false;
    std::vector<std::string> no_identifiers_;
};

} // namespace

PlantKeys plant_keys(const profile::Profile& profile, const gsd::Document& document,
                     const std::optional<std::vector<const gsd::Module*>>& modules)
{
    return Finder{profile, document, modules}.find();
}

} // namespace dpslave::configurator
