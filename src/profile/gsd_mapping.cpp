// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/toml/document.hpp"

namespace dpslave::profile {
namespace {

std::vector<std::uint16_t> tags_of(toml::Table& table, std::string_view key)
{
    std::vector<std::uint16_t> tags;
    for (const std::int64_t tag : table.integers(key, 1, 0xFFFF).value_or(std::vector<std::int64_t>{}))
        tags.push_back(static_cast<std::uint16_t>(tag));
    return tags;
}

} // namespace

Result<Mapping, toml::Faults> load_mapping(const toml::TextSource& source, const std::string& file)
{
    toml::Document document{source, file};
    Mapping mapping;
    if (document.readable()) {
        toml::Table root = document.root();
        root.require("profile", R"(profile = "2408f")");
        mapping.profile = root.text("profile").value_or("");
        Selection& selection = mapping.selection;
        selection.in = tags_of(root, "in");
        selection.out = tags_of(root, "out");
        selection.in_out = tags_of(root, "in_out");
        selection.demand = root.boolean("demand").value_or(false);
        if (const auto ident = root.integer("ident", 1, 0xFFFF))
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (const auto bits = root.integer("max_tsdr", 11, 0xFFFF))
            selection.max_tsdr = static_cast<std::uint32_t>(*bits);
        selection.description = root.text("description");
        selection.model = root.text("model");
    }
    toml::Faults faults = document.faults();
    if (!faults.empty()) return Failure{std::move(faults)};
    return mapping;
}

} // namespace dpslave::profile
