// SPDX-License-Identifier: Apache-2.0
/// Is a GSD file what the masters' tools expect? The step "load it into the configurator to check the format"
/// of the manuals (B-092, C-047). Source: wire reference 9.1 to 9.4.
#pragma once

#include "dpslave/gsd/document.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::gsd {

enum class Severity : std::uint8_t { warning, error };

struct Finding {
    unsigned line = 0; ///< from 1; 0 = the file as a whole
    Severity severity = Severity::error;
    std::string what; ///< a sentence that says what is wrong and what to do
    /// The line is not understood, so that a reader goes on without it, with a default or with nothing.
    bool unread = false;
};
using Findings = std::vector<Finding>;

enum class Reading : std::uint8_t {
    tolerant, ///< as the masters' tools: what they accept wrongly is a warning, what they allow is not
              ///< reported
    strict,   ///< every deviation from the standard is an error
};

/// Returns the findings in the order of the lines. `file_name` has no folders; if it is empty the name is not
/// judged.
Findings check(const Document& document, Reading reading, std::string_view file_name = {});

} // namespace dpslave::gsd
