// SPDX-License-Identifier: Apache-2.0
/// Pieces that several pictures share.
#pragma once

#include "fields.hpp"
#include "table.hpp"

#include <string>

namespace dpslave::dpctl {

std::string bus_line(const Json& bus);
Table station_table(const Json& stations);
Table word_table(const Json& words);

} // namespace dpslave::dpctl
