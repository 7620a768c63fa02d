// SPDX-License-Identifier: Apache-2.0
/// One reply for each method, written by hand after org.dpslaved.Control.varlink: two 590 boards, one
/// exchanging data, one whose configuration was refused and whose drive is silent.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace dpslave::test {

nlohmann::json fixture(const std::string& method);

} // namespace dpslave::test
