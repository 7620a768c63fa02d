// SPDX-License-Identifier: Apache-2.0
#include "field_of.hpp"

#include "dpslave/base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using Values = std::vector<const Json*>;

/// The items of lists in place of the lists.
void add_flat(const Json& value, Values& to)
{
    if (!value.is_array()) return to.push_back(&value);
    for (const Json& item : value) add_flat(item, to);
}

std::string names_in(const Values& values)
{
    std::vector<std::string> names;
    for (const Json* value : values)
        if (value->is_object())
            for (const auto& [name, unused] : value->items()) names.push_back(printable(name));
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return joined(names, ", ");
}

std::string text_of(const Json& value)
{
    if (value.is_string()) return printable(value.get_ref<const std::string&>());
    return printable_json(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

} // namespace

Result<std::vector<std::string>, std::string> field_of(const Json& document, std::string_view path)
{
    static const Json kNull;
    Values values;
    add_flat(document, values);
    while (!path.empty()) {
        const std::size_t dot = std::min(path.find('.'), path.size());
        const std::string name{path.substr(0, dot)};
        path.remove_prefix(std::min(dot + 1, path.size()));
        Values next;
        bool is_known = values.empty(); // of an empty list
        for (const Json* value : values) {
            const bool is_there = value->is_object() && value->contains(name);
            is_known = is_known || is_there || value->is_null();
            add_flat(is_there ? value->at(name) : kNull, next);
        }
        if (!is_known) {
            const std::string names = names_in(values);
            return Failure{fmt::format("there is no field '{}'; {}", printable(name),
                                       names.empty() ? "there is none below it" : "there are: " + names)};
        }
        values = std::move(next);
    }
    std::vector<std::string> lines;
    for (const Json* value : values) lines.push_back(text_of(*value));
    return lines;
}

} // namespace dpslave::dpctl
