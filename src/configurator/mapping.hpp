// SPDX-License-Identifier: Apache-2.0
/// Mappings as the page sends them, and as files.
#pragma once

#include "facts.hpp"

#include "dpslave/base/result.hpp"

#include <string>

namespace dpslave::configurator {

/// The key `mapping` of a request. The failure is a sentence.
Result<profile::Mapping, std::string> read_mapping(const Json& request);

/// The mapping as a TOML file that load_mapping() reads. Each parameter has the name of its tag beside it.
std::string mapping_file(const profile::Mapping& mapping, const drive::TagTable& tags);

} // namespace dpslave::configurator
