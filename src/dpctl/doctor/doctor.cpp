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

template <class T>
const T kNothing{};

/// The one with this name; an empty one without.
template <class T>
const T& named(const std::vector<T>& all, const std::string& name)
{
    for (const T& one : all)
        if (one.name == name) return one;
    return kNothing<T>;
}

Family family_of(const report::Info& info, const report::Tec& tec)
{
    if (!tec.name.empty()) return Family::technology_box;
    return info.comms_status.value_or("").empty() ? Family::option_board : Family::controller;
}

/// The counters of a station: the first group is that of the bus, whatever a station is called.
const report::CounterGroup& group_of(const report::GetCountersReply& counters, const std::string& name)
{
    bool is_bus = true;
    for (const report::CounterGroup& group : counters.groups)
        if (!std::exchange(is_bus, false) && group.name == name) return group;
    return kNothing<report::CounterGroup>;
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

bool is_known(const std::vector<report::Station>& stations, const std::string& wanted)
{
    return std::any_of(stations.begin(), stations.end(),
                       [&](const report::Station& one) { return is_meant(one, wanted); });
}

} // namespace

bool is_meant(const report::Station& station, const std::string& wanted)
{
    return wanted.empty() || station.name == wanted || std::to_string(station.address) == wanted;
}

std::vector<Finding> diagnose(const Replies& replies, const std::string& wanted)
{
    const report::Bus& bus = replies.status.bus;
    const report::CounterGroup& counters = named(replies.counters.groups, "bus");
    const std::int64_t uptime = replies.status.uptime_ms;
    std::vector<Finding> findings;
    for (const Rule& rule : rules()) {
        if (is_of_bus(rule)) {
            const Facts facts{replies,
                              bus,
                              counters,
                              uptime,
                              Family::option_board,
                              kNothing<report::Station>,
                              kNothing<report::CounterGroup>,
                              kNothing<report::Info>,
                              kNothing<report::Diagnosis>,
                              kNothing<report::Tec>,
                              kNothing<report::StationIo>};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({"", &rule, std::move(seen)});
            continue;
        }
        for (const report::Station& station : replies.status.stations) {
            if (!is_meant(station, wanted)) continue;
            const std::string& name = station.name;
            const report::Info& info = named(replies.info.stations, name);
            const report::Tec& tec = named(replies.tec.stations, name);
            const Facts facts{replies,
                              bus,
                              counters,
                              uptime,
                              family_of(info, tec),
                              station,
                              group_of(replies.counters, name),
                              info,
                              named(replies.diagnosis.stations, name),
                              tec,
                              named(replies.io.stations, name)};
            if (std::string seen = rule.seen(facts); !seen.empty())
                findings.push_back({name, &rule, std::move(seen)});
        }
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& one, const Finding& other) {
        return one.rule->rank < other.rule->rank;
    });
    return without_the_least(std::move(findings));
}

std::optional<LineLimit> line_limit(const report::Bus& bus)
{
    if (bus.baud_state == "Baud_Search") return std::nullopt;
    for (const LineLimit& limit : kLineLimits)
        if (limit.baud == bus.baud) return limit;
    return std::nullopt;
}

namespace {

std::string probe_text(const report::ProbeDriveReply& reply)
{
    std::string out = fmt::format("{}: asked {} on line {} ({})\n", reply.station,
                                  plural(reply.tried, "time"), reply.line, reply.port);
    for (const report::Answering& one : reply.answering)
        out += fmt::format("a drive answers: {} unit {} at {}, {}\n", one.protocol, one.unit, rate(one.baud),
                           one.format);
    if (reply.answering.empty())
        return out + "no drive answers at any rate, format or unit: check the cable, the power, and that the "
                     "drive's port is set to this protocol\n";
    return out + "Write these settings under [[line]] and [[station]], or set the drive to those that are "
                 "there. Then: dpctl reload\n";
}

/// How long it takes at most, and then how far it is: on a terminal only, over the same line.
void print_progress(const report::ProbeDriveReply& reply, bool is_first, Terminal& terminal)
{
    if (is_first)
        terminal.err << fmt::format("searching for the drive of {} on {}: {} s at most; Ctrl-C ends it\n",
                                    reply.station, reply.port, reply.longest_s);
    else if (terminal.tty)
        terminal.err << fmt::format("\r{} of {} asked", reply.tried, reply.to_try);
    terminal.err << std::flush;
}

int do_probe(const Options& options, Terminal& terminal)
{
    const EndSignals end;
    Json parameters = station_parameter(options);
    if (options.yes) parameters["yes"] = true;
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return print_error(client.error(), terminal);
    if (const auto failed = client->start("ProbeDrive", parameters)) return print_error(*failed, terminal);
    for (bool is_first = true;; is_first = false) {
        auto reply = client->next(end.fd());
        if (!reply) return print_error(reply.error(), terminal);
        if (!*reply) {
            terminal.err << "\nended; the line continues its normal work\n";
            return kNo;
        }
        if (!(*reply)->error.empty()) return print_error(**reply, options, terminal);
        const Json shown =
            options.json ? std::move((*reply)->parameters) : printable_texts(std::move((*reply)->parameters));
        const auto now = report::read<report::ProbeDriveReply>(shown);
        if (now.done || !(*reply)->continues) {
            if (terminal.tty) terminal.err << "\r\033[K" << std::flush;
            terminal.out << (options.json ? json_text(shown) + '\n' : probe_text(now)) << std::flush;
            return now.answering.empty() ? kNo : kFine;
        }
        print_progress(now, is_first, terminal);
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
    std::optional<int> failed;
    const auto fetch = [&](std::string_view method, auto& reply) {
        if (failed) return;
        const auto answer = ask(options, terminal, method, Json::object());
        if (!answer)
            failed = answer.error();
        else
            report::take(*answer, reply);
    };
    fetch("GetStatus", replies.status);
    fetch("GetInfo", replies.info);
    fetch("GetDiagnosis", replies.diagnosis);
    fetch("GetCounters", replies.counters);
    fetch("GetLeds", replies.leds);
    fetch("GetTec", replies.tec);
    fetch("GetIo", replies.io);
    if (failed) return *failed;
    const bool listens = replies.status.bus.listens;
    if (listens && !options.station.empty()) return print_only_listens(options, terminal);
    if (!listens && !is_known(replies.status.stations, options.station)) {
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
