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

std::optional<std::uint64_t> unsigned_of(std::optional<std::int64_t> value)
{
    return value && *value >= 0 ? std::optional{static_cast<std::uint64_t>(*value)} : std::nullopt;
}

std::optional<std::uint64_t> counter(const report::CounterGroup& group, std::string_view name)
{
    for (const report::Counter& one : group.counters)
        if (one.name == name) return unsigned_of(one.value);
    return std::nullopt;
}

Traffic traffic_of(const report::GetCountersReply& counters)
{
    static const report::CounterGroup kNothing;
    const report::CounterGroup* bus = &kNothing;
    for (const report::CounterGroup& group : counters.groups)
        if (group.name == "bus") bus = &group;
    Traffic traffic;
    const std::uint64_t replies = counter(*bus, "replies").value_or(0);
    traffic.replies = replies - std::min(replies, counter(*bus, "unsent").value_or(0));
    traffic.too_late = counter(*bus, "late").value_or(0) + counter(*bus, "too_late").value_or(0);
    traffic.overtaken = counter(*bus, "overtaken").value_or(0);
    traffic.repeated = counter(*bus, "retries").value_or(0);
    for (const report::Distribution& one : counters.turnaround) {
        if (one.unit != "us") continue;
        traffic.measured = unsigned_of(one.count).value_or(0);
        traffic.p999_us = unsigned_of(one.p999);
        traffic.highest_us = unsigned_of(one.highest);
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

/// Asks the daemon once: one that is not there, or does not answer, is none.
template <class Reply>
Reply quietly(const Options& options, std::string_view method)
{
    auto client = control::Client::connect(options.socket, options.timeout());
    if (!client) return {};
    auto reply = client->call(method, Json::object());
    if (!reply || !reply->error.empty()) return {};
    return report::read<Reply>(options.json ? std::move(reply->parameters)
                                            : printable_texts(std::move(reply->parameters)));
}

} // namespace

BusFacts bus_facts(const report::Bus& bus, const report::GetInfoReply& info,
                   const report::GetCountersReply& counters)
{
    BusFacts facts;
    if (bus.baud > 0 && bus.baud_state != "Baud_Search")
        facts.baud = baud_of(static_cast<std::uint32_t>(bus.baud));
    for (const report::Info& station : info.stations) {
        for (std::size_t i = 0; i < std::min(station.bauds.size(), station.max_tsdr.size()); ++i) {
            const auto known = baud_of(static_cast<std::uint32_t>(station.bauds[i]));
            if (!known) continue;
            auto& promised = facts.promised[index_of(*known)];
            const auto time = static_cast<std::uint32_t>(station.max_tsdr[i]);
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
    report::GetStatusReply status;
    if (path.empty()) {
        const auto reply = ask(options, terminal, "GetStatus", Json::object());
        if (!reply) {
            if (reply.error() == kNoDaemon)
                terminal.err
                    << "dpctl tune checks the port of the running dpslaved. If none runs, name the port: "
                       "dpctl tune /dev/ttyS1\n";
            return reply.error();
        }
        report::take(*reply, status);
    } else {
        status = quietly<report::GetStatusReply>(options, "GetStatus");
    }
    const std::string& served = status.bus.port;
    if (path.empty()) path = served;
    facts.machine = io::read_machine("/");
    facts.port = io::read_port("/", path);
    if (!served.empty() && same_port(path, served)) {
        facts.bus = bus_facts(status.bus, quietly<report::GetInfoReply>(options, "GetInfo"),
                              quietly<report::GetCountersReply>(options, "GetCounters"));
        facts.bus->pid = static_cast<int>(status.pid);
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
