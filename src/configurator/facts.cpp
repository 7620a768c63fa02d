// SPDX-License-Identifier: Apache-2.0
#include "facts.hpp"

#include "dpslave/base/printable.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

Json list_of(const std::vector<profile::GsdParameter>& parameters)
{
    Json list = Json::array();
    for (const profile::GsdParameter& parameter : parameters) list.push_back(to_string(parameter));
    return list;
}

std::string name_of(const std::string& path)
{
    return path.substr(path.rfind('/') + 1); // npos + 1 is 0
}

std::string_view name_of(drive::Access access)
{
    switch (access) {
        case drive::Access::unknown: return "unknown";
        case drive::Access::read_only: return "read_only";
        case drive::Access::read_write: return "read_write";
        case drive::Access::write_only: break;
    }
    return "write_only";
}

Json lists_of(const dp::Personality& personality)
{
    Json lists = Json::array();
    for (const auto& [reads, writes, name] :
         {std::tuple{true, false, "in"}, std::tuple{false, true, "out"}, std::tuple{true, true, "in-out"}})
        if (std::any_of(personality.identifiers.begin(), personality.identifiers.end(),
                        [&, r = reads, w = writes](const dp::Identifier& each) {
                            return each.reads == r && each.writes == w;
                        }))
            lists.push_back(name);
    return lists;
}

} // namespace

std::string text_of(const Json& value)
{
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string not_read(const gsd::Document& document)
{
    const gsd::Remark& why = document.not_read;
    return why.line == 0 ? why.what : "line " + std::to_string(why.line) + ": " + why.what;
}

Json findings_of(const gsd::Findings& findings)
{
    Json all = Json::array();
    for (const gsd::Finding& finding : findings)
        all.push_back({{"severity", finding.severity == gsd::Severity::error ? "error" : "warning"},
                       {"line", finding.line},
                       {"text", printable(finding.what)}});
    return all;
}

void add_mapping(Json& facts, const profile::Mapping& mapping)
{
    const profile::Selection& selection = mapping.selection;
    Json all{{"profile", mapping.profile}, {"demand", selection.demand}};
    if (selection.says_parameters()) all["list"] = list_of(selection.parameters());
    if (selection.ident) all["ident"] = *selection.ident;
    if (selection.max_tsdr) all["max_tsdr"] = *selection.max_tsdr;
    if (selection.description) all["description"] = *selection.description;
    if (selection.model) all["model"] = *selection.model;
    if (selection.tags) all["tags"] = *selection.tags;
    if (selection.tags_at) all["tags_at"] = *selection.tags_at;
    for (const dp::Identifier& one : selection.identifiers)
        all["identifiers"].push_back(profile::to_string(one));
    for (const profile::PlantModule& module : selection.modules)
        all["modules"].push_back({{"name", module.name},
                                  {"identifiers", profile::hex_octets(module.identifiers)},
                                  {"preset", module.preset}});
    const profile::PlantLengths& lengths = selection.lengths;
    for (const auto& [key, length] :
         {std::pair{"user_prm_data_len", lengths.user_prm_data}, std::pair{"max_module", lengths.max_module},
          std::pair{"max_input_len", lengths.max_input}, std::pair{"max_output_len", lengths.max_output},
          std::pair{"max_data_len", lengths.max_data}})
        if (length) all[key] = *length;
    facts["mapping"] = all;
    if (!mapping.table) return;
    facts["table"] = mapping.table->text;
    facts["table_name"] = mapping.table->name;
}

Json profile_of(const profile::Profile& profile)
{
    const dp::Personality& personality = profile.personality;
    profile::Selection own;
    own.in = profile.gsd.in_tags;
    own.out = profile.gsd.out_tags;
    Json rates = Json::array();
    for (const Baud baud : kBauds)
        if (const Tbit bits = personality.max_tsdr[index_of(baud)]; bits.count > 0)
            rates.push_back({{"baud", static_cast<std::uint32_t>(baud)}, {"bits", bits.count}});
    return {{"name", profile.name},
            {"device", profile.device},
            {"model", profile.gsd.model},
            {"manual", profile.manual},
            {"ident", profile.ident ? Json(*profile.ident) : Json()},
            {"file", profile.gsd.file},
            {"table", name_of(profile.tag_file)},
            {"own_table", !profile.tags.all().empty() && name_of(profile.tag_file) != "example.csv"},
            {"min_address", profile.min_address},
            {"max_address", profile.max_address},
            {"protocols", profile.protocols},
            {"max_parameters", personality.max_parameters},
            {"max_words", personality.max_words > 0 ? Json(personality.max_words) : Json()},
            {"demand", personality.demand_identifier != 0},
            {"max_tag", personality.prm.max_tag},
            {"may_have_no_parameters", personality.may_have_no_parameters},
            {"lists", lists_of(personality)},
            {"no_tags", personality.prm.list == dp::TagList::none},
            {"only_listed_tags", profile.tags_only_from_table},
            {"default_list", list_of(own.parameters())},
            {"max_tsdr", rates}};
}

Json tag_of(const profile::Profile& profile, const drive::Tag& tag)
{
    Json labels = Json::array();
    for (const drive::Label& label : tag.labels)
        labels.push_back({{"bit", label.is_bit}, {"number", label.number}, {"text", label.text}});
    const bool never = std::find(profile.never_written.begin(), profile.never_written.end(), tag.number) !=
                       profile.never_written.end();
    const bool legal = tag.number <= profile.personality.prm.max_tag;
    const auto optional = [](const auto& value) { return value ? Json(*value) : Json(); };
    return {{"number", tag.number},
            {"name", tag.name},
            {"mnemonic", tag.mnemonic},
            {"aliases", tag.aliases},
            {"section", tag.section},
            {"type", drive::type_name(tag)},
            {"decimals", tag.decimals_known ? Json(tag.decimals) : Json()},
            {"follows_display", tag.follows_display},
            {"scaled", drive::has_scale(tag)},
            {"access", name_of(tag.access)},
            {"writable",
             legal && !never && tag.access != drive::Access::read_only && tag.type != drive::TagType::string},
            {"when", drive::text(tag.when)},
            {"never_written", never},
            {"min", optional(tag.min)},
            {"max", optional(tag.max)},
            {"labels", labels},
            {"notes", tag.notes},
            {"demand", legal ? Json(tag.number) : Json()},
            {"status_word", tag.type == drive::TagType::word}};
}

std::string hex_of(std::uint32_t word)
{
    std::string digits;
    for (; word > 0 || digits.size() < 4; word >>= 4U)
        digits.insert(digits.begin(), "0123456789ABCDEF"[word & 15U]);
    return "0x" + digits;
}

std::string utf8_of_latin1(std::string_view octets)
{
    std::string out;
    for (const char c : octets) {
        const auto octet = static_cast<std::uint8_t>(c);
        if (octet >= 0x80) out += static_cast<char>(0xC0U | octet >> 6U);
        out += static_cast<char>(octet >= 0x80 ? 0x80U | (octet & 0x3FU) : octet);
    }
    return out;
}

} // namespace dpslave::configurator
