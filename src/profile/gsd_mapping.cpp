// SPDX-License-Identifier: Apache-2.0
#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/toml/document.hpp"

#include <charconv>

namespace dpslave::profile {
namespace {

std::vector<std::uint16_t> tags_of(toml::Table& table, std::string_view key)
{
    std::vector<std::uint16_t> tags;
    for (const std::int64_t tag : table.integers(key, 1, 0xFFFF).value_or(std::vector<std::int64_t>{}))
        tags.push_back(static_cast<std::uint16_t>(tag));
    return tags;
}

std::optional<std::vector<Parameter>> list_of(toml::Table& table)
{
    const auto texts = table.texts("list", 0);
    if (!texts) return std::nullopt;
    std::vector<Parameter> list;
    for (const std::string& one : *texts) {
        if (const auto parameter = parse_parameter(one))
            list.push_back(*parameter);
        else
            table.refuse("list",
                         "\"" + one +
                             "\" is no parameter: write in:1, out:1 or in-out:1, with the number of the "
                             "tag for 1.");
    }
    for (const char* key : {"in", "out", "in_out"})
        if (table.has(key))
            table.refuse(key,
                         "'" + std::string{key} + "' and 'list' both name parameters: keep one of them.");
    return list;
}

/// [table]: what is wrong within its rows is named with their own lines.
std::optional<OwnTable> table_of(toml::Table table, const std::string& file, toml::Faults& faults)
{
    if (!table.exists()) return std::nullopt;
    table.require("file", R"(file = "mine.csv")");
    table.require("rows", R"(rows = """ and the lines of the table)");
    const auto name = table.text("file");
    const auto rows = table.lines("rows");
    if (!name || !rows) return std::nullopt;
    if (const auto tags = read_tags(*rows, file + " [table]"); !tags)
        faults.insert(faults.end(), tags.error().begin(), tags.error().end());
    return OwnTable{*name, *rows};
}

} // namespace

std::string_view text(Direction direction) noexcept
{
    switch (direction) {
        case Direction::in: return "in";
        case Direction::out: return "out";
        case Direction::in_out: break;
    }
    return "in-out";
}

std::string to_string(const Parameter& parameter)
{
    return std::string{text(parameter.direction)} + ':' + std::to_string(parameter.tag);
}

std::optional<Parameter> parse_parameter(std::string_view text_of_it)
{
    const auto colon = text_of_it.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string_view number = text_of_it.substr(colon + 1);
    std::uint16_t tag = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), tag);
    if (error != std::errc{} || end != number.data() + number.size() || tag == 0) return std::nullopt;
    for (const Direction direction : {Direction::in, Direction::out, Direction::in_out})
        if (text(direction) == text_of_it.substr(0, colon)) return Parameter{direction, tag};
    return std::nullopt;
}

std::vector<Parameter> Selection::parameters() const
{
    std::vector<Parameter> all;
    for (const std::uint16_t tag : in) all.push_back({Direction::in, tag});
    for (const std::uint16_t tag : out) all.push_back({Direction::out, tag});
    for (const std::uint16_t tag : in_out) all.push_back({Direction::in_out, tag});
    if (list) all.insert(all.end(), list->begin(), list->end());
    return all;
}

bool Selection::says_parameters() const
{
    return list || !in.empty() || !out.empty() || !in_out.empty();
}

Result<Mapping, toml::Faults> load_mapping(const toml::TextSource& source, const std::string& file)
{
    toml::Document document{source, file};
    toml::Faults of_rows;
    Mapping mapping;
    if (document.readable()) {
        toml::Table root = document.root();
        root.require("profile", R"(profile = "2408f")");
        mapping.profile = root.text("profile").value_or("");
        Selection& selection = mapping.selection;
        selection.in = tags_of(root, "in");
        selection.out = tags_of(root, "out");
        selection.in_out = tags_of(root, "in_out");
        selection.list = list_of(root);
        selection.demand = root.boolean("demand").value_or(false);
        if (const auto ident = root.integer("ident", 1, 0xFFFF))
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (const auto bits = root.integer("max_tsdr", 11, 0xFFFF))
            selection.max_tsdr = static_cast<std::uint32_t>(*bits);
        selection.description = root.text("description");
        selection.model = root.text("model");
        mapping.table = table_of(root.table("table"), file, of_rows);
    }
    toml::Faults faults = document.faults();
    faults.insert(faults.end(), of_rows.begin(), of_rows.end());
    cap(faults);
    if (!faults.empty()) return Failure{std::move(faults)};
    return mapping;
}

} // namespace dpslave::profile
