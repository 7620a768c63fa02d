// SPDX-License-Identifier: Apache-2.0
/// Tags as the command line names them: by number, or by a name that the daemon looks up in its tag table.
#pragma once

#include "dpctl/cli/session.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/arguments/options.hpp"
#include "dpslave/base/result.hpp"
#include "dpslave/report/replies.hpp"

#include <chrono>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// How often a command may ask again.
inline constexpr arguments::TimeLimits kIntervals{std::chrono::milliseconds{100},
                                                  std::chrono::hours{30 * 24}};

/// The tags of `words`, in their order, or the exit status of a failure that is printed already: a name that
/// fits no tag or several is refused, with those that it fits. A whole name, or one that begins so, goes
/// before one that has the words somewhere.
Result<std::vector<std::int64_t>, int> find_tags(const std::vector<std::string>& words,
                                                 const std::string& station, Session& session);

/// The tag of a number or of a whole name, case aside: for a command that changes it. The failure is an exit
/// status.
Result<std::int64_t, int> find_whole_tag(const std::string& word, const std::string& station,
                                         Session& session);

/// Number and name of each, `most` of them; empty without one.
std::string tag_lines(const std::vector<report::NamedTag>& tags, std::size_t most, Look look);

} // namespace dpslave::dpctl
