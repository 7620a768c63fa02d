// SPDX-License-Identifier: Apache-2.0
#include "tag_names.hpp"

#include "dpslave/base/letters.hpp"

#include <algorithm>
#include <string>

namespace dpslave::app {
namespace {

/// In one case, with blanks for `_` and `-`.
std::string comparable(std::string_view name)
{
    std::string out = to_lower(name);
    std::replace_if(
        out.begin(), out.end(), [](char c) { return c == '_' || c == '-'; }, ' ');
    return out;
}

} // namespace

std::vector<const drive::Tag*> tags_called(const drive::TagTable& tags, std::string_view name)
{
    const std::string wanted = comparable(name);
    std::vector<const drive::Tag*> parts, wholes;
    for (const drive::Tag& tag : tags.all()) {
        const auto fits = [&](const std::string& one) {
            return !one.empty() && comparable(one).find(wanted) != std::string::npos;
        };
        const auto is_it = [&](const std::string& one) { return !one.empty() && comparable(one) == wanted; };
        if (is_it(tag.name) || std::any_of(tag.aliases.begin(), tag.aliases.end(), is_it))
            wholes.push_back(&tag);
        if (fits(tag.name) || std::any_of(tag.aliases.begin(), tag.aliases.end(), fits))
            parts.push_back(&tag);
    }
    return wholes.empty() ? parts : wholes;
}

} // namespace dpslave::app
