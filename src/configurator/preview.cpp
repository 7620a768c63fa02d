// SPDX-License-Identifier: Apache-2.0
// The octets of a selection, and which of them belong to which parameter.
#include "facts.hpp"

#include "dpslave/base/printable.hpp"

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
    Places(const profile::Profile& profile, bool demand)
        : profile_(profile), before_(demand ? 1 : 0), in_(demand ? dp::kDemandOctets : 0), out_(in_)
    {}

    Json of(const profile::Parameter& parameter)
    {
        const drive::Tag* tag = profile_.tags.find(parameter.tag);
        Json all{{"tag", parameter.tag},
                 {"name", tag != nullptr ? Json(tag->name) : Json()},
                 {"direction", text(parameter.direction)},
                 {"set_prm", place(profile_.personality.prm.tags_at + 2 * count_, 2)},
                 {"chk_cfg", place(before_ + count_, 1)},
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
    std::size_t before_, in_, out_;
    std::size_t count_ = 0;
};

Json finding_of(const profile::Note& note, const std::vector<profile::Parameter>& parameters)
{
    Json finding{{"code", note.code},
                 {"severity", note.refuses ? "error" : "warning"},
                 {"text", printable(note.text)}};
    if (note.at) {
        finding["at"] = *note.at;
        finding["tag"] = parameters[*note.at].tag;
    }
    return finding;
}

} // namespace

Json facts_of(const gsd::IoMap& map)
{
    return {{"fixed", map.fixed},
            {"in_octets", map.in_octets},
            {"out_octets", map.out_octets},
            {"inputs", values_of(map.inputs)},
            {"outputs", values_of(map.outputs)}};
}

std::vector<std::uint8_t> identifiers_of(const gsd::Document& document)
{
    std::vector<std::uint8_t> octets;
    for (const gsd::Module* module : document.plugged())
        octets.insert(octets.end(), module->identifiers.begin(), module->identifiers.end());
    return octets;
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

Json preview_of(const profile::Profile& profile, const profile::Draft& draft, bool demand)
{
    const dp::Personality& personality = profile.personality;
    Places places{profile, demand};
    Json parameters = Json::array(), findings = Json::array();
    for (const profile::Parameter& parameter : draft.parameters) parameters.push_back(places.of(parameter));
    for (const profile::Note& note : draft.notes) findings.push_back(finding_of(note, draft.parameters));
    Json all;
    if (!draft.device.modules.empty()) { // else the selection fits into no telegram
        const std::string file = gsd::write(draft.device);
        const gsd::Document document = gsd::parse(file);
        const gsd::IoMap map = gsd::io_map(document, hints_of(profile));
        all = {{"text", utf8_of_latin1(file)},
               {"set_prm", document.user_prm_data()},
               {"chk_cfg", identifiers_of(document)},
               {"map", facts_of(map)}};
        for (const gsd::Advice& advice : map.advice)
            findings.push_back({{"code", advice.code}, {"severity", "warning"}, {"text", advice.text}});
    }
    all["parameters"] = parameters;
    all["demand"] = demand ? Json({{"chk_cfg", place(0, 1)},
                                   {"in", place(0, dp::kDemandOctets)},
                                   {"out", place(0, dp::kDemandOctets)}})
                           : Json();
    all["used"] = {{"parameters", draft.parameters.size()},
                   {"max_parameters", personality.max_parameters},
                   {"words", places.words()},
                   {"max_words", personality.max_words > 0 ? Json(personality.max_words) : Json()}};
    all["findings"] = findings;
    return all;
}

} // namespace dpslave::configurator
