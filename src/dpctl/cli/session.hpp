// SPDX-License-Identifier: Apache-2.0
/// One run of a command: its terminal, and the daemon. Calls methods, and prints why there is no answer.
#pragma once

#include "end_signals.hpp"
#include "fields.hpp"
#include "terminal.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/control/client.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace dpslave::dpctl {

using control::Json;

/// The options that all commands have.
struct CommonOptions {
    std::string socket = "/run/dpslaved/control.sock";
    std::chrono::nanoseconds timeout = std::chrono::seconds{5};
    bool json = false;
    std::string field; ///< as field_of() reads it: only this one is printed; empty = all
};

/// Why there is no reply. Neither: the end was wanted.
struct Stopped {
    std::optional<control::ClientError> failed{};
    std::optional<control::ReplyMessage> refused{};
};

/// The moments of what is done again and again. What took too long is not made up for.
class Pace {
public:
    using Clock = std::chrono::steady_clock;
    explicit Pace(std::chrono::milliseconds every) : every_(every) {}
    /// The moment of the next one.
    Clock::time_point next() { return due_ = std::max(due_ + every_, Clock::now()); }

private:
    std::chrono::milliseconds every_;
    Clock::time_point due_ = Clock::now();
};

class Session {
public:
    Session(CommonOptions common, Terminal& terminal) : common_(std::move(common)), terminal_(terminal) {}

    Terminal& terminal() const { return terminal_; }
    /// Documents are printed, or a field of them, and no text.
    bool json() const { return common_.json || !common_.field.empty(); }
    /// A document had not the field that is wanted; why is printed.
    bool misses_field() const { return misses_field_; }
    const std::string& socket() const { return common_.socket; }

    /// From now on SIGINT, SIGTERM and SIGHUP end a wait, and no longer the program.
    void catch_signals();
    /// From now on a wait is woken as soon as `fd` is readable; it ends when `goes_on` then gives false.
    void wake_by(int fd, std::function<bool()> goes_on);
    /// From now on an answer may take this long, if that is longer than --timeout.
    void wait_longer(std::chrono::milliseconds timeout);
    /// Asks the user. True without one: a script has decided.
    bool agrees(const std::string& question);

    /// Waits until `then`. True: the end is wanted.
    bool pause_until(Pace::Clock::time_point then) const;

    /// Connects now, where a failure has to be seen before the first call.
    std::optional<control::ClientError> connect();
    /// The parameters of the reply as they came. All calls share one connection.
    Result<Json, Stopped> call(std::string_view method, const Json& parameters = Json::object());

    /// The parameters of the reply, without --json printable; or the exit code of a failure that is printed
    /// already.
    Result<Json, int> ask(std::string_view method, const Json& parameters = Json::object());

    /// The same of a method that lists stations. There is none only with a daemon that only listens: then it
    /// is a failure.
    Result<Json, int> ask_of_stations(std::string_view method, const std::string& station);

    /// Asks, and prints the reply as JSON or as `render` makes it. Gives the exit code.
    int show(std::string_view method, const Json& parameters,
             const std::function<std::string(const Json&)>& render);

    /// Calls with "more", and hands on the parameters of each reply until Ctrl-C, the last reply, or `take`
    /// is content (true). Gives the exit code.
    int follow(std::string_view method, const Json& parameters, const std::function<bool(const Json&)>& take);

    /// Prints `document` as JSON, its one field, or as `render` makes it.
    void print(const Json& document, const std::function<std::string()>& render);
    /// Prints `document` as one line of JSON, or its one field.
    void print_line(const Json& document);

    /// Prints why there is no reply: a failure to reach the daemon with what to do, an error as JSON too when
    /// wanted. Returns the exit code.
    int print_stopped(const Stopped& stopped);
    int print_error(const control::ReplyMessage& error);
    /// The error reply of a daemon that only listens to a command that needs a station. Returns the exit
    /// code.
    int print_only_listens();

private:
    std::optional<control::ClientError> start(std::string_view method, const Json& parameters, bool more);
    Result<Json, Stopped> next();
    int print_failed(const control::ClientError& error);
    void print_field(const Json& document);

    CommonOptions common_;
    Terminal& terminal_;
    std::chrono::milliseconds least_timeout_{0};
    std::optional<control::Client> client_;
    bool misses_field_ = false;
    bool was_answered_ = false; ///< by this daemon
    bool continues_ = false;    ///< of the last reply
    std::optional<EndSignals> signals_;
    int wake_ = -1;
    std::function<bool()> goes_on_;
};

/// {} or {"station": ...}.
Json station_parameter(const std::string& station);

} // namespace dpslave::dpctl
