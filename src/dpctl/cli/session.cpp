// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include "explain.hpp"
#include "field_of.hpp"
#include "words.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

namespace dpslave::dpctl {

int Session::print_failed(const control::ClientError& error)
{
    using Kind = control::ClientError::Kind;
    terminal_.err << "dpctl: " << error.text << '\n';
    if (error.kind == Kind::no_daemon)
        terminal_.err
            << "Check whether dpslaved runs: systemctl status dpslaved. Or start it: dpslaved --config FILE\n"
               "journalctl -u dpslaved says why it does not start.\n"
               "Without dpslaved no station is on the bus: the lamps are off, as without power.\n";
    if (error.kind == Kind::no_access) terminal_.err << "This user may not open the folder or the socket.\n";
    if (error.kind == Kind::timeout)
        terminal_.err << "The daemon runs but does not answer. See: journalctl -u dpslaved\n";
    switch (error.kind) {
        case Kind::no_daemon:
        case Kind::no_access: return kNoDaemon;
        case Kind::timeout: return kNoAnswer;
        case Kind::ended: return was_answered_ ? kNoDaemon : kNo;
        case Kind::nonsense: break;
    }
    return kNo;
}

int Session::print_error(const control::ReplyMessage& error)
{
    if (json() && common_.field.empty())
        terminal_.out << json_text(Json::object({{"error", error.error}, {"parameters", error.parameters}}))
                      << '\n';
    const control::ReplyMessage shown{printable_texts(error.parameters), printable(error.error),
                                      error.continues};
    terminal_.err << "dpctl: " << explain(shown) << '\n';
    const auto known = report::read<report::StationRequired>(shown.parameters).known;
    if (shown.error == "org.dpslaved.Control.StationRequired" && !known.empty())
        terminal_.err << "Add its name to the command, for example: --station " << known[0] << '\n';
    return exit_of(error);
}

int Session::print_only_listens()
{
    return print_error({Json::object(), "org.dpslaved.Control.OnlyListens", false});
}

int Session::print_stopped(const Stopped& stopped)
{
    if (stopped.refused) return print_error(*stopped.refused);
    return stopped.failed ? print_failed(*stopped.failed) : static_cast<int>(kFine);
}

bool Session::agrees(const std::string& question)
{
    if (terminal_.user == nullptr) return true;
    terminal_.err << question << " [y/N] " << std::flush;
    std::string answer;
    std::getline(*terminal_.user, answer);
    return answer == "y" || answer == "Y" || answer == "yes";
}

void Session::catch_signals()
{
    signals_.emplace();
    wake_by(signals_->fd(), [] { return false; });
}

void Session::wake_by(int fd, std::function<bool()> goes_on)
{
    wake_ = fd;
    goes_on_ = std::move(goes_on);
}

void Session::wait_longer(std::chrono::milliseconds timeout)
{
    least_timeout_ = timeout;
    client_.reset();
}

bool Session::pause_until(Pace::Clock::time_point then) const
{
    do {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(then - Pace::Clock::now()).count();
        const auto limit = static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000'000));
        if (becomes_readable(wake_, limit) && !goes_on_()) return true;
    } while (Pace::Clock::now() < then);
    return false;
}

std::optional<control::ClientError> Session::connect()
{
    if (client_) return std::nullopt;
    const auto timeout = std::chrono::ceil<std::chrono::milliseconds>(common_.timeout);
    auto client = control::Client::connect(common_.socket, std::max(timeout, least_timeout_));
    if (!client) return client.error();
    client_ = *std::move(client);
    return std::nullopt;
}

std::optional<control::ClientError> Session::start(std::string_view method, const Json& parameters, bool more)
{
    if (auto failed = connect()) return failed;
    return more ? client_->start(method, parameters) : client_->start_one(method, parameters);
}

Result<Json, Stopped> Session::next()
{
    for (;;) {
        auto reply = client_->next(wake_);
        if (reply && !*reply && goes_on_()) continue;
        if (!reply || !*reply) client_.reset(); // what is still to come is of no use
        if (!reply) return Failure{Stopped{reply.error(), {}}};
        if (!*reply) return Failure{Stopped{}};
        was_answered_ = true;
        continues_ = (*reply)->continues;
        if (!(*reply)->error.empty()) return Failure{Stopped{{}, **std::move(reply)}};
        return std::move((*reply)->parameters);
    }
}

Result<Json, Stopped> Session::call(std::string_view method, const Json& parameters)
{
    if (const auto failed = start(method, parameters, false)) return Failure{Stopped{failed, {}}};
    return next();
}

Result<Json, int> Session::ask_of_stations(std::string_view method, const std::string& station)
{
    auto reply = ask(method, station_parameter(station));
    if (reply && list(*reply, "stations").empty()) return Failure{print_only_listens()};
    return reply;
}

Result<Json, int> Session::ask(std::string_view method, const Json& parameters)
{
    auto reply = call(method, parameters);
    if (reply) return json() ? *std::move(reply) : printable_texts(*std::move(reply));
    const bool is_end = !reply.error().failed && !reply.error().refused;
    return Failure{is_end ? static_cast<int>(kNo) : print_stopped(reply.error())};
}

int Session::show(std::string_view method, const Json& parameters,
                  const std::function<std::string(const Json&)>& render)
{
    const auto reply = ask(method, parameters);
    if (!reply) return reply.error();
    print(*reply, [&] { return render(*reply); });
    return kFine;
}

void Session::print(const Json& document, const std::function<std::string()>& render)
{
    if (!common_.field.empty()) return print_field(document);
    terminal_.out << (json() ? json_text(document) + '\n' : render()) << std::flush;
}

void Session::print_line(const Json& document)
{
    if (!common_.field.empty()) return print_field(document);
    terminal_.out << printable_json(document.dump(-1, ' ', false, Json::error_handler_t::replace)) << '\n';
}

void Session::print_field(const Json& document)
{
    const auto lines = field_of(document, common_.field);
    if (!lines && !std::exchange(misses_field_, true)) terminal_.err << "dpctl: " << lines.error() << '\n';
    if (!lines) return;
    for (const std::string& line : *lines) terminal_.out << line << '\n';
}

int Session::follow(std::string_view method, const Json& parameters,
                    const std::function<bool(const Json&)>& take)
{
    catch_signals();
    if (const auto failed = start(method, parameters, true)) return print_stopped({failed, {}});
    was_answered_ = true; // it took the connection
    while (terminal_.out) {
        const auto reply = next();
        if (!reply) return print_stopped(reply.error());
        const bool is_content = take(*reply);
        terminal_.out << std::flush;
        if (!is_content && continues_) continue;
        client_.reset();
        return kFine;
    }
    return kNo; // what we print is not taken any more
}

Json station_parameter(const std::string& station)
{
    Json parameters = Json::object();
    if (!station.empty()) parameters["station"] = station;
    return parameters;
}

} // namespace dpslave::dpctl
