// SPDX-License-Identifier: Apache-2.0
// Asks the machine, and the daemon if there is one.
#include "dpctl/tune/tune.hpp"

#include "dpctl/cli/argument_kinds.hpp"
#include "dpctl/cli/words.hpp"
#include "dpctl/commands/commands.hpp"

#include <algorithm>
#include <filesystem>

namespace dpslave::dpctl {
namespace {

struct TuneOptions {
    std::string port; ///< a tty; empty = the daemon's
};

void set_up(CLI::App& app, TuneOptions& options)
{
    add_text(app, "PORT", options.port, "",
             "A tty, which is not opened; default: that of the running daemon");
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
Reply quietly(Session& session, std::string_view method)
{
    const auto reply = session.call(method);
    if (!reply) return {};
    return report::read<Reply>(session.json() ? *reply : printable_texts(*reply));
}

int run(const TuneOptions& options, Session& session)
{
    TuneFacts facts;
    std::string path = options.port;
    report::GetStatusReply status;
    if (path.empty()) {
        const auto reply = session.ask("GetStatus");
        if (!reply) {
            if (reply.error() == kNoDaemon)
                session.terminal().err
                    << "dpctl tune checks the port of the running dpslaved. If none runs, name the port: dpctl tune /dev/ttyS1\n";
            return reply.error();
        }
        report::take(*reply, status);
    } else {
        status = quietly<report::GetStatusReply>(session, "GetStatus");
    }
    const std::string& served = status.bus.port;
    if (path.empty()) path = served;
    facts.machine = io::read_machine("/");
    facts.port = io::read_port("/", path);
    facts.users = io::users_of_port(path, static_cast<int>(status.pid));
    if (!served.empty() && same_port(path, served)) {
        facts.bus = bus_facts(status.bus, quietly<report::GetInfoReply>(session, "GetInfo"),
                              quietly<report::GetCountersReply>(session, "GetCounters"));
        facts.bus->pid = static_cast<int>(status.pid);
        read_threads(*facts.bus);
    }

    const std::vector<RateJudgment> rates = judge_rates(facts);
    const std::vector<TuneFinding> findings = tune_findings(facts, rates);
    session.print(tune_json(facts, rates, findings),
                  [&] { return render_tune(facts, rates, findings, session.terminal().look()); });
    return std::any_of(findings.begin(), findings.end(),
                       [](const TuneFinding& one) { return one.severity == Severity::mend; })
               ? kNo
               : kFine;
}

} // namespace

const Command kTune{
    "tune",
    kLook,
    "Says which rates this machine can hold, and what would improve it",
    add<TuneOptions>,
    kOwnForm,
    "dpctl tune               the port of the running daemon, with what was measured\n"
    "dpctl tune /dev/ttyS1    this port, if no daemon runs yet",
    "1 the rate of the bus cannot be held or something must be corrected, 3 no PORT and no daemon"};

} // namespace dpslave::dpctl
