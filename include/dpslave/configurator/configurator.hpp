// SPDX-License-Identifier: Apache-2.0
/// Does the work of `dpctl gsd` and of the configurator's page, without a file, a screen or a clock: a
/// question goes in, a file, the lines to print and the facts come out. The page asks with call();
/// docs/internals/configurator-calls.md describes its requests and replies.
#pragma once

#include "dpslave/input/text_source.hpp"
#include "dpslave/profile/gsd_device.hpp"
#include "dpslave/profile/station_keys.hpp"

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

/// Gives access to profiles and tag tables.
struct Files {
    const input::TextSource& source;
    std::string profiles;           ///< their folder; the tables are in `tags` beside it
    std::vector<std::string> names; ///< of all profiles, for the sentence about a wrong one
};

/// The GSD of `mapping`. `table`: a tag table of the user's own, which replaces that of the mapping;
/// `path`: where the file goes. Either may be empty.
Outcome make(const Files& files, const profile::Mapping& mapping, const std::string& table,
             const std::string& path);

/// The I/O map of a GSD file. The tags have the names of `profile` and `table`; either may be empty. Others
/// have those of the file's own comments. `modules`: names of a list that the master's tool may put together;
/// empty: the file's own.
Outcome show(const Files& files, std::string_view file, const std::string& profile, const std::string& table,
             const std::vector<std::string>& modules = {});

struct CheckOptions {
    bool strict = false;                   ///< every deviation from the standard is an error
    std::string profile = {};              ///< empty: the device is recognised by what the file says
    std::string table = {};                ///< a tag table of the user's own; may be empty
    profile::StationKeys keys = {};        ///< of the station
    std::vector<std::string> modules = {}; ///< names: this list is judged; empty: the file's own
};

/// Does a master's tool accept the file, and does a station take what the master then sends? `path` is how
/// the lines name it; empty = only its octets are judged.
Outcome check(const Files& files, std::string_view file, std::string_view path, const CheckOptions& options);

struct ImportOptions {
    std::string profile = {}; ///< empty: the device is recognised by what the file says
    std::string table = {};   ///< a tag table of the user's own, which goes into the mapping; may be empty
    std::vector<std::uint8_t> cfg =
        {};             ///< the master's last Chk_Cfg, which says the directions; empty: not known
    bool lossy = false; ///< what a master sends or waits for may become something else
};

/// Returns the mapping that makes this GSD file; its octets are a mapping file (TOML). The result names
/// everything that gets lost. The file is refused if the device is not known, if no keys of a station make it
/// accept the file, or if a master would send or wait for something else.
Outcome import_file(const Files& files, std::string_view file, const ImportOptions& options);

/// Returns the differences between two GSD files, by meaning and by line. Exit kNo means that they do not
/// have the same meaning.
/// The tags have names as in show().
Outcome diff(const Files& files, std::string_view left, std::string_view right, const std::string& profile,
             const std::string& table);

/// The outcome as one JSON object: what call() replies, and what dpctl prints with --json.
std::string reply_of(const Outcome& outcome);

/// One request of the page, answered: both are JSON texts. Never fails; what is wrong with the request is
/// exit 2 and a sentence. `source` gives profiles, tag tables and samples by the names that `index.txt`
/// lists.
std::string call(std::string_view request, const input::TextSource& source);

} // namespace dpslave::configurator
