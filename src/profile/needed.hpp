// SPDX-License-Identifier: Apache-2.0
/// Keys of a profile that must be there: asked for, and missed with the line to add.
#pragma once

#include "dpslave/input/document.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace dpslave::profile {

/// A file of the folder that is meant: no path, no folder.
inline bool is_name_of_a_file(std::string_view text)
{
    return !text.empty() && text.find('/') == text.npos && text != "." && text != "..";
}

/// Empty where the key is missing or wrong.
inline std::string needed_text(input::Table& table, std::string_view key, std::string_view example)
{
    table.require(key, example);
    return table.text(key).value_or("");
}

/// False if `into` kept what it was.
template <class T>
bool needed_integer(input::Table& table, std::string_view key, std::int64_t min, std::int64_t max, T& into)
{
    table.require(key, std::string{key} + " = " + std::to_string(into));
    const auto value = table.integer(key, min, max);
    if (value) into = static_cast<T>(*value);
    return value.has_value();
}

inline void needed_boolean(input::Table& table, std::string_view key, bool& into)
{
    table.require(key, std::string{key} + (into ? " = true" : " = false"));
    into = table.boolean(key).value_or(into);
}

inline input::Table needed_table(input::Table& root, std::string_view name)
{
    root.require(name, "the table [" + std::string{name} + "]; another profile shows its keys");
    return root.table(name);
}

} // namespace dpslave::profile
