// SPDX-License-Identifier: Apache-2.0
#include "ask.hpp"

#include "end_signals.hpp"
#include "explain.hpp"
#include "words.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

int print_error(const control::ClientError& error, Terminal& terminal)
{
    using Kind = control::ClientError::Kind;
    terminal.err << "dpctl: " << error.text << '\n';
    if (error.kind == Kind::no_daemon)
        terminal.err
            << "Check whether dpslaved runs: systemctl status dpslaved. Or start it: dpslaved --config FILE\n"
               "journalctl -u dpslaved says why it does not start.\n"
               "Without dpslaved no station is on the bus: the lamps are off, as without power.\n";
    if (error.kind == Kind::no_access) terminal.err << "This user may not open the folder or the socket.\n";
    if (error.kind == Kind::timeout)
        terminal.err << "The daemon runs but does not answer. See: journalctl -u dpslaved\n";
    return error.kind == Kind::no_daemon || error.kind == Kind::no_access ? kNoDaemon : kNo;
}

int print_error(const control::ReplyMessage& error, const Options& options, Terminal& terminal)
{
    if (options.json)
        terminal.out << json_text(Json::object({{"error", error.error}, {"parameters", error.parameters}}))
                     << '\n';
    const control::ReplyMessage shown{printable_texts(error.parameters), printable(error.error),
                                      error.continues};
    terminal.err << "dpctl: " << explain(shown) << '\n';
    const auto known = report::read<report::StationRequired>(shown.parameters).known;
    if (shown.error == "org.dpslaved.Control.StationRequired" && !known.empty())
        terminal.err << "Add its name to the command, for example: "
                     << (options.station_is_option ? "--station " : "") << known[0] << '\n';
    const bool is_usage = error.error == "org.dpslaved.Control.NoSuchStation" ||
                          error.error == "org.dpslaved.Control.NoSuchLine";
    return is_usage ? kUsage : kNo;
}

int print_only_listens(const Options& options, Terminal& terminal)
{
    return print_error({Json::object(), "org.dpslaved.Control.OnlyListens", false}, options, terminal);
}

Result<Json, int> ask_of_stations(const Options& options, Terminal& terminal, std::string_view method)
{
    auto reply = ask(options, terminal, method, station_parameter(options));
    if (reply && list(*reply, "stations").empty()) return Failure{print_only_listens(options, terminal)};
    return reply;
}

Result<Json, int> ask(const Options& options, Terminal& terminal, std::string_view method,
                      const Json& parameters)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return Failure{print_error(client.error(), terminal)};
    auto reply = client->call(method, parameters);
    if (!reply) return Failure{print_error(reply.error(), terminal)};
    if (!reply->error.empty()) return Failure{print_error(*reply, options, terminal)};
    return options.json ? std::move(reply->parameters) : printable_texts(std::move(reply->parameters));
}

int show(const Options& options, Terminal& terminal, std::string_view method, const Json& parameters,
         const std::function<std::string(const Json&)>& render)
{
    const auto reply = ask(options, terminal, method, parameters);
    if (!reply) return reply.error();
    terminal.out << (options.json ? json_text(*reply) + '\n' : render(*reply)) << std::flush;
    return kFine;
}

int print_gone(const control::ClientError& error, Terminal& terminal)
{
    const int code = print_error(error, terminal);
    return error.kind == control::ClientError::Kind::ended ? kNoDaemon : code;
}

int follow_replies(const Options& options, Terminal& terminal, std::string_view method,
                   const Json& parameters, const std::function<bool(const control::ReplyMessage&)>& take)
{
    const EndSignals end;
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return print_error(client.error(), terminal);
    if (const auto failed = client->start(method, parameters)) return print_error(*failed, terminal);
    while (terminal.out) {
        const auto reply = client->next(end.fd());
        if (!reply) return print_gone(reply.error(), terminal);
        if (!*reply) return kFine; // Ctrl-C
        if (!(*reply)->error.empty()) return print_error(**reply, options, terminal);
        if (take(**reply) || !(*reply)->continues) return kFine;
    }
    return kNo; // what we print is not taken any more
}

Json station_parameter(const Options& options)
{
    Json parameters = Json::object();
    if (!options.station.empty()) parameters["station"] = options.station;
    return parameters;
}

} // namespace dpslave::dpctl
