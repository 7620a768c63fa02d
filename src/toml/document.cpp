// SPDX-License-Identifier: Apache-2.0
// The only file that knows toml++: what it parsed is copied into plain nodes, each with its place.
#include "dpslave/toml/document.hpp"

#include "nesting.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/toml/text_source.hpp"
#include "dpslave/toml/wording.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <variant>

namespace dpslave::toml {

struct Value;
struct Entry;

struct Node {
    std::string title; ///< "[bus]", as the file spells it
    Place place;
    std::vector<Entry> entries;
    std::vector<std::string> asked_for;

    Entry* find(std::string_view key);
    void remember(std::string_view key);
};

struct Other {}; ///< dates and times: no key of ours wants one

struct Value {
    Place place;
    std::variant<Other, bool, std::int64_t, double, std::string, std::vector<Value>, Node> held;
};

struct Entry {
    std::string key;
    Place key_place;
    Value value;
};

Entry* Node::find(std::string_view key)
{
    const auto found =
        std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

void Node::remember(std::string_view key)
{
    if (std::find(asked_for.begin(), asked_for.end(), key) == asked_for.end()) asked_for.emplace_back(key);
}

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

std::string plain(double number)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

/// As the file's author wrote it, or nearly so.
std::string shown(const Value& value)
{
    struct Show {
        std::string operator()(const Other&) const { return "a date or time"; }
        std::string operator()(bool held) const { return held ? "true" : "false"; }
        std::string operator()(std::int64_t held) const { return std::to_string(held); }
        std::string operator()(double held) const { return plain(held); }
        std::string operator()(const std::string& held) const { return in_quotes(held); }
        std::string operator()(const std::vector<Value>&) const { return "a list"; }
        std::string operator()(const Node&) const { return "a table"; }
    };
    return std::visit(Show{}, value.held);
}

std::string whole_number(std::int64_t min, std::int64_t max)
{
    return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

std::string wrong(std::string_view key, std::string_view wanted, const Value& value)
{
    return "'" + std::string{key} + "' must be " + std::string{wanted} + ", not " + shown(value) + ".";
}

bool before(const Fault& left, const Fault& right)
{
    return std::pair{left.line, left.column} < std::pair{right.line, right.column};
}

void find_unknown_keys(const Node& node, const std::string& file, Faults& faults);

void find_unknown_keys(const Value& value, const std::string& file, Faults& faults)
{
    if (const auto* table = std::get_if<Node>(&value.held)) find_unknown_keys(*table, file, faults);
    if (const auto* list = std::get_if<std::vector<Value>>(&value.held))
        for (const Value& item : *list) find_unknown_keys(item, file, faults);
}

void find_unknown_keys(const Node& node, const std::string& file, Faults& faults)
{
    // A table of which nothing was asked is one whose place was already refused as a whole.
    if (node.asked_for.empty()) return;
    for (const Entry& entry : node.entries) {
        if (faults.size() > kMaxFaults) return;
        const auto& legal = node.asked_for;
        if (std::find(legal.begin(), legal.end(), entry.key) != legal.end()) {
            find_unknown_keys(entry.value, file, faults);
            continue;
        }
        const std::string where = node.title == "[]" ? "at the top of the file" : "in " + node.title;
        std::string what = "unknown key '" + entry.key + "' " + where + ": ";
        if (const auto meant = nearest(entry.key, legal); !meant.empty())
            what += "did you mean '" + std::string{meant} + "'?";
        else {
            what += "remove it; known here are ";
            for (std::size_t i = 0; i < legal.size(); ++i) what += (i > 0 ? ", " : "") + legal[i];
            what += ".";
        }
        faults.push_back({file, entry.key_place.line, entry.key_place.column, what});
    }
}

} // namespace

Place Table::place() const
{
    return node_ != nullptr ? node_->place : Place{};
}

Place Table::place_of(std::string_view key) const
{
    if (node_ == nullptr) return {};
    const Entry* entry = node_->find(key);
    return entry != nullptr ? entry->value.place : node_->place;
}

std::vector<std::string> Table::keys() const
{
    std::vector<std::string> out;
    if (node_ != nullptr)
        for (const Entry& entry : node_->entries) out.push_back(entry.key);
    return out;
}

bool Table::has(std::string_view key) const
{
    if (node_ == nullptr) return false;
    node_->remember(key);
    return node_->find(key) != nullptr;
}

bool Table::is_text(std::string_view key) const
{
    return has(key) && std::holds_alternative<std::string>(node_->find(key)->value.held);
}

void Table::require(std::string_view key, std::string_view example)
{
    if (!exists() || has(key)) return;
    const std::string where = node_->title == "[]" ? "the file" : node_->title;
    document_->fault(node_->place, "'" + std::string{key} + "' is missing in " + where + ": add " +
                                       std::string{example} + ".");
}

std::optional<std::string> Table::text(std::string_view key)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    const auto* held = std::get_if<std::string>(&value.held);
    if (held == nullptr)
        refuse(key, wrong(key, "a text in quotes", value));
    else if (held->empty())
        refuse(key,
               "'" + std::string{key} + "' is empty: write a text between the quotes, or remove the line.");
    else if (has_control_characters(*held))
        refuse(key, "'" + std::string{key} + "' holds a control character: write plain text on one line.");
    else
        return *held;
    return std::nullopt;
}

std::optional<std::int64_t> Table::integer(std::string_view key, std::int64_t min, std::int64_t max)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    const auto* held = std::get_if<std::int64_t>(&value.held);
    if (held != nullptr && *held >= min && *held <= max) return *held;
    refuse(key, wrong(key, whole_number(min, max), value));
    return std::nullopt;
}

std::optional<double> Table::real(std::string_view key, double min, double max)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    double number = std::nan("");
    if (const auto* integer = std::get_if<std::int64_t>(&value.held)) number = static_cast<double>(*integer);
    if (const auto* real = std::get_if<double>(&value.held)) number = *real;
    if (number >= min && number <= max) return number; // never of a NaN
    refuse(key, wrong(key, "a number from " + plain(min) + " to " + plain(max), value));
    return std::nullopt;
}

std::optional<bool> Table::boolean(std::string_view key)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    if (const auto* held = std::get_if<bool>(&value.held)) return *held;
    refuse(key, wrong(key, "true or false", value));
    return std::nullopt;
}

std::optional<std::vector<std::string>> Table::texts(std::string_view key)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    std::vector<std::string> out;
    const auto* list = std::get_if<std::vector<Value>>(&value.held);
    for (const Value& item : list != nullptr ? *list : std::vector<Value>{}) {
        const auto* text = std::get_if<std::string>(&item.held);
        if (text == nullptr || text->empty() || has_control_characters(*text)) {
            document_->fault(item.place, wrong(key, "a list of texts in quotes", item));
            return std::nullopt;
        }
        out.push_back(*text);
    }
    if (!out.empty()) return out;
    refuse(key, wrong(key, "a list of texts in quotes, one at least", value));
    return std::nullopt;
}

std::optional<std::vector<std::int64_t>> Table::integers(std::string_view key, std::int64_t min,
                                                         std::int64_t max)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    std::vector<std::int64_t> out;
    const auto* list = std::get_if<std::vector<Value>>(&value.held);
    for (const Value& item : list != nullptr ? *list : std::vector<Value>{}) {
        const auto* number = std::get_if<std::int64_t>(&item.held);
        if (number == nullptr || *number < min || *number > max) {
            document_->fault(item.place, "in '" + std::string{key} + "' each item must be " +
                                             whole_number(min, max) + ", not " + shown(item) + ".");
            return std::nullopt;
        }
        out.push_back(*number);
    }
    if (!out.empty()) return out;
    refuse(key, wrong(key, "a list of whole numbers, one at least", value));
    return std::nullopt;
}

std::optional<std::ptrdiff_t> Table::index_of(std::string_view key, std::span<const std::string> legal)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    const auto* held = std::get_if<std::string>(&value.held);
    if (held != nullptr)
        if (const auto at = std::find(legal.begin(), legal.end(), *held); at != legal.end())
            return at - legal.begin();
    std::string what = wrong(key, listed(legal), value);
    if (held != nullptr)
        if (const auto meant = nearest(*held, legal); !meant.empty())
            what += " Did you mean " + in_quotes(meant) + "?";
    refuse(key, std::move(what));
    return std::nullopt;
}

Table Table::table(std::string_view key)
{
    if (!has(key)) return {document_, nullptr};
    Value& value = node_->find(key)->value;
    if (auto* node = std::get_if<Node>(&value.held)) return {document_, node};
    refuse(key, wrong(key, "a table with a heading in single brackets", value));
    return {document_, nullptr};
}

std::vector<Table> Table::tables(std::string_view key)
{
    std::vector<Table> out;
    if (!has(key)) return out;
    Value& value = node_->find(key)->value;
    auto* list = std::get_if<std::vector<Value>>(&value.held);
    if (list == nullptr) {
        refuse(key,
               wrong(key, "tables, each with the heading [[" + std::string{key} + "]] in double brackets",
                     value));
        return out;
    }
    for (Value& item : *list) {
        if (auto* node = std::get_if<Node>(&item.held))
            out.push_back({document_, node});
        else
            document_->fault(item.place, wrong(key, "tables only", item));
    }
    return out;
}

void Table::refuse(std::string_view key, std::string what)
{
    document_->fault(place_of(key), std::move(what));
}

namespace {

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

/// The pages write an Ident_Number that no source states as 0x.... : whoever copies that is told what to put
/// there.
std::string what_is_wrong(std::string_view content, Place place, std::string_view description)
{
    const std::string_view line = line_of(content, place.line);
    const auto key = line.find_first_not_of(" \t");
    if (key != std::string_view::npos && line.substr(key).starts_with("ident") &&
        line.find("0x.") != std::string_view::npos)
        return "put your Ident_Number here, for example 0x1649. It stands in the GSD file of the PLC project "
               "(Ident_Number).";
    return "this is no TOML: " + std::string{description} + ".";
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
    if (const auto place = too_deep(*content)) {
        fault(*place, "tables, lists or dotted keys are nested deeper than " + std::to_string(kMaxNesting) +
                          " here: nothing of ours is.");
        return;
    }
    try {
        *root_ = convert(::toml::parse(std::string_view{*content}), "", false);
        root_->place = {}; // what the file as a whole lacks has no line
        readable_ = true;
    } catch (const ::toml::parse_error& error) {
        const Place place = toml::place_of(error.source());
        fault(place, what_is_wrong(*content, place, error.description()) +
                         " Mend it first: what stands behind it was not judged.");
    }
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

} // namespace dpslave::toml
