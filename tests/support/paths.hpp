// SPDX-License-Identifier: Apache-2.0
// Where the sources lie, and what this build made. One compiled file knows it: no other changes with the
// folder of a clone, so a compiler cache serves them all.
#pragma once

#include <string>
#include <string_view>

namespace dpslave::test {

/// The absolute path of `below` in the folder of the sources; of that folder itself without a word.
std::string source_path(std::string_view below = {});

/// The absolute path of `below` in the folder of this build.
std::string built_path(std::string_view below);

/// The absolute path of one of the programs: dpslaved, dpctl, dpsim.
std::string program_path(std::string_view name);

} // namespace dpslave::test
