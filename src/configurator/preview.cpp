// SPDX-License-Identifier: Apache-2.0
// The octets of a selection, and which of them belong to which parameter.
#include "coded_finding.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/sent.hpp"

namespace dpslave::configurator {
namespace {

Json place(std::size_t first, std::size_t count)
{
    return Json::array({first, count});
}

Json values_of(const std::vector<gsd::IoValue>& values)
{
    Json all = Json::array();
    for (const gsd::IoValue& value : values)
        all.push_back({{"octet", value.octet},
                       {"octets", value.octets},
                       {"what", printable(value.what)},
                       {"tag", value.tag ? Json(*value.tag) : Json()},
                       {"demand", value.is_demand}});
    return all;
}

/// The parameters with their places, in the order of the telegrams.
class Places {
public:
    Places(const profile::Profile& profile, const profile::Draft& draft, bool demand)
        : profile_(profile), draft_(draft), in_(demand ? dp::kDemandOctets : 0), out_(in_)
    {}

    Json of(const profile::GsdParameter& parameter)
    {
        const drive::Tag* tag = profile_.tags.find(parameter.tag);
        const auto& cfg = draft_.cfg_places;
        Json all{{"tag", parameter.tag},
                 {"name", tag != nullptr ? Json(tag->name) : Json()},
                 {"direction", text(parameter.direction)},
                 {"set_prm", place(draft_.tags_at + 2 * count_, 2)},
                 {"chk_cfg", count_ < cfg.size() ? place(cfg[count_].first, cfg[count_].second) : Json()},
                 {"in", parameter.direction == profile::Direction::out ? Json() : next(in_)},
                 {"out", parameter.direction == profile::Direction::in ? Json() : next(out_)}};
        ++count_;
        return all;
    }

    std::size_t words() const { return (in_ + out_) / 2; }

private:
    static Json next(std::size_t& at)
    {
        at += 2;
        return place(at - 2, 2);
    }

    const profile::Profile& profile_;
    const profile::Draft& draft_;
    std::size_t in_, out_;
    std::size_t count_ = 0;
};

} // namespace

Json facts_of(const gsd::IoMap& map)
{
    return {{"fixed", map.fixed},
            {"in_octets", map.in_octets},
            {"out_octets", map.out_octets},
            {"inputs", values_of(map.inputs)},
            {"outputs", values_of(map.outputs)}};
}

gsd::MapHints hints_of(const profile::Profile& profile)
{
    gsd::MapHints hints;
    hints.tags_at = profile.personality.prm.tags_at;
    hints.demand_identifier = profile.personality.demand_identifier;
    hints.extended_tags = profile.personality.demand == dp::DemandForm::extended;
    for (const drive::Tag& tag : profile.tags.all()) hints.names.emplace(tag.number, tag.name);
    return hints;
}

Json preview_of(const profile::Profile& profile, const profile::Draft& draft, bool demand,
                std::string_view name)
{
    const dp::Personality& personality = profile.personality;
    Places places{profile, draft, demand};
    Json parameters = Json::array();
    for (const profile::GsdParameter& parameter : draft.parameters)
        parameters.push_back(places.of(parameter));
    Json all;
    std::optional<gsd::Document> document; // nullopt: the selection fits into no telegram
    if (!draft.device.modules.empty()) {
        const std::string file = gsd::write(draft.device);
        document = gsd::parse(file);
        gsd::MapHints hints = hints_of(profile);
        hints.tags_at = draft.tags_at;
        const gsd::Sent sent = gsd::sent_by_master(*document, gsd::plugged_modules(*document));
        all = {{"text", utf8_of_latin1(file)},
               {"set_prm", sent.user.octets},
               {"chk_cfg", sent.cfg.octets},
               {"map", facts_of(gsd::io_map(*document, hints))}};
    }
    all["parameters"] = parameters;
    all["demand"] = demand ? Json({{"chk_cfg", place(0, 1)},
                                   {"in", place(0, dp::kDemandOctets)},
                                   {"out", place(0, dp::kDemandOctets)}})
                           : Json();
    Json rates = Json::array();
    for (const Baud baud : kBauds)
        if (const Tbit bits = draft.device.max_tsdr[index_of(baud)]; bits.count > 0)
            rates.push_back({{"baud", static_cast<std::uint32_t>(baud)}, {"bits", bits.count}});
    all["max_tsdr"] = rates;
    all["used"] = {{"parameters", draft.parameters.size()},
                   {"max_parameters", personality.max_parameters},
                   {"words", places.words()},
                   {"max_words", personality.max_words > 0 ? Json(personality.max_words) : Json()}};
    all["findings"] =
        facts_of(coded_findings(draft, document ? &*document : nullptr, gsd::Reading::tolerant, name));
    return all;
}

} // namespace dpslave::configurator
