// SPDX-License-Identifier: Apache-2.0
/// docs/reference/conformance.md, made from a run.
#pragma once

#include <string>
#include <vector>

namespace conformance {

/// `results`: files that GoogleTest has written (--gtest_output=json). What is in none of them has not run.
std::string document(const std::vector<std::string>& results);

} // namespace conformance
