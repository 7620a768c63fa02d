// SPDX-License-Identifier: Apache-2.0
/// One field of a document, for scripts. Pure.
#pragma once

#include "fields.hpp"

#include "dpslave/base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// "bus.baud", "stations.state": the values of this field, a line each. A list is gone through, so that its
/// objects have a line each. Texts are printable and stand as they are, all else as in JSON; null where only
/// others have the field. The error is a sentence with the fields that there are.
Result<std::vector<std::string>, std::string> field_of(const Json& document, std::string_view path);

} // namespace dpslave::dpctl
