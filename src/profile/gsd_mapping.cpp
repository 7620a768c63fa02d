// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/number.hpp"
#include "dpslave/input/document.hpp"
#include "dpslave/profile/gsd_device.hpp"

namespace dpslave::profile {
namespace {

std::vector<std::uint16_t> tags_of(input::Table& table, std::string_view key)
{
    std::vector<std::uint16_t> tags;
    for (const std::int64_t tag : table.integers(key, 1, 0xFFFF).value_or(std::vector<std::int64_t>{}))
        tags.push_back(static_cast<std::uint16_t>(tag));
    return tags;
}

std::optional<std::vector<GsdParameter>> list_of(input::Table& table)
{
    const auto texts = table.texts("list", 0);
    if (!texts) return std::nullopt;
    std::vector<GsdParameter> list;
    for (const std::string& one : *texts) {
        if (const auto parameter = parse_parameter(one))
            list.push_back(*parameter);
        else
            table.refuse(
                "list",
                "\"" + one +
                    "\" is no parameter: write in:1, out:1 or in-out:1, with the number of the tag for 1.");
    }
    for (const char* key : {"in", "out", "in_out"})
        if (table.has(key))
            table.refuse(key,
                         "'" + std::string{key} + "' and 'list' both name parameters: keep one of them.");
    return list;
}

std::optional<std::vector<std::uint16_t>> open_tags_of(input::Table& table)
{
    if (!table.has("tags")) return std::nullopt;
    for (const char* key : {"in", "out", "in_out", "list"})
        if (table.has(key))
            table.refuse(key, "'tags' leaves the directions to the master's modules, and '" +
                                  std::string{key} + "' says them: keep one of them.");
    return tags_of(table, "tags");
}

std::vector<dp::Identifier> identifiers_of(input::Table& table)
{
    std::vector<dp::Identifier> all;
    for (const std::string& text : table.texts("identifiers").value_or(std::vector<std::string>{}))
        if (const auto identifier = read_identifier(text))
            all.push_back(*identifier);
        else
            table.refuse("identifiers", identifier.error());
    return all;
}

std::vector<PlantModule> modules_of(input::Table& root)
{
    std::vector<PlantModule> all;
    for (input::Table& table : root.tables("module")) {
        table.require("name", R"(name = "Speed in")");
        table.require("identifiers", R"(identifiers = "50 60")");
        PlantModule module{.name = table.text("name").value_or(""),
                           .preset = table.boolean("preset").value_or(false)};
        const auto text = table.text("identifiers");
        if (auto octets = text ? read_hex_octets(*text) : std::nullopt)
            module.identifiers = *std::move(octets);
        else if (text)
            table.refuse("identifiers",
                         '"' + *text + "\" is no list of octets in hexadecimal: write \"50 60\".");
        all.push_back(std::move(module));
    }
    return all;
}

PlantLengths lengths_of(input::Table& table)
{
    const auto length = [&](const char* key, std::int64_t most) -> std::optional<std::uint32_t> {
        const auto number = table.integer(key, 0, most);
        return number ? std::optional{static_cast<std::uint32_t>(*number)} : std::nullopt;
    };
    return {.user_prm_data = length("user_prm_data_len", dp::kMaxUserPrm),
            .max_module = length("max_module", 0xFF),
            .max_input = length("max_input_len", 0xFF),
            .max_output = length("max_output_len", 0xFF),
            .max_data = length("max_data_len", 0xFFFF)};
}

/// [table]: what is wrong within its rows is named with their own lines.
std::optional<OwnTable> table_of(input::Table table, const std::string& file, input::Faults& faults)
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

std::string to_string(const GsdParameter& parameter)
{
    return std::string{text(parameter.direction)} + ':' + std::to_string(parameter.tag);
}

std::optional<GsdParameter> parse_parameter(std::string_view text_of_it)
{
    const auto colon = text_of_it.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto tag = read_number(text_of_it.substr(colon + 1), 1, 0xFFFF);
    if (!tag) return std::nullopt;
    for (const Direction direction : {Direction::in, Direction::out, Direction::in_out})
        if (text(direction) == text_of_it.substr(0, colon))
            return GsdParameter{direction, static_cast<std::uint16_t>(*tag)};
    return std::nullopt;
}

std::vector<GsdParameter> Selection::parameters() const
{
    std::vector<GsdParameter> all;
    for (const std::uint16_t tag : in) all.push_back({Direction::in, tag});
    for (const std::uint16_t tag : out) all.push_back({Direction::out, tag});
    for (const std::uint16_t tag : in_out) all.push_back({Direction::in_out, tag});
    if (list) all.insert(all.end(), list->begin(), list->end());
    return all;
}

StationKeys Selection::keys() const
{
    return {.ident = ident, .tags_at = tags_at, .identifiers = identifiers};
}

bool Selection::says_parameters() const
{
    return list || !in.empty() || !out.empty() || !in_out.empty();
}

Result<Mapping, input::Faults> load_mapping(const input::TextSource& source, const std::string& file)
{
    input::Document document{source, file};
    input::Faults of_rows;
    Mapping mapping;
    if (document.readable()) {
        input::Table root = document.root();
        root.require("profile", R"(profile = "2408f")");
        mapping.profile = root.text("profile").value_or("");
        Selection& selection = mapping.selection;
        selection.in = tags_of(root, "in");
        selection.out = tags_of(root, "out");
        selection.in_out = tags_of(root, "in_out");
        selection.list = list_of(root);
        selection.tags = open_tags_of(root);
        selection.demand = root.boolean("demand").value_or(false);
        if (const auto ident = root.integer("ident", 1, 0xFFFF))
            selection.ident = static_cast<std::uint16_t>(*ident);
        if (const auto bits = root.integer("max_tsdr", 11, 0xFFFF))
            selection.max_tsdr = static_cast<std::uint32_t>(*bits);
        selection.description = root.text("description");
        selection.model = root.text("model");
        if (const auto at = root.integer("tags_at", 0, dp::kMaxUserPrm - 2))
            selection.tags_at = static_cast<std::size_t>(*at);
        selection.identifiers = identifiers_of(root);
        selection.lengths = lengths_of(root);
        selection.modules = modules_of(root);
        mapping.table = table_of(root.table("table"), file, of_rows);
    }
    input::Faults faults = document.faults();
    faults.insert(faults.end(), of_rows.begin(), of_rows.end());
    cap(faults);
    if (!faults.empty()) return Failure{std::move(faults)};
    return mapping;
}

} // namespace dpslave::profile
