// SPDX-License-Identifier: Apache-2.0
/// A fault in a text: where it is, and what to do about it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace dpslave::input {

struct Fault {
    std::string file;
    unsigned line = 0;   ///< from 1; 0 = the file as a whole
    unsigned column = 0; ///< from 1; 0 = the line as a whole
    std::string what;    ///< a sentence that says what is wrong and what to do
};

/// All faults found in one run, in the order of the file.
using Faults = std::vector<Fault>;

/// Most faults that one run reports; a last one says that there are more. This bounds the time
/// for a file with thousands.
inline constexpr std::size_t kMaxFaults = 100;

/// Replaces those after the first kMaxFaults by one that says so.
void cap(Faults& faults);

/// "FILE:LINE:COLUMN: what", as compilers do; printable, and of limited length.
std::string to_string(const Fault& fault);

} // namespace dpslave::input
