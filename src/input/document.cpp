// SPDX-License-Identifier: Apache-2.0
// This is the only file that uses toml++: the result of the parser is copied into plain nodes, each with its
// place.
#include "dpslave/input/document.hpp"

#include "node.hpp"
#include "prescan.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/wording.hpp"

#define TOML_EXCEPTIONS 0 // one way for both builds: the WebAssembly of the configurator has no exceptions
#include <toml++/toml.h>

#include <algorithm>

namespace dpslave::input {
namespace {

Place place_of(const ::toml::source_region& region)
{
    return {region.begin.line, region.begin.column};
}

Node convert(const ::toml::table& table, const std::string& path, bool of_array);

Value convert(const ::toml::node& node, const std::string& path, bool of_array)
{
    Value value{place_of(node.source()), Other{}};
    if (const auto* table = node.as_table()) {
        value.held = convert(*table, path, of_array);
    } else if (const auto* array = node.as_array()) {
        std::vector<Value> items;
        for (const ::toml::node& item : *array) items.push_back(convert(item, path, true));
        value.held = std::move(items);
    } else if (const auto* text = node.as_string()) {
        value.held = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.held = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
        value.held = real->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.held = boolean->get();
    }
    return value;
}

Node convert(const ::toml::table& table, const std::string& path, bool of_array)
{
    Node node;
    node.title = (of_array ? "[[" : "[") + path + (of_array ? "]]" : "]");
    node.place = place_of(table.source());
    for (const auto& [key, child] : table) {
        const std::string name{key.str()};
        node.entries.push_back(
            {name, place_of(key.source()), convert(child, path.empty() ? name : path + "." + name, false)});
    }
    return node;
}

bool before(const Fault& left, const Fault& right)
{
    return std::pair{left.line, left.column} < std::pair{right.line, right.column};
}

/// The line `number` (from 1) of `content`; empty where there is none.
std::string_view line_of(std::string_view content, unsigned number)
{
    for (unsigned i = 1; i < number; ++i) {
        const auto end = content.find('\n');
        if (end == std::string_view::npos) return {};
        content.remove_prefix(end + 1);
    }
    return content.substr(0, content.find('\n'));
}

/// The pages write an Ident_Number that no source states as 0x.... : the fault for a copy of it says what to
/// put there.
std::string what_is_wrong(std::string_view content, Place place, std::string_view description)
{
    const std::string_view line = line_of(content, place.line);
    const auto key = line.find_first_not_of(" \t");
    if (key != std::string_view::npos && line.substr(key).starts_with("ident") &&
        line.find("0x.") != std::string_view::npos)
        return "put your Ident_Number here, for example 0x1649. It is in the GSD file of the PLC project (Ident_Number).";
    return "this is not TOML: " + std::string{description} + ".";
}

} // namespace

Document::Document(const TextSource& source, std::string name)
    : name_(std::move(name)), root_(std::make_unique<Node>())
{
    root_->title = "[]";
    auto content = read_text(source, name_);
    if (!content) {
        faults_.push_back(content.error());
        return;
    }
    content = utf8(*content); // an editor of old machines saves "Zürich" in ISO 8859-1, as with tag tables
    if (const auto unparsed = prescan(*content)) {
        fault(unparsed->place, text(unparsed->why));
        return;
    }
    const ::toml::parse_result parsed = ::toml::parse(std::string_view{*content});
    if (!parsed) {
        const ::toml::parse_error& error = parsed.error();
        const Place place = input::place_of(error.source());
        fault(place, what_is_wrong(*content, place, error.description()) +
                         " Correct it first: the text after it was not read.");
        return;
    }
    *root_ = convert(parsed.table(), "", false);
    root_->place = {}; // what the file as a whole lacks has no line
    readable_ = true;
}

Document::~Document() = default;

Table Document::root()
{
    return {this, root_.get()};
}

void Document::fault(Place place, std::string what)
{
    if (faults_.size() <= kMaxFaults) faults_.push_back({name_, place.line, place.column, std::move(what)});
}

Faults Document::faults() const
{
    Faults all = faults_;
    find_unknown_keys(*root_, name_, all);
    std::stable_sort(all.begin(), all.end(), before);
    cap(all);
    return all;
}

} // namespace dpslave::input
