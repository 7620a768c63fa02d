// SPDX-License-Identifier: Apache-2.0
/// Calls a method of the daemon, and prints why there is no answer.
#pragma once

#include "subcommands.hpp"

#include "dpslave/control/client.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

using control::Json;

/// The parameters of the reply, or the exit code of a failure that is printed already.
Result<Json, int> ask(const Options& options, Terminal& terminal, std::string_view method,
                      const Json& parameters);

/// Asks, and prints the reply as JSON or as `render` makes it.
int show(const Options& options, Terminal& terminal, std::string_view method, const Json& parameters,
         const std::function<std::string(const Json&)>& render);

/// Calls with "more", and hands on each reply until Ctrl-C, the last reply, or `take` is content (true).
/// Gives the exit code.
int follow_replies(const Options& options, Terminal& terminal, std::string_view method,
                   const Json& parameters, const std::function<bool(const control::ReplyMessage&)>& take);

/// The same of a method that lists stations. There is none only with a daemon that only listens: then it is a
/// failure.
Result<Json, int> ask_of_stations(const Options& options, Terminal& terminal, std::string_view method);
/// The error reply of a daemon that only listens to a command that needs a station. Returns the exit code.
int print_only_listens(const Options& options, Terminal& terminal);

/// Prints a failure to reach the daemon, with what to do. Returns the exit code.
int print_error(const control::ClientError& error, Terminal& terminal);
/// The same of a daemon that had answered before: its end is that of the daemon.
int print_gone(const control::ClientError& error, Terminal& terminal);
/// Prints an error reply; as JSON too when wanted. Returns the exit code.
int print_error(const control::ReplyMessage& error, const Options& options, Terminal& terminal);

/// {} or {"station": ...}.
Json station_parameter(const Options& options);

} // namespace dpslave::dpctl
