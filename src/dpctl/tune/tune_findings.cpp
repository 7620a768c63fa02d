// SPDX-License-Identifier: Apache-2.0
// What is in the way of a quick reply, what it costs, and what to type. Source: wire reference 11.
#include "dpctl/cli/words.hpp"
#include "tune.hpp"
#include "tune_uart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>

namespace dpslave::dpctl {

using io::UartKind;

namespace {

using Findings = std::vector<TuneFinding>;

/// Costs are given at the rate of the bus, or at the highest up to 187.5 kbit/s that the machine may hold.
Baud rate_of_costs(const TuneFacts& facts, const std::vector<RateJudgment>& rates)
{
    if (facts.bus && facts.bus->baud) return *facts.bus->baud;
    Baud highest = Baud::k9_6;
    for (const RateJudgment& one : rates)
        if (one.verdict != Verdict::cannot && one.baud <= Baud::k187_5) highest = one.baud;
    return highest;
}

std::string text_of(Baud baud)
{
    return rate(static_cast<std::uint32_t>(baud));
}

std::uint64_t bit_times(std::uint64_t us, Baud baud)
{
    return (us * static_cast<std::uint32_t>(baud) + 999'999) / 1'000'000;
}

std::string cost_of(std::uint64_t us, Baud baud)
{
    return fmt::format("{} us: {} bit times at {}", us, bit_times(us, baud), text_of(baud));
}

const RateJudgment* judged(const std::vector<RateJudgment>& rates, Baud baud)
{
    for (const RateJudgment& one : rates)
        if (one.baud == baud) return &one;
    return nullptr;
}

void configured_rate(const TuneFacts& facts, const std::vector<RateJudgment>& rates, Findings& out)
{
    const auto none = std::all_of(rates.begin(), rates.end(),
                                  [](const auto& one) { return one.verdict == Verdict::cannot; });
    if (none) {
        out.push_back({Severity::mend,
                       "port.no_rate",
                       facts.port.path + " cannot serve a bus: " + rates.front().reason,
                       "everything",
                       {}});
        if (uart_of(facts.port) == UartKind::mini)
            out.back().steps = {
                "Raspberry Pi: write dtoverlay=disable-bt (or miniuart-bt) into config.txt, restart, and use /dev/ttyAMA0"};
        else
            out.back().steps = {
                "Name another port: the serial ports of this machine are listed by ls -l /sys/class/tty/*/device"};
        return;
    }
    const RateJudgment* now = facts.bus && facts.bus->baud ? judged(rates, *facts.bus->baud) : nullptr;
    if (now == nullptr) return;
    const std::string at = text_of(now->baud);
    if (now->verdict == Verdict::cannot) {
        out.push_back({Severity::mend,
                       "rate.cannot",
                       fmt::format("The bus runs at {}: {}", at, now->reason),
                       "the master waits, asks again, and treats the station as lost",
                       {}});
        for (auto one = rates.rbegin(); one != rates.rend(); ++one)
            if (one->verdict == Verdict::holds) {
                out.back().steps.push_back(
                    "Set the master to " + text_of(one->baud) +
                    ", the highest rate that this machine holds, or correct what is named below");
                break;
            }
        if (out.back().steps.empty()) out.back().steps = {"Correct what is named below"};
    } else if (now->needed > now->promised && !facts.port.pty) { // no master waits for a pty
        out.push_back(
            {Severity::mend,
             "rate.max_tsdr",
             fmt::format("At {} this machine may need {} bit times to begin a reply, and {} are promised", at,
                         now->needed, now->promised),
             "replies that are not sent, because the master does not wait for them",
             {fmt::format("Write max_tsdr = {} under [bus], and restart dpslaved", now->needed),
              fmt::format(
                  "Give the master the GSD that dpctl gsd make --max-tsdr {} writes, so that it waits as long",
                  now->needed)}});
    } else if (now->verdict == Verdict::doubtful) {
        out.push_back({Severity::better,
                       "rate.doubtful",
                       fmt::format("{}: {}", at, now->reason),
                       "a retry of the master, from time to time",
                       {"Let it run for a day, then ask again: dpctl tune"}});
    }
}

void uart(const TuneFacts& facts, Findings& out)
{
    const io::PortFacts& port = facts.port;
    const UartKind kind = uart_of(port);
    if (is_16550(kind) && port.uart_clock && std::abs(divisor_error(*port.uart_clock, Baud::k187_5)) > 1)
        out.push_back(
            {Severity::know,
             "uart.clock",
             fmt::format("The UART makes {} bit/s and whole fractions of it, nothing else (clock {} MHz)",
                         *port.uart_clock / 16, *port.uart_clock / 1e6),
             "the rates that are not such a fraction",
             {"For other rates use a UART whose clock is a multiple of 24 MHz: its rates are exact from 93.75 kbit/s up"}});
    const std::string trigger = "/sys/class/tty/" + port.name + "/rx_trig_bytes";
    if (io::is_8250(kind) && port.trigger.value_or(1) > 1) {
        TuneFinding finding{
            Severity::better,
            "uart.trigger",
            fmt::format(
                "The UART hands on what it received {} characters at a time, fewer only after 44 bit times of silence",
                *port.trigger),
            "33 bit times at every rate",
            {}};
        if (port.trigger_settable)
            finding.steps = {"echo 1 > " + trigger +
                                 "   (dpslaved does it when it opens the port, if it may)",
                             "For every start: a udev rule with ATTR{rx_trig_bytes}=\"1\""};
        else
            finding.steps = {"The driver does not let it be set: leave room for it in max_tsdr"};
        out.push_back(std::move(finding));
    }
    if (kind == UartKind::pl011 || kind == UartKind::imx || kind == UartKind::unknown) {
        const std::uint32_t timeout = idle_timeout(port);
        out.push_back(
            {Severity::know,
             "uart.idle_timeout",
             fmt::format(
                 "The UART keeps fewer characters than its trigger until the line was idle for {} bit times{}",
                 timeout, kind == UartKind::unknown ? " at most, as far as is known" : ""),
             fmt::format("{} bit times at every rate", timeout - kCharacter.count),
             {"The driver has no setting for it: the figures above have room for it"}});
    }
    if (port.dma)
        out.push_back({Severity::better,
                       "uart.dma",
                       "The receiver has a DMA channel, which may hold characters back",
                       "a delay that differs by driver",
                       {"Delete dmas and dma-names of this UART in an overlay of the device tree"}});
}

void usb(const TuneFacts& facts, Baud baud, Findings& out)
{
    const io::PortFacts& port = facts.port;
    const UartKind kind = uart_of(port);
    if (!io::is_usb(kind)) return;
    if (kind == UartKind::ftdi && port.latency_timer_ms.value_or(1) > 1)
        out.push_back({Severity::better,
                       "usb.latency_timer",
                       fmt::format("The adapter gathers characters for {} ms", *port.latency_timer_ms),
                       cost_of(static_cast<std::uint64_t>(*port.latency_timer_ms - 1) * 1000, baud),
                       {"echo 1 > /sys/class/tty/" + port.name +
                            "/device/latency_timer   (dpslaved does it when it opens the port, if it may)",
                        "For every start: a udev rule with ATTR{latency_timer}=\"1\""}});
    out.push_back(
        {Severity::know,
         "usb.adapter",
         fmt::format("A USB adapter (driver {}): USB moves characters once a frame of 1 ms, both ways",
                     port.driver.empty() ? "?" : port.driver),
         "about " + cost_of(4000, baud),
         {"A UART on the board answers ten times sooner. For tests, and for 9.6 and 19.2 kbit/s, an FT232R is the best of these"}});
}

std::string rt_package(const std::string& release)
{
    for (const char* flavour : {"amd64", "arm64", "armmp"})
        if (const std::string end = std::string{"-"} + flavour;
            release.size() > end.size() && release.compare(release.size() - end.size(), end.size(), end) == 0)
            return std::string{"apt install linux-image-rt-"} + flavour + ", then restart the machine";
    return "Install the PREEMPT_RT kernel of this board or distribution (Debian: linux-image-rt-amd64, -arm64, -armmp)";
}

void kernel(const TuneFacts& facts, Baud baud, Findings& out)
{
    const io::MachineFacts& machine = facts.machine;
    if (!machine.preempt_rt && !io::is_usb(uart_of(facts.port)) && !facts.port.pty)
        out.push_back(
            {Severity::better,
             "kernel.stock",
             fmt::format("The kernel {} is not PREEMPT_RT: plan with 1000 to 2500 us instead of 300",
                         machine.release.empty() ? "of this machine" : machine.release),
             fmt::format("700 to 2200 us: {} to {} bit times at {}", bit_times(700, baud),
                         bit_times(2200, baud), text_of(baud)),
             {rt_package(machine.release)}});
    if (machine.virtual_machine)
        out.push_back({Severity::know,
                       "kernel.virtual",
                       "This is a virtual machine: its host may stop it at any time",
                       "milliseconds, from time to time",
                       {"Serve a real bus from real hardware"}});
    if (machine.rt_runtime_us == 0)
        out.push_back({Severity::mend,
                       "kernel.no_realtime",
                       "The kernel gives real-time threads no time at all",
                       "the bus thread never runs",
                       {"sysctl kernel.sched_rt_runtime_us=950000"}});
}

void processors(const TuneFacts& facts, Baud baud, Findings& out)
{
    const io::MachineFacts& machine = facts.machine;
    if (!machine.governors.empty() && machine.governors != std::vector<std::string>{"performance"}) {
        std::string names;
        for (const std::string& one : machine.governors) names += (names.empty() ? "" : ", ") + one;
        out.push_back({Severity::better,
                       "cpu.governor",
                       "The frequency of the processors changes (governor " + names + ")",
                       "the first instructions after a pause run at the lowest frequency",
                       {"cpupower frequency-set -g performance   (package linux-cpupower)"}});
    }
    constexpr int kShallow = 50;
    const int sleeps =
        std::min(machine.idle_exit_us.value_or(0), machine.latency_limit_us.value_or(1'000'000));
    if (sleeps > kShallow)
        out.push_back(
            {Severity::better,
             "cpu.idle",
             fmt::format("An idle processor may enter an idle state ({}) that takes {} us to leave",
                         machine.deepest_idle, *machine.idle_exit_us),
             cost_of(static_cast<std::uint64_t>(sleeps), baud),
             {"cpupower idle-set -D 10   switches off the states that take more than 10 us to leave (until the next start)"}});
    if (machine.processors == 1)
        out.push_back({Severity::know,
                       "cpu.single",
                       "There is one processor: the bus thread shares it with everything",
                       "",
                       {}});
}

std::string shown(const io::ThreadFacts& thread)
{
    switch (thread.policy) {
        case io::Policy::fifo: return fmt::format("SCHED_FIFO {}", thread.priority);
        case io::Policy::round_robin: return fmt::format("SCHED_RR {}", thread.priority);
        case io::Policy::deadline: return "SCHED_DEADLINE";
        case io::Policy::ordinary: break;
    }
    return "ordinary scheduling";
}

/// How the interrupt's thread gets above the bus thread, which has `ours`.
std::vector<std::string> lift_above(int ours, const io::ThreadFacts& irq, int usual)
{
    constexpr int kHighest = 99; // of SCHED_FIFO
    if (ours < kHighest) return {fmt::format("chrt -f -p {} {}", std::min(ours + 5, kHighest), irq.id)};
    return {fmt::format("priority = {} under [realtime], and restart dpslaved: nothing goes above {}", usual,
                        kHighest),
            "Then ask again, dpctl tune: the restart makes a new thread of the interrupt"};
}

void threads(const TuneFacts& facts, Findings& out)
{
    constexpr int kDefaultPriority = 80; // [realtime] priority
    const io::MachineFacts& machine = facts.machine;
    const auto bus = facts.bus ? facts.bus->thread : std::nullopt;
    const int ours = bus && bus->is_realtime() ? bus->priority : kDefaultPriority;
    const auto& irq = facts.port.irq_thread;
    if (irq && irq->priority <= ours) // above it, not beside it: wire reference 11.1
        out.push_back(
            {Severity::better, "irq.priority",
             fmt::format("The thread of the port's interrupt ({}) has {}, the bus thread {}", irq->name,
                         shown(*irq), bus ? shown(*bus) : fmt::format("SCHED_FIFO {} by default", ours)),
             "whatever runs between the two priorities, and the bus thread's own spinning",
             lift_above(ours, *irq, kDefaultPriority)});
    const bool slow = std::any_of(machine.unbound_workers.begin(), machine.unbound_workers.end(),
                                  [](const auto& one) { return !one.is_realtime(); });
    if (slow && machine.preempt_rt && !facts.port.pty)
        out.push_back(
            {Severity::know,
             "kworker.priority",
             "A kernel worker of ordinary priority (kworker/u...) carries characters from driver to reader",
             "seen on PREEMPT_RT: 15 to 20 ms, two or three times in 1 to 2 hours. The master's retry covers it",
             {"Keep busy real-time programs off the processors where the workers run",
              "for p in $(pgrep kworker/u); do chrt -f -p 60 $p; done   (workers end and new ones start: again by a timer)"}});
    for (const io::ThreadFacts& one : machine.realtime_threads)
        if (bus && one.id != bus->id && one.priority >= ours)
            out.push_back({Severity::better,
                           "thread.rival",
                           fmt::format("Thread {} of another program, '{}', has {}: not below the bus thread",
                                       one.id, one.name, shown(one)),
                           "seen on a Raspberry Pi 4: 250 us instead of 60",
                           {fmt::format("chrt -o -p 0 {}   or stop that program", one.id)}});
}

/// The processors in a list of the kernel ("0-2,5"); nothing = it is none.
std::optional<std::set<int>> processors_in(std::string_view list)
{
    constexpr int kMost = 8192; // CONFIG_NR_CPUS of the largest machines
    std::set<int> out;
    const char* const end = list.data() + list.size();
    for (const char* at = list.data();; ++at) {
        int first = 0;
        auto read = std::from_chars(at, end, first);
        int last = first;
        if (read.ec == std::errc{} && read.ptr != end && *read.ptr == '-')
            read = std::from_chars(read.ptr + 1, end, last);
        if (read.ec != std::errc{} || first < 0 || last < first || last >= kMost) return std::nullopt;
        for (int one = first; one <= last; ++one) out.insert(one);
        at = read.ptr;
        if (at == end) return out;
        if (*at != ',') return std::nullopt;
    }
}

void isolation(const TuneFacts& facts, Findings& out)
{
    const io::MachineFacts& machine = facts.machine;
    if (machine.isolated.empty()) {
        if (machine.processors > 1 && !facts.port.pty)
            out.push_back(
                {Severity::know,
                 "cpu.isolated",
                 "No processor is kept free for the bus",
                 "caches and interrupts of other programs: some 10 us",
                 {fmt::format("isolcpus={0} on the kernel's command line, and cpu = {0} under [realtime]",
                              machine.processors - 1)}});
        return;
    }
    if (!facts.bus || !facts.bus->thread) return;
    const std::string& runs_on = facts.bus->thread->cpus;
    const auto isolated = processors_in(machine.isolated), used = processors_in(runs_on);
    if (!isolated || !used) return;
    if (std::includes(isolated->begin(), isolated->end(), used->begin(), used->end())) return;
    out.push_back({Severity::better,
                   "cpu.not_pinned",
                   fmt::format("{} isolated, but the bus thread runs on {}",
                               isolated->size() == 1 ? "Processor " + machine.isolated + " is"
                                                     : "Processors " + machine.isolated + " are",
                               runs_on),
                   "the isolation has no effect",
                   {fmt::format("cpu = {} under [realtime]", *isolated->begin())}});
}

void daemon(const TuneFacts& facts, Findings& out)
{
    if (!facts.bus) return;
    const BusFacts& bus = *facts.bus;
    if (bus.thread && !bus.thread->is_realtime())
        out.push_back(
            {Severity::better,
             "daemon.ordinary",
             "The bus thread runs with ordinary scheduling",
             "a busy machine delays replies by whole time slices: 2500 us and more",
             {"priority = 80 under [realtime], and the permission for it: LimitRTPRIO=80 in the unit"}});
    if (bus.locked_kib == std::uint64_t{0})
        out.push_back(
            {Severity::better,
             "daemon.not_locked",
             "The daemon's memory is not locked",
             "milliseconds when memory is short",
             {"lock_memory = true under [realtime], and the permission for it: LimitMEMLOCK=infinity in the unit"}});
    const std::uint64_t faults = std::max(bus.traffic.page_faults, bus.thread ? bus.thread->major_faults : 0);
    if (faults > 0)
        out.push_back({Severity::better,
                       "daemon.page_faults",
                       plural(static_cast<std::int64_t>(faults), "page fault") +
                           " of the bus thread since it serves the bus",
                       "some us each, milliseconds from a disk",
                       {"lock_memory = true under [realtime]"}});
}

} // namespace

std::string_view text(Severity severity)
{
    switch (severity) {
        case Severity::mend: return "mend";
        case Severity::better: return "better";
        case Severity::know: break;
    }
    return "know";
}

std::vector<TuneFinding> tune_findings(const TuneFacts& facts, const std::vector<RateJudgment>& rates)
{
    Findings out;
    const Baud baud = rate_of_costs(facts, rates);
    configured_rate(facts, rates, out);
    if (facts.port.there && (facts.port.serial || facts.port.pty)) {
        uart(facts, out);
        usb(facts, baud, out);
    }
    if (auto shared = shared_port(facts.users)) out.push_back(std::move(*shared));
    kernel(facts, baud, out);
    processors(facts, baud, out);
    threads(facts, out);
    isolation(facts, out);
    daemon(facts, out);
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& one, const auto& other) { return one.severity < other.severity; });
    return out;
}

} // namespace dpslave::dpctl
