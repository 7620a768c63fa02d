// SPDX-License-Identifier: Apache-2.0
#include "mapping.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/wording.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

/// Reads the keys of a mapping; the first that is wrong is remembered.
class MappingReader {
public:
    explicit MappingReader(const Json& keys) : keys_(keys) {}

    Result<profile::Mapping, WrongKey> read()
    {
        profile::Mapping mapping;
        profile::Selection& selection = mapping.selection;
        mapping.profile = text("profile").value_or("");
        if (mapping.profile.empty()) wrong("profile", "the name of a profile");
        selection.list = list();
        selection.tags = tags();
        if (selection.tags && selection.list) wrong("tags", "left out beside \"list\"");
        selection.tags_at = number("tags_at", 0);
        selection.identifiers = identifiers();
        selection.modules = modules();
        selection.lengths = {.user_prm_data = number("user_prm_data_len", 0),
                             .max_module = number("max_module", 0),
                             .max_input = number("max_input_len", 0),
                             .max_output = number("max_output_len", 0),
                             .max_data = number("max_data_len", 0)};
        selection.demand = flag("demand");
        if (const auto ident = number("ident", 1)) selection.ident = static_cast<std::uint16_t>(*ident);
        selection.max_tsdr = number("max_tsdr", 11);
        selection.description = text("description");
        selection.model = text("model");
        if (!sentence_.empty()) return Failure{WrongKey{key_, std::move(sentence_)}};
        return mapping;
    }

private:
    void wrong(const char* key, const std::string& wanted)
    {
        if (!sentence_.empty()) return;
        key_ = key;
        sentence_ = '"' + std::string{key} + "\" of the mapping has to be " + wanted + '.';
    }

    const Json* value(const char* key) const
    {
        const auto found = keys_.find(key);
        return found == keys_.end() || found->is_null() ? nullptr : &*found;
    }

    std::optional<std::string> text(const char* key)
    {
        const Json* found = value(key);
        if (found == nullptr) return std::nullopt;
        if (!found->is_string()) {
            wrong(key, "a text");
            return std::nullopt;
        }
        auto text = found->get<std::string>();
        if (input::has_control_characters(text)) wrong(key, "a text without control characters");
        if (text.empty()) return std::nullopt;
        return text;
    }

    bool flag(const char* key)
    {
        const Json* found = value(key);
        if (found == nullptr) return false;
        if (!found->is_boolean()) wrong(key, "true or false");
        return found->is_boolean() && found->get<bool>();
    }

    std::optional<std::uint32_t> number(const char* key, std::uint64_t min)
    {
        const Json* found = value(key);
        if (found == nullptr) return std::nullopt;
        if (found->is_number_unsigned())
            if (const auto number = found->get<std::uint64_t>(); number >= min && number <= 0xFFFF)
                return static_cast<std::uint32_t>(number);
        wrong(key, "a number from " + std::to_string(min) + " to 65535");
        return std::nullopt;
    }

    std::optional<std::vector<profile::GsdParameter>> list()
    {
        const Json* found = value("list");
        if (found == nullptr) return std::nullopt;
        std::vector<profile::GsdParameter> all;
        if (!found->is_array()) wrong("list", "a list");
        for (const Json& one : *found) {
            const auto parameter =
                one.is_string() ? profile::parse_parameter(one.get<std::string>()) : std::nullopt;
            if (parameter)
                all.push_back(*parameter);
            else
                wrong("list", "a list of texts such as \"in:1\", \"out:1\" or \"in-out:1\"");
        }
        return all;
    }

    std::optional<std::vector<std::uint16_t>> tags()
    {
        const Json* found = value("tags");
        if (found == nullptr) return std::nullopt;
        std::vector<std::uint16_t> all;
        if (!found->is_array()) wrong("tags", "a list");
        for (const Json& one : *found) {
            const auto tag = one.is_number_unsigned() ? one.get<std::uint64_t>() : 0;
            if (tag == 0 || tag > 0xFFFF) wrong("tags", "a list of tags from 1 to 65535");
            all.push_back(static_cast<std::uint16_t>(tag));
        }
        return all;
    }

    std::vector<dp::Identifier> identifiers()
    {
        std::vector<dp::Identifier> all;
        const Json* found = value("identifiers");
        if (found == nullptr) return all;
        if (!found->is_array()) wrong("identifiers", "a list");
        for (const Json& one : *found) {
            const auto identifier = profile::read_identifier(one.is_string() ? one.get<std::string>() : "");
            if (identifier)
                all.push_back(*identifier);
            else
                wrong("identifiers", "a list of identifiers: " + identifier.error());
        }
        return all;
    }

    std::vector<profile::PlantModule> modules()
    {
        std::vector<profile::PlantModule> all;
        const Json* found = value("modules");
        if (found == nullptr) return all;
        if (!found->is_array()) wrong("modules", "a list");
        for (const Json& one : *found) {
            const bool is_whole = one.is_object() && one.value("name", Json()).is_string() &&
                                  one.value("identifiers", Json()).is_string();
            auto octets =
                is_whole ? profile::read_hex_octets(one["identifiers"].get<std::string>()) : std::nullopt;
            if (!octets) {
                wrong("modules", "a list of objects with \"name\" and \"identifiers\" such as \"50 60\"");
                continue;
            }
            const Json preset = one.value("preset", Json(false));
            all.push_back({one["name"].get<std::string>(), *std::move(octets),
                           preset.is_boolean() && preset.get<bool>()});
        }
        return all;
    }

    const Json& keys_;
    std::string key_, sentence_;
};

/// A basic string of TOML with several lines. Ends of lines become those of Unix.
std::string toml_lines(std::string_view text)
{
    std::string out = "\"\"\"\n";
    std::size_t quotes = 0; // the third one in a row would end the string
    for (const char c : text) {
        if (c == '\r') continue; // part of the end of a line: a table has no other
        quotes = c == '"' ? quotes + 1 : 0;
        if (c == '\\' || quotes == 3) out += '\\';
        if (quotes == 3) quotes = 0;
        out += c;
    }
    return out + (out.ends_with('\n') ? "" : "\n") + "\"\"\"\n";
}

/// A basic string of TOML.
std::string toml_text(std::string_view text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + '"';
}

std::string parameters_of(const std::vector<profile::GsdParameter>& parameters, const drive::TagTable& tags)
{
    if (parameters.empty()) return "list = []\n";
    std::string out = "list = [\n";
    for (const profile::GsdParameter& parameter : parameters) {
        const drive::Tag* tag = tags.find(parameter.tag);
        out += "  \"" + to_string(parameter) + "\",";
        if (tag != nullptr && !tag->name.empty()) out += " # " + printable(tag->name);
        out += '\n';
    }
    return out + "]\n";
}

/// Their directions are in the master's project.
std::string tags_of(const std::vector<std::uint16_t>& numbers, const drive::TagTable& tags)
{
    std::string out = "tags = [\n";
    for (const std::uint16_t number : numbers) {
        const drive::Tag* tag = tags.find(number);
        out += "  " + std::to_string(number) + ',';
        if (tag != nullptr && !tag->name.empty()) out += " # " + printable(tag->name);
        out += '\n';
    }
    return out + "]\n";
}

/// Adds the keys in which the plant's own GSD differs from the profile.
void put_plant_keys(std::string& out, const profile::Selection& selection)
{
    const auto put = [&](const char* key, const auto& number) {
        if (number) out += std::string{key} + " = " + std::to_string(*number) + '\n';
    };
    put("tags_at", selection.tags_at);
    std::string identifiers;
    for (const dp::Identifier& one : selection.identifiers)
        identifiers += (identifiers.empty() ? "" : ", ") + toml_text(profile::to_string(one));
    if (!identifiers.empty()) out += "identifiers = [" + identifiers + "]\n";
    put("user_prm_data_len", selection.lengths.user_prm_data);
    put("max_module", selection.lengths.max_module);
    put("max_input_len", selection.lengths.max_input);
    put("max_output_len", selection.lengths.max_output);
    put("max_data_len", selection.lengths.max_data);
}

} // namespace

Result<profile::Mapping, WrongKey> read_mapping(const Json& request)
{
    const auto found = request.find("mapping");
    if (found == request.end() || !found->is_object())
        return Failure{WrongKey{"", "\"mapping\" has to be an object."}};
    return MappingReader{*found}.read();
}

void put_mapping_file(Outcome& outcome, const profile::Mapping& mapping, const drive::TagTable& tags)
{
    const profile::Selection& selection = mapping.selection;
    std::string out = "profile = " + toml_text(mapping.profile) + '\n';
    if (selection.ident) out += "ident = " + hex_of(*selection.ident) + '\n';
    if (selection.max_tsdr) out += "max_tsdr = " + std::to_string(*selection.max_tsdr) + '\n';
    if (selection.model) out += "model = " + toml_text(*selection.model) + '\n';
    if (selection.description) out += "description = " + toml_text(*selection.description) + '\n';
    if (selection.demand) out += "demand = true\n";
    put_plant_keys(out, selection);
    if (selection.says_parameters()) out += parameters_of(selection.parameters(), tags);
    if (selection.tags) out += tags_of(*selection.tags, tags);
    for (const profile::PlantModule& module : selection.modules)
        out += "\n[[module]]\nname = " + toml_text(module.name) +
               "\nidentifiers = " + toml_text(profile::hex_octets(module.identifiers)) + '\n' +
               (module.preset ? "preset = true\n" : "");
    if (mapping.table)
        out += "\n[table]\nfile = " + toml_text(printable(mapping.table->name)) +
               "\nrows = " + toml_lines(mapping.table->text);
    if (out.size() <= kMostOctets) {
        outcome.octets = std::move(out);
        return;
    }
    outcome.exit = kNo;
    outcome.refusals.emplace_back(
        "the mapping with its tag table is larger than 1 MiB and could not be read again: remove rows or columns of the table.");
}

} // namespace dpslave::configurator
