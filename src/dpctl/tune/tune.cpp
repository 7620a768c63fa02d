// SPDX-License-Identifier: Apache-2.0
// The command: asks the machine, and the daemon if there is one.
#include "tune.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/subcommands.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace dpslave::dpctl {
namespace {

std::optional<std::uint64_t> unsigned_at(const Json& object, const char* key)
{
    const auto value = integer(object, key);
    return value && *value >= 0 ? std::optional{static_cast<std::uint64_t>(*value)} : std::nullopt;
}

std::optional<std::uint64_t> counter(const Json& group, std::string_view name)
{
    for (const Json& one : list(group, "counters"))
        if (text(one, "name") == name) return unsigned_at(one, "value");
    return std::nullopt;
}

Traffic traffic_of(const Json& counters)
{
    static const Json nothing = Json::object();
    const Json* bus = &nothing;
    for (const Json& group : list(counters, "groups"))
        if (text(group, "name") == "bus") bus = &group;
    Traffic traffic;
    const std::uint64_t replies = counter(*bus, "replies").value_or(0);
    traffic.replies = replies - std::min(replies, counter(*bus, "unsent").value_or(0));
    traffic.too_late = counter(*bus, "late").value_or(0) + counter(*bus, "too_late").value_or(0);
    traffic.overtaken = counter(*bus, "overtaken").value_or(0);
    traffic.repeated = counter(*bus, "retries").value_or(0);
    for (const Json& one : list(counters, "turnaround")) {
        if (text(one, "unit") != "us") continue;
        traffic.measured = unsigned_at(one, "count").value_or(0);
        traffic.p999_us = unsigned_at(one, "p999");
        traffic.highest_us = unsigned_at(one, "highest");
    }
    traffic.page_faults = counter(*bus, "page_faults").value_or(0);
    return traffic;
}

/// The same device, whatever links lead to it.
bool same_port(const std::string& one, const std::string& other)
{
    std::error_code error;
    return one == other || std::filesystem::equivalent(one, other, error);
}

void read_threads(BusFacts& bus)
{
    const auto process = io::read_process("/", bus.pid);
    if (!process) return;
    bus.locked_kib = process->locked_kib;
    for (const io::ThreadFacts& thread : process->threads)
        if (thread.name == "bus") bus.thread = thread;
}

/// Asks nobody twice: a daemon that is not there, or does not answer, is none.
std::optional<Json> quietly(const Options& options, std::string_view method)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return std::nullopt;
    auto reply = client->call(method, Json::object());
    if (!reply || !reply->error.empty()) return std::nullopt;
    return options.json ? std::move(reply->parameters) : printable_texts(std::move(reply->parameters));
}

} // namespace

BusFacts bus_facts(const Json& bus, const Json& info, const Json& counters)
{
    BusFacts facts;
    const auto baud = integer(bus, "baud");
    if (baud && *baud > 0 && text(bus, "baud_state") != "Baud_Search")
        facts.baud = baud_of(static_cast<std::uint32_t>(*baud));
    for (const Json& station : list(info, "stations")) {
        const Json& bauds = list(station, "bauds");
        const Json& times = list(station, "max_tsdr");
        for (std::size_t i = 0; i < std::min(bauds.size(), times.size()); ++i) {
            if (!bauds[i].is_number_unsigned() || !times[i].is_number_unsigned()) continue;
            const auto known = baud_of(bauds[i].get<std::uint32_t>());
            if (!known) continue;
            auto& promised = facts.promised[index_of(*known)];
            const auto time = times[i].get<std::uint32_t>();
            promised = promised ? std::min(*promised, time) : time;
        }
    }
    facts.traffic = traffic_of(counters);
    return facts;
}

int do_tune(const Options& options, Terminal& terminal)
{
    TuneFacts facts;
    std::string path = options.port;
    const auto status = path.empty()
                            ? ask(options, terminal, "GetStatus", Json::object())
                            : Result<Json, int>{quietly(options, "GetStatus").value_or(Json::object())};
    if (!status) {
        if (status.error() == kNoDaemon)
            terminal.err
                << "dpctl tune judges the port of the running dpslaved. Without one say which port: dpctl "
                   "tune /dev/ttyS1\n";
        return status.error();
    }
    const std::string served = text(part(*status, "bus"), "port", "");
    if (path.empty()) path = served;
    facts.machine = io::read_machine("/");
    facts.port = io::read_port("/", path);
    if (!served.empty() && same_port(path, served)) {
        facts.bus = bus_facts(part(*status, "bus"), quietly(options, "GetInfo").value_or(Json::object()),
                              quietly(options, "GetCounters").value_or(Json::object()));
        facts.bus->pid = static_cast<int>(integer(*status, "pid").value_or(0));
        read_threads(*facts.bus);
    }

    const std::vector<RateJudgment> rates = judge_rates(facts);
    const std::vector<TuneFinding> findings = tune_findings(facts, rates);
    terminal.out << (options.json ? json_text(tune_json(facts, rates, findings)) + '\n'
                                  : render_tune(facts, rates, findings, terminal.look()))
                 << std::flush;
    return std::any_of(findings.begin(), findings.end(),
                       [](const TuneFinding& one) { return one.severity == Severity::mend; })
               ? kNo
               : kFine;
}

} // namespace dpslave::dpctl
