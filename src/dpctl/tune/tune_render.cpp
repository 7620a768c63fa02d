// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/table.hpp"
#include "dpctl/cli/words.hpp"
#include "tune.hpp"
#include "tune_uart.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {

using io::UartKind;

namespace {

std::string kernel_words(const io::MachineFacts& machine)
{
    return (machine.release.empty() ? "?" : machine.release) +
           (machine.preempt_rt      ? ", PREEMPT_RT"
            : machine.threaded_irqs ? ", stock, threaded interrupts"
                                    : ", stock") +
           (machine.virtual_machine ? ", virtual machine" : "");
}

std::string processor_words(const io::MachineFacts& machine)
{
    std::string out = machine.processors > 0 ? std::to_string(machine.processors) : "?";
    out += machine.isolated.empty() ? ", none isolated" : ", isolated: " + machine.isolated;
    std::string governors;
    for (const std::string& one : machine.governors) governors += (governors.empty() ? "" : "/") + one;
    out += governors.empty() ? ", fixed frequency" : ", governor " + governors;
    if (machine.idle_exit_us)
        out += fmt::format(", deepest idle state {} ({} us)", machine.deepest_idle, *machine.idle_exit_us);
    if (machine.latency_limit_us) out += fmt::format(", held at {} us", *machine.latency_limit_us);
    if (machine.rt_runtime_us && *machine.rt_runtime_us >= 0)
        out += fmt::format(", real time {} ms of each second", *machine.rt_runtime_us / 1000);
    return out;
}

std::string_view uart_words(UartKind uart)
{
    switch (uart) {
        case UartKind::pty: return "pty";
        case UartKind::i8250:
        case UartKind::i8250_kin: return "8250 family";
        case UartKind::omap: return "8250_omap";
        case UartKind::pl011: return "PL011";
        case UartKind::imx: return "i.MX";
        case UartKind::mediatek: return "MediaTek";
        case UartKind::mini: return "mini-UART";
        case UartKind::ftdi: return "FTDI";
        case UartKind::usb_other: return "USB adapter";
        case UartKind::unknown: break;
    }
    return "unknown UART";
}

std::string scheduling(const io::ThreadFacts& thread)
{
    if (!thread.is_realtime()) return "ordinary";
    return fmt::format("{} {}", thread.policy == io::Policy::round_robin ? "RR" : "FIFO", thread.priority);
}

std::string port_words(const io::PortFacts& port)
{
    if (!port.there) return port.path + ", not there";
    std::string out = port.path;
    if (port.path != "/dev/" + port.name) out += " (" + port.name + ")";
    if (!port.pty && !port.serial) return out + ", no serial port";
    out += fmt::format(", {}", uart_words(uart_of(port)));
    if (!port.driver.empty()) out += ", driver " + port.driver;
    if (port.fifo) out += fmt::format(", FIFO {}", *port.fifo);
    if (port.trigger) out += fmt::format(", receive trigger {}", *port.trigger);
    if (port.latency_timer_ms) out += fmt::format(", latency timer {} ms", *port.latency_timer_ms);
    if (port.uart_clock) out += fmt::format(", clock {} MHz", *port.uart_clock / 1e6);
    if (port.dma) out += ", DMA";
    if (port.irq) out += fmt::format(", IRQ {}", *port.irq);
    if (port.irq_thread)
        out += fmt::format(" (thread {}: {})", port.irq_thread->id, scheduling(*port.irq_thread));
    return out;
}

std::string bus_words(const std::optional<BusFacts>& bus)
{
    if (!bus) return "none on this port: planning figures are used";
    std::string out =
        fmt::format("pid {}, {}", bus->pid,
                    bus->baud ? rate(static_cast<std::uint32_t>(*bus->baud)) : "searching the rate");
    if (bus->thread) out += fmt::format(", bus thread {} on {}", scheduling(*bus->thread), bus->thread->cpus);
    if (bus->locked_kib) out += *bus->locked_kib > 0 ? ", memory locked" : ", memory not locked";
    out += fmt::format(", {} replies", bus->traffic.replies);
    if (bus->traffic.p999_us) out += fmt::format(", 99.9 % within {} us", *bus->traffic.p999_us);
    if (bus->traffic.highest_us) out += fmt::format(", slowest {} us", *bus->traffic.highest_us);
    return out;
}

std::string facts_block(const TuneFacts& facts, Look look)
{
    Block block;
    block.add("kernel", kernel_words(facts.machine));
    block.add("processors", processor_words(facts.machine));
    block.add("port", port_words(facts.port));
    block.add("daemon", bus_words(facts.bus));
    return block.str(2, look);
}

Tone tone_of(Verdict verdict)
{
    return verdict == Verdict::holds ? Tone::good : verdict == Verdict::cannot ? Tone::bad : Tone::strong;
}

/// The rate of the running daemon has a mark.
std::string rate_lines(const TuneFacts& facts, const std::vector<RateJudgment>& rates, Look look)
{
    std::optional<Baud> now;
    if (facts.bus) now = facts.bus->baud;
    Table table({">RATE", "VERDICT", ">NEEDS", ">PROMISED", "WHY"});
    for (const RateJudgment& one : rates)
        table.add({(one.baud == now ? "> " : "") + rate(static_cast<std::uint32_t>(one.baud)),
                   Cell{std::string{text(one.verdict)}, tone_of(one.verdict)},
                   one.needed > 0 ? std::to_string(one.needed) : "-", std::to_string(one.promised),
                   one.reason});
    return table.str(look) +
           "  NEEDS, PROMISED: MaxTsdr in bit times. More needed than promised: write\n"
           "  max_tsdr under [bus], and give the master the GSD of dpctl gsd make --max-tsdr\n";
}

std::string finding_text(const TuneFinding& finding, int number, Look look)
{
    const std::string head = number > 0 ? fmt::format("{}. ", number) : std::string{"note: "};
    const Tone tone = finding.severity == Severity::mend ? Tone::bad : Tone::strong;
    std::string out = '\n' + title(head + finding.what, tone, look);
    if (!finding.cost.empty()) out += paragraph("   costs ", finding.cost, look.width);
    for (const std::string& step : finding.steps) out += paragraph("   - ", step, look.width);
    return out;
}

Json thread_json(const std::optional<io::ThreadFacts>& thread)
{
    if (!thread) return nullptr;
    constexpr std::array kPolicies{"ordinary", "fifo", "round_robin", "deadline"};
    return {{"id", thread->id},
            {"name", thread->name},
            {"policy", kPolicies[static_cast<std::size_t>(thread->policy)]},
            {"priority", thread->priority},
            {"cpus", thread->cpus}};
}

template <class T>
Json or_null(const std::optional<T>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

Json machine_json(const io::MachineFacts& machine)
{
    return {{"kernel", machine.release},
            {"preempt_rt", machine.preempt_rt},
            {"threaded_irqs", machine.threaded_irqs},
            {"rt_runtime_us", or_null(machine.rt_runtime_us)},
            {"processors", machine.processors},
            {"isolated", machine.isolated},
            {"governors", machine.governors},
            {"idle_exit_us", or_null(machine.idle_exit_us)},
            {"latency_limit_us", or_null(machine.latency_limit_us)},
            {"virtual_machine", machine.virtual_machine}};
}

Json port_json(const io::PortFacts& port)
{
    return {{"path", port.path},
            {"name", port.name},
            {"uart", uart_words(uart_of(port))},
            {"driver", port.driver},
            {"usb", port.usb},
            {"clock_hz", or_null(port.uart_clock)},
            {"fifo", or_null(port.fifo)},
            {"trigger", or_null(port.trigger)},
            {"latency_timer_ms", or_null(port.latency_timer_ms)},
            {"dma", port.dma},
            {"irq", or_null(port.irq)},
            {"irq_thread", thread_json(port.irq_thread)}};
}

Json daemon_json(const std::optional<BusFacts>& bus)
{
    if (!bus) return nullptr;
    return {{"pid", bus->pid},
            {"baud", bus->baud ? Json(static_cast<std::uint32_t>(*bus->baud)) : Json(nullptr)},
            {"bus_thread", thread_json(bus->thread)},
            {"locked_kib", or_null(bus->locked_kib)},
            {"replies", bus->traffic.replies},
            {"too_late", bus->traffic.too_late},
            {"overtaken", bus->traffic.overtaken},
            {"repeated", bus->traffic.repeated},
            {"p999_us", or_null(bus->traffic.p999_us)},
            {"highest_us", or_null(bus->traffic.highest_us)},
            {"page_faults", bus->traffic.page_faults}};
}

} // namespace

Json tune_json(const TuneFacts& facts, const std::vector<RateJudgment>& rates,
               const std::vector<TuneFinding>& findings)
{
    Json judged = Json::array(), found = Json::array();
    for (const RateJudgment& one : rates)
        judged.push_back({{"baud", static_cast<std::uint32_t>(one.baud)},
                          {"verdict", text(one.verdict)},
                          {"needed_tbit", one.needed > 0 ? Json(one.needed) : Json(nullptr)},
                          {"promised_tbit", one.promised},
                          {"error_percent", or_null(one.error_percent)},
                          {"reason", one.reason}});
    for (const TuneFinding& one : findings)
        found.push_back({{"severity", text(one.severity)},
                         {"name", one.name},
                         {"what", one.what},
                         {"cost", one.cost},
                         {"steps", one.steps}});
    return {{"machine", machine_json(facts.machine)},
            {"port", port_json(facts.port)},
            {"daemon", daemon_json(facts.bus)},
            {"rates", std::move(judged)},
            {"findings", std::move(found)}};
}

std::string render_tune(const TuneFacts& facts, const std::vector<RateJudgment>& rates,
                        const std::vector<TuneFinding>& findings, Look look)
{
    std::string out = facts_block(facts, look) + '\n' + rate_lines(facts, rates, look);
    int number = 0;
    for (const TuneFinding& one : findings)
        if (one.severity != Severity::know) out += finding_text(one, ++number, look);
    if (number == 0) out += '\n' + painted("nothing to correct", Tone::good, look) + '\n';
    for (const TuneFinding& one : findings)
        if (one.severity == Severity::know) out += finding_text(one, 0, look);
    return out;
}

} // namespace dpslave::dpctl
