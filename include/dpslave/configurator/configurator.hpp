// SPDX-License-Identifier: Apache-2.0
/// What `dpctl gsd` and the configurator's page do, without a file, a screen or a clock: a question goes in,
/// a file, the lines for people and the facts come out. The page asks with call();
/// docs/internals/configurator-calls.md describes its requests and replies.
#pragma once

#include "dpslave/toml/text_source.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace dpslave::configurator {

/// The exit codes of dpctl.
inline constexpr int kFine = 0;
inline constexpr int kNo = 1;    ///< refused, faulty, or not the same
inline constexpr int kUsage = 2; ///< the question itself is wrong

struct Outcome {
    int exit = kFine;
    std::string octets = {};                ///< the file that was asked for, octet by octet
    std::vector<std::string> lines = {};    ///< the answer for people, UTF-8, printable
    std::vector<std::string> messages = {}; ///< warnings and refusals, which dpctl prints on standard error
    std::string facts = "{}";               ///< the same for programs: a JSON object
};

/// Does a master's tool accept the file? `path` is how the lines name it; empty = only its octets are judged.
Outcome check(std::string_view file, std::string_view path, bool strict);

/// One request of the page, answered: both are JSON texts. Never fails; what is wrong with the request is
/// exit 2 and a sentence. `source` gives profiles, tag tables and samples by the names that `index.txt`
/// lists.
std::string call(std::string_view request, const toml::TextSource& source);

} // namespace dpslave::configurator
