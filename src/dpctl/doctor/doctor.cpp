// SPDX-License-Identifier: Apache-2.0
#include "doctor.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/end_signals.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace dpslave::dpctl {
namespace {

/// The object of `array` with this name; an empty one without.
const Json& named(const Json& array, const std::string& name)
{
    static const Json nothing = Json::object();
    for (const Json& item : array)
        if (text(item, "name") == name) return item;
    return nothing;
}

Family family_of(const Json& info, const Json& tec)
{
    if (!tec.empty()) return Family::technology_box;
    return text(info, "comms_status", "").empty() ? Family::option_board : Family::controller;
}

/// The counters of a station: the first group is that of the bus, whatever a station is called.
const Json& group_of(const Json& counters, const std::string& name)
{
    static const Json nothing = Json::object();
    bool is_bus = true;
    for (const Json& group : list(counters, "groups"))
        if (!std::exchange(is_bus, false) && text(group, "name") == name) return group;
    return nothing;
}

/// The first causes of each station and of the bus, and all notes.
std::vector<Finding> without_the_least(std::vector<Finding> findings)
{
    std::map<std::string, std::size_t> causes;
    std::erase_if(findings, [&](const Finding& one) {
        return one.rule->rank != Rank::note && ++causes[one.station] > kMostCauses;
    });
    return findings;
}

bool is_known(const Json& status, const std::string& wanted)
{
    const Json& stations = list(status, "stations");
    return std::any_of(stations.begin(), stations.end(),
                       [&](const Json& one) { return is_meant(one, wanted); });
}

} // namespace

bool is_meant(const Json& station, const std::string& wanted)
{
    return wanted.empty() || text(station, "name") == wanted || number(station, "address") == wanted;
}

std::vector<Finding> diagnose(const Replies& replies, const std::string& wanted)
{
    static const Json nothing = Json::object();
    const Json& bus = part(replies.status, "bus");
    const Json& counters = named(list(replies.counters, "groups"), "bus");
    const std::int64_t uptime = integer(replies.status, "uptime_ms").value_or(0);
    std::vector<Finding> findings;
    for (const Rule& rule : rules()) {
        if (is_of_bus(rule)) {
            const Facts facts{replies, bus,     counters, uptime, Family::option_board, nothing, nothing,
                              nothing, nothing, nothing,  nothing};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({"", &rule, std::move(seen)});
            continue;
        }
        for (const Json& station : list(replies.status, "stations")) {
            if (!station.is_object() || !is_meant(station, wanted)) continue;
            const std::string name = text(station, "name");
            const Json& info = named(list(replies.info, "stations"), name);
            const Json& tec = named(list(replies.tec, "stations"), name);
            const Facts facts{replies,
                              bus,
                              counters,
                              uptime,
                              family_of(info, tec),
                              station,
                              group_of(replies.counters, name),
                              info,
                              named(list(replies.diagnosis, "stations"), name),
                              tec,
                              named(list(replies.io, "stations"), name)};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({name, &rule, std::move(seen)});
        }
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& one, const Finding& other) {
        return one.rule->rank < other.rule->rank;
    });
    return without_the_least(std::move(findings));
}

std::optional<LineLimit> line_limit(const Json& bus)
{
    if (text(bus, "baud_state") == "Baud_Search") return std::nullopt;
    const auto baud = integer(bus, "baud");
    for (const LineLimit& limit : kLineLimits)
        if (limit.baud == baud) return limit;
    return std::nullopt;
}

namespace {

std::string probe_text(const Json& reply)
{
    const Json& answering = list(reply, "answering");
    std::string out = fmt::format("{}: asked {} on line {} ({})\n", text(reply, "station"),
                                  plural(integer(reply, "tried").value_or(0), "time"), text(reply, "line"),
                                  text(reply, "port"));
    for (const Json& one : answering)
        out += fmt::format("a drive answers: {} unit {} at {}, {}\n", text(one, "protocol"),
                           text(one, "unit"), rate(integer(one, "baud").value_or(0)), text(one, "format"));
    if (answering.empty())
        return out +
               "nothing answers at any rate, format or unit: cable, power, or the drive's port is not set "
               "to this protocol\n";
    return out +
           "Write what answers under [[line]] and [[station]], or set the drive to what stands there; then "
           "dpctl reload.\n";
}

/// How long it takes at most, and then how far it is: on a terminal only, over the same line.
void tell_progress(const Json& reply, bool is_first, Terminal& terminal)
{
    if (is_first)
        terminal.err << fmt::format("looking for the drive of {} on {}: {} s at most; Ctrl-C ends it\n",
                                    text(reply, "station"), text(reply, "port"), number(reply, "longest_s"));
    else if (terminal.tty)
        terminal.err << fmt::format("\r{} of {} asked", number(reply, "tried"), number(reply, "to_try"));
    terminal.err << std::flush;
}

int do_probe(const Options& options, Terminal& terminal)
{
    const EndSignals end;
    Json parameters = station_parameter(options);
    if (options.yes) parameters["yes"] = true;
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return tell(client.error(), terminal);
    if (const auto failed = client->start("ProbeDrive", parameters)) return tell(*failed, terminal);
    for (bool is_first = true;; is_first = false) {
        auto reply = client->next(end.fd());
        if (!reply) return tell(reply.error(), terminal);
        if (!*reply) {
            terminal.err << "\nended; the line goes back to its work\n";
            return kNo;
        }
        if (!(*reply)->error.empty()) return tell(**reply, options, terminal);
        Json now =
            options.json ? std::move((*reply)->parameters) : printable_texts(std::move((*reply)->parameters));
        if (flag(now, "done") || !(*reply)->continues) {
            if (terminal.tty) terminal.err << "\r\033[K" << std::flush;
            terminal.out << (options.json ? json_text(now) + '\n' : probe_text(now)) << std::flush;
            return list(now, "answering").empty() ? kNo : kFine;
        }
        tell_progress(now, is_first, terminal);
    }
}

} // namespace

int do_doctor(const Options& options, Terminal& terminal)
{
    if (options.probe) return do_probe(options, terminal);
    if (options.all) {
        terminal.out << (options.json ? json_text(rules_json()) + '\n' : render_rules(terminal.look()));
        return kFine;
    }
    Replies replies;
    const std::array<std::pair<const char*, Json*>, 7> questions = {{{"GetStatus", &replies.status},
                                                                     {"GetInfo", &replies.info},
                                                                     {"GetDiagnosis", &replies.diagnosis},
                                                                     {"GetCounters", &replies.counters},
                                                                     {"GetLeds", &replies.leds},
                                                                     {"GetTec", &replies.tec},
                                                                     {"GetIo", &replies.io}}};
    for (const auto& [method, reply] : questions) {
        auto answer = ask(options, terminal, method, Json::object());
        if (!answer) return answer.error();
        *reply = *std::move(answer);
    }
    if (!is_known(replies.status, options.station)) {
        terminal.err << (options.station.empty()
                             ? std::string{"dpctl: there is no station\n"}
                             : fmt::format("dpctl: there is no station '{}'\n", options.station));
        return options.station.empty() ? kNo : kUsage;
    }
    const std::vector<Finding> findings = diagnose(replies, options.station);
    const std::vector<Earlier> earlier = earlier_troubles(replies, options.station);
    terminal.out << (options.json
                         ? json_text(doctor_json(replies, findings, earlier)) + '\n'
                         : render_doctor(replies, findings, earlier, options.station, terminal.look()))
                 << std::flush;
    const bool well = std::all_of(findings.begin(), findings.end(),
                                  [](const Finding& f) { return f.rule->rank == Rank::note; });
    return well ? kFine : kNo;
}

} // namespace dpslave::dpctl
