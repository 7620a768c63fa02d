// SPDX-License-Identifier: Apache-2.0
/// A fault in a file that a person wrote: where it is, and what to do about it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dpslave::toml {

struct Fault {
    std::string file;
    unsigned line = 0;   ///< from 1; 0 = the file as a whole
    unsigned column = 0; ///< from 1; 0 = the line as a whole
    std::string what;    ///< a sentence that says what is wrong and what to do
};

/// All faults found in one run, in the order of the file.
using Faults = std::vector<Fault>;

/// So many faults of one run are told, and then that there are more: a file with thousands must not keep the
/// program busy, and no person reads so many.
inline constexpr std::size_t kMaxFaults = 100;

/// Those behind the first kMaxFaults give way to one that says so.
void cap(Faults& faults);

/// "FILE:LINE:COLUMN: what", as compilers do; printable, and not longer than a person reads.
std::string to_string(const Fault& fault);

} // namespace dpslave::toml
