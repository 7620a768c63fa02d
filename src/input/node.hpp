// SPDX-License-Identifier: Apache-2.0
/// Holds the content of a TOML file as plain nodes, each with its place.
#pragma once

#include "dpslave/input/document.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dpslave::input {

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

struct Other {}; ///< dates and times: no key takes one

struct Value {
    Place place;
    std::variant<Other, bool, std::int64_t, double, std::string, std::vector<Value>, Node> held;
};

struct Entry {
    std::string key;
    Place key_place;
    Value value;
};

/// Returns the value as the file's author wrote it, or nearly so.
std::string shown(const Value& value);

/// The shortest text that reads back as `number`.
std::string plain(double number);

/// A fault for each key of `node`, and of the tables in it, that was not asked for.
void find_unknown_keys(const Node& node, const std::string& file, Faults& faults);

} // namespace dpslave::input
