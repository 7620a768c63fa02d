// SPDX-License-Identifier: Apache-2.0
#include "node.hpp"

#include "dpslave/input/wording.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace dpslave::input {

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

std::string plain(double number)
{
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

namespace {

void find_unknown_keys(const Value& value, const std::string& file, Faults& faults)
{
    if (const auto* table = std::get_if<Node>(&value.held)) find_unknown_keys(*table, file, faults);
    if (const auto* list = std::get_if<std::vector<Value>>(&value.held))
        for (const Value& item : *list) find_unknown_keys(item, file, faults);
}

} // namespace

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

void find_unknown_keys(const Node& node, const std::string& file, Faults& faults)
{
    // If nothing was asked of a table, its place was already refused as a whole.
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

} // namespace dpslave::input
