// SPDX-License-Identifier: Apache-2.0
/// What `dpctl gsd` and the configurator's page do, without a file, a screen or a clock: a question goes in,
/// a file, the lines to print and the facts come out. The page asks with call();
/// docs/internals/configurator-calls.md describes its requests and replies.
#pragma once

#include "dpslave/profile/gsd_device.hpp"
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
    std::vector<std::string> lines = {};    ///< the answer to print, UTF-8, printable
    std::vector<std::string> messages = {}; ///< warnings and faults of files, each with its kind or its place
    std::vector<std::string> refusals = {}; ///< why the question has no answer: sentences
    std::string facts = "{}";               ///< the same for programs: a JSON object
};

/// Where profiles and tag tables are.
struct Files {
    const toml::TextSource& source;
    std::string profiles;           ///< their folder; the tables are in `tags` beside it
    std::vector<std::string> names; ///< of all profiles, for the sentence about a wrong one
};

/// The GSD of `mapping`. `table`: a tag table of the user's own, which stands for that of the mapping;
/// `path`: where the file goes. Either may be empty.
Outcome make(const Files& files, const profile::Mapping& mapping, const std::string& table,
             const std::string& path);

/// The I/O map of a GSD file. The tags have the names of `profile` and `table`; either may be empty.
Outcome show(const Files& files, std::string_view file, const std::string& profile, const std::string& table);

/// Does a master's tool accept the file? `path` is how the lines name it; empty = only its octets are judged.
Outcome check(std::string_view file, std::string_view path, bool strict);

/// The mapping that makes this GSD file; its octets are a mapping file (TOML). `profile`: empty =
/// Ident_Number and Model_Name together say which; refused where they do not. What gets lost is named.
/// `table`: a tag table of the user's own, which goes into the mapping; may be empty.
Outcome import_file(const Files& files, std::string_view file, const std::string& profile,
                    const std::string& table);

/// What differs between two GSD files, by meaning and by line. Exit kNo: they do not mean the same.
/// The tags have the names of `profile` and `table`; either may be empty.
Outcome diff(const Files& files, std::string_view left, std::string_view right, const std::string& profile,
             const std::string& table);

/// The outcome as one JSON object: what call() replies, and what dpctl prints with --json.
std::string reply_of(const Outcome& outcome);

/// One request of the page, answered: both are JSON texts. Never fails; what is wrong with the request is
/// exit 2 and a sentence. `source` gives profiles, tag tables and samples by the names that `index.txt`
/// lists.
std::string call(std::string_view request, const toml::TextSource& source);

} // namespace dpslave::configurator
