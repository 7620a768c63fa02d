// SPDX-License-Identifier: Apache-2.0
#include "gsd_facts.hpp"

#include "needed.hpp"

#include "dpslave/gsd/device.hpp"

#include <algorithm>

namespace dpslave::profile {
namespace {

class FactsReader {
public:
    FactsReader(input::Table& table, const Profile& profile) : table_(table), profile_(profile) {}

    GsdFacts read()
    {
        facts_.vendor = needed("vendor", R"(vendor = "EUROTHERM")");
        facts_.model = needed("model", R"(model = "the name in the master's device list")");
        facts_.revision = needed("revision", R"(revision = "Revision_1")");
        facts_.hardware = needed("hardware", R"(hardware = "HW_V1.0")");
        facts_.software = needed("software", R"(software = "SW_V1.0")");
        facts_.description = table_.text("description").value_or("");
        judge_text("description", facts_.description, gsd::kMaxDescription);
        needed_integer(table_, "min_slave_interval", 1, 0xFFFF, facts_.min_slave_interval);
        if (const auto family = table_.integer("family", 0, 255))
            facts_.family = static_cast<std::uint8_t>(*family);
        if (const auto repeater = table_.integer("repeater", 0, 2))
            facts_.repeater = static_cast<std::uint8_t>(*repeater);
        modules();
        file();
        mapping();
        return std::move(facts_);
    }

private:
    std::string needed(std::string_view key, std::string_view example)
    {
        std::string text = needed_text(table_, key, example);
        judge_text(key, text, gsd::kMaxText);
        return text;
    }

    void judge_text(std::string_view key, std::string_view text, std::size_t longest)
    {
        const bool plain = std::all_of(text.begin(), text.end(),
                                       [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\\'; });
        if (!plain || text.size() > longest)
            table_.refuse(key, "'" + std::string{key} + "' goes into the GSD: write at most " +
                                   std::to_string(longest) +
                                   " letters, digits and signs of ASCII, without quotes and backslashes.");
    }

    bool any_identifier(bool reads, bool writes) const
    {
        const auto& known = profile_.personality.identifiers;
        return std::any_of(known.begin(), known.end(), [&](const dp::Identifier& identifier) {
            return identifier.reads == reads && identifier.writes == writes;
        });
    }

    /// A name that no identifier uses is no fault: it waits for one.
    std::string module(std::string_view key, bool is_used)
    {
        if (is_used) table_.require(key, std::string{key} + R"( = "name of the module")");
        std::string name = table_.text(key).value_or("");
        judge_text(key, name, gsd::kMaxText);
        return name;
    }

    void modules()
    {
        facts_.demand_module = module("demand_module", profile_.personality.demand_identifier != 0);
        facts_.in_module = module("in_module", any_identifier(true, false));
        facts_.out_module = module("out_module", any_identifier(false, true));
        facts_.in_out_module = module("in_out_module", any_identifier(true, true));
    }

    void file()
    {
        facts_.file = table_.text("file").value_or("");
        if (facts_.file.empty()) return;
        if (!is_name_of_a_file(facts_.file))
            table_.refuse("file", "'file' must be the name of a file, without a folder.");
    }

    std::vector<std::uint16_t> tags(std::string_view key)
    {
        std::vector<std::uint16_t> out;
        for (const std::int64_t tag :
             table_.integers(key, 1, profile_.personality.prm.max_tag).value_or(std::vector<std::int64_t>{}))
            out.push_back(static_cast<std::uint16_t>(tag));
        return out;
    }

    void mapping()
    {
        const dp::Personality& personality = profile_.personality;
        facts_.in_tags = tags("in_tags");
        facts_.out_tags = tags("out_tags");
        const std::size_t count = facts_.in_tags.size() + facts_.out_tags.size();
        if (count > personality.max_parameters)
            table_.refuse(facts_.in_tags.empty() ? "out_tags" : "in_tags",
                          "'in_tags' and 'out_tags' name " + std::to_string(count) +
                              " tags together, 'max_parameters' allows " +
                              std::to_string(personality.max_parameters) + ".");
    }

    input::Table& table_;
    const Profile& profile_;
    GsdFacts facts_;
};

} // namespace

GsdFacts read_gsd_facts(input::Table& table, const Profile& profile)
{
    return FactsReader{table, profile}.read();
}

} // namespace dpslave::profile
