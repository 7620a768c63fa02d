// SPDX-License-Identifier: Apache-2.0
/// Rows of tag tables as text and as JSON.
#pragma once

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"
#include "tag_search.hpp"

#include <string>

namespace dpslave::dpctl {

Json tags_json(const TagHits& hits);
/// All about each; of more than kMostTagsInFull one line each.
inline constexpr std::size_t kMostTagsInFull = 10;
std::string render_tags(const TagHits& hits, Look look);

Json tables_json(const std::vector<TagFile>& files);
/// The tables, and the devices for which none is public.
std::string render_tables(const std::vector<TagFile>& files, Look look);

} // namespace dpslave::dpctl
