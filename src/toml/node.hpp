// SPDX-License-Identifier: Apache-2.0
/// What stands in a TOML file, as plain nodes, each with its place.
#pragma once

#include "dpslave/toml/document.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

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

/// As the file's author wrote it, or nearly so.
std::string shown(const Value& value);

/// The shortest text that reads back as `number`.
std::string plain(double number);

/// A fault for each key of `node`, and of the tables in it, that was not asked for.
void find_unknown_keys(const Node& node, const std::string& file, Faults& faults);

} // namespace dpslave::toml
