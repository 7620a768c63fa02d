// SPDX-License-Identifier: Apache-2.0
/// Tags by their names, as a caller of the control socket writes them. Pure.
#pragma once

#include "dpslave/drive/tag.hpp"

#include <string_view>
#include <vector>

namespace dpslave::app {

/// The rows whose name, or another name of theirs, has `name` as a part; where `name` is the whole name of
/// some, only those. Letters of ASCII in any case, `_` and `-` as blanks. Ascending by number. Empty `name`:
/// every row that has a name. Valid as long as `tags`.
std::vector<const drive::Tag*> tags_called(const drive::TagTable& tags, std::string_view name);

} // namespace dpslave::app
