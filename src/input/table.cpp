// SPDX-License-Identifier: Apache-2.0
// The questions to a table of a file.
#include "node.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <cmath>

namespace dpslave::input {
namespace {

std::string whole_number(std::int64_t min, std::int64_t max)
{
    return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

std::string wrong(std::string_view key, std::string_view wanted, const Value& value)
{
    return "'" + std::string{key} + "' must be " + std::string{wanted} + ", not " + shown(value) + ".";
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
        refuse(key, "'" + std::string{key} + "' contains a control character: write plain text on one line.");
    else
        return *held;
    return std::nullopt;
}

std::optional<std::string> Table::lines(std::string_view key)
{
    if (!has(key)) return std::nullopt;
    const Value& value = node_->find(key)->value;
    const auto* held = std::get_if<std::string>(&value.held);
    if (held != nullptr && !held->empty()) return *held;
    refuse(key, wrong(key, "a text of lines between three quotes", value));
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

std::optional<std::vector<std::string>> Table::texts(std::string_view key, std::size_t least)
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
    if (list != nullptr && out.size() >= least) return out;
    refuse(key,
           wrong(key, least > 0 ? "a list of texts in quotes, one at least" : "a list of texts in quotes",
                 value));
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

} // namespace dpslave::input
