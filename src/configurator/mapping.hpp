// SPDX-License-Identifier: Apache-2.0
/// Mappings as the page sends them, and as files.
#pragma once

#include "facts.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/configurator/configurator.hpp"

#include <string>

namespace dpslave::configurator {

struct WrongKey {
    std::string key; ///< of the mapping; empty: there is no mapping
    std::string sentence;
};

/// The key `mapping` of a request.
Result<profile::Mapping, WrongKey> read_mapping(const Json& request);

/// Puts the mapping into `outcome` as a TOML file that load_mapping() reads, or says why there is none. Each
/// parameter has the name of its tag beside it.
void put_mapping_file(Outcome& outcome, const profile::Mapping& mapping, const drive::TagTable& tags);

} // namespace dpslave::configurator
