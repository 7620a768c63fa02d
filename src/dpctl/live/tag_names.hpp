// SPDX-License-Identifier: Apache-2.0
/// Tags as the command line names them: by number, or by a name that the daemon looks up in its tag table.
#pragma once

#include "dpctl/cli/subcommands.hpp"

#include "dpslave/base/result.hpp"

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dpslave::dpctl {

/// "500ms", "1s", "10m", "2h"; a number alone is seconds. Nothing: it is no such time, less than 100 ms, or
/// more than 30 days.
std::optional<std::chrono::milliseconds> parse_interval(std::string_view text);

/// The numbers of options.words, in their order, or the exit code of a failure that is printed already: a
/// name that fits no tag or several is refused, with those that it fits.
Result<std::vector<std::int64_t>, int> find_tags(const Options& options, Terminal& terminal);

/// `read --list`: the tags with their names, or those that options.words fit.
int list_tags(const Options& options, Terminal& terminal);

} // namespace dpslave::dpctl
