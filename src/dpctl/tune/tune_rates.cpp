// SPDX-License-Identifier: Apache-2.0
// What the machine can promise at each rate (wire reference 11.6).
#include "tune.hpp"
#include "tune_uart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace dpslave::dpctl {

using io::UartKind;

namespace {

// Software parts to plan with, us (wire reference 11.6, [R]).
constexpr std::uint32_t kRealtimeKernel = 300;
constexpr std::uint32_t kStockKernelLow = 1000;
constexpr std::uint32_t kStockKernelHigh = 2500;
constexpr std::uint32_t kUsb = 4000;       // latency timer 1 ms, both ways
constexpr std::uint32_t kFtdiTimerMs = 16; // as the driver leaves it

constexpr std::uint64_t kEnoughReplies = 2000; // fewer say nothing about a thousandth
constexpr double kDirty = 1e-3;                // share of exchanges that went wrong: doubtful above
constexpr double kBroken = 1e-2;               // cannot above
constexpr double kToleranceOfStandard = 0.3;   // percent; wire reference 1.1
constexpr double kTolerance = 1.0;             // percent; wire reference 11.1: reject

/// What the daemon's own work took beyond min T_SDR, which it has to wait anyway.
std::uint32_t excess_us(const BusFacts& bus)
{
    if (!bus.baud || !bus.traffic.highest_us || bus.traffic.measured < kEnoughReplies) return 0;
    const auto wait =
        std::chrono::duration_cast<std::chrono::microseconds>(duration_of(kCharacter, *bus.baud)).count();
    const auto highest = static_cast<std::int64_t>(*bus.traffic.highest_us);
    return static_cast<std::uint32_t>(std::max<std::int64_t>(highest - wait, 0));
}

struct Weighed {
    Verdict verdict;
    std::string reason;
};

/// Doubts that no arithmetic settles.
std::optional<std::string> doubt(const TuneFacts& facts, Baud baud)
{
    const io::PortFacts& port = facts.port;
    const UartKind uart = uart_of(port);
    const auto rate = static_cast<std::uint32_t>(baud);
    if (uart == UartKind::pty) return "a pty is not a real line: for tests only";
    if (io::is_usb(uart)) return "USB gives no bound: measure it";
    if (facts.machine.virtual_machine) return "a virtual machine: measure it";
    if (uart == UartKind::unknown)
        return fmt::format("unknown driver {}: measure it", port.driver.empty() ? "?" : port.driver);
    if (uart == UartKind::mediatek || port.dma) return "DMA holds characters back: measure it";
    // One interrupt for each character (wire reference 11.5).
    if (is_16550(uart) && port.trigger == 1 && baud == Baud::k1500)
        return fmt::format("{} interrupts a second: too many for most boards", rate / kCharacter.count);
    // The 8250 driver refills the transmit FIFO only when it is empty (wire reference 11.5, "Transmit").
    if (is_16550(uart) && port.fifo.value_or(1) <= 16 && baud >= Baud::k500)
        return fmt::format("gaps in replies of more than {} octets, unless the FIFO is refilled within {} us",
                           port.fifo.value_or(1), kCharacter.count * 1'000'000 / rate);
    return std::nullopt;
}

std::string too_long(std::uint32_t low, std::uint32_t high)
{
    const std::string needs = low == high ? std::to_string(high) : fmt::format("{} to {}", low, high);
    return fmt::format("needs {}, masters wait {}{}", needs, kCeiling, low > kCeiling ? "" : ": measure it");
}

/// What the bus itself has shown at the rate that it runs at; nothing = too little was exchanged.
std::optional<Weighed> shown_by_traffic(const TuneFacts& facts, Baud baud)
{
    if (!facts.bus || facts.bus->baud != baud || facts.bus->traffic.replies < kEnoughReplies)
        return std::nullopt;
    const Traffic& traffic = facts.bus->traffic;
    const std::uint64_t wrong = traffic.too_late + traffic.overtaken + traffic.repeated;
    const double share = static_cast<double>(wrong) / static_cast<double>(traffic.replies + wrong);
    if (wrong == 0)
        return Weighed{Verdict::holds,
                       fmt::format("measured: {} replies, none late, none repeated", traffic.replies)};
    const std::string reason =
        fmt::format("measured: {} of {} replies late or repeated", wrong, traffic.replies + wrong);
    if (share > kBroken) return Weighed{Verdict::cannot, reason};
    return Weighed{share > kDirty ? Verdict::doubtful : Verdict::holds, reason};
}

std::string makes_other_rate(double percent, Baud baud)
{
    return fmt::format("UART makes {:.0f} ({:+.2f} %)", static_cast<double>(baud) * (1 + percent / 100),
                       percent);
}

/// What speaks against a rate before any time is looked at; nothing = nothing does.
std::optional<Weighed> uart_refuses(const io::PortFacts& port, std::optional<double> error, Baud baud)
{
    if (!port.pty && !port.serial)
        return Weighed{Verdict::cannot, port.there ? "no serial port" : "no such port"};
    if (uart_of(port) == UartKind::mini) return Weighed{Verdict::cannot, "no parity, and PROFIBUS is 8E1"};
    if (error && std::abs(*error) > kTolerance)
        return Weighed{Verdict::cannot, makes_other_rate(*error, baud)};
    return std::nullopt;
}

} // namespace

std::string_view text(Verdict verdict)
{
    switch (verdict) {
        case Verdict::holds: return "holds";
        case Verdict::doubtful: return "doubtful";
        case Verdict::cannot: break;
    }
    return "cannot";
}

bool is_tuned(const TuneFacts& facts)
{
    constexpr int kShallow = 50; // us to leave an idle state: a sixth of the 300 us that are planned with
    const io::MachineFacts& machine = facts.machine;
    const bool steady = machine.governors.empty() ||
                        (machine.governors.size() == 1 && machine.governors.front() == "performance");
    const int sleeps =
        std::min(machine.idle_exit_us.value_or(0), machine.latency_limit_us.value_or(1'000'000));
    const auto bus = facts.bus ? facts.bus->thread : std::nullopt;
    const bool bus_first = !bus || bus->policy == io::Policy::fifo || bus->policy == io::Policy::round_robin;
    const bool rivals =
        std::any_of(machine.realtime_threads.begin(), machine.realtime_threads.end(), [&](const auto& one) {
            return bus && one.id != bus->id && one.priority >= bus->priority;
        });
    return steady && sleeps <= kShallow && bus_first && !rivals;
}

SoftwarePart software_part(const TuneFacts& facts)
{
    SoftwarePart part{kStockKernelLow, kStockKernelHigh};
    const UartKind uart = uart_of(facts.port);
    if (io::is_usb(uart)) {
        const int timer = facts.port.latency_timer_ms.value_or(uart == UartKind::ftdi ? kFtdiTimerMs : 1);
        part.low_us = part.high_us = kUsb + static_cast<std::uint32_t>(std::max(timer - 1, 0)) * 1000;
    } else if (facts.machine.preempt_rt) {
        part = {kRealtimeKernel, is_tuned(facts) ? kRealtimeKernel : kStockKernelLow};
    }
    if (!facts.bus) return part;
    if (facts.bus->thread && !facts.bus->thread->is_realtime())
        part.high_us = std::max(part.high_us, kStockKernelHigh);
    // What was measured and is worse than planned counts, with half of it on top (wire reference 11.6, [R]).
    const std::uint32_t excess = excess_us(*facts.bus);
    part.low_us = std::max(part.low_us, excess);
    part.high_us = std::max(part.high_us, excess + excess / 2);
    return part;
}

std::uint32_t needed_tsdr(std::uint32_t idle_timeout_tbit, std::uint32_t software_us, Baud baud)
{
    constexpr std::uint64_t kMicro = 1'000'000;
    const std::uint64_t bits = std::uint64_t{software_us} * static_cast<std::uint32_t>(baud);
    return std::max(idle_timeout_tbit, kCharacter.count) +
           static_cast<std::uint32_t>((bits + kMicro - 1) / kMicro);
}

std::vector<RateJudgment> judge_rates(const TuneFacts& facts)
{
    const std::uint32_t timeout = idle_timeout(facts.port);
    const SoftwarePart part = software_part(facts);
    std::vector<RateJudgment> rates;
    for (const Baud baud : kBauds) {
        const std::size_t at = index_of(baud);
        RateJudgment rate;
        rate.baud = baud;
        rate.error_percent = rate_error(facts.port, baud);
        rate.promised =
            facts.bus ? facts.bus->promised[at].value_or(kDefaultMaxTsdr[at]) : kDefaultMaxTsdr[at];
        rate.needed = needed_tsdr(timeout, part.high_us, baud);
        const std::uint32_t low = needed_tsdr(timeout, part.low_us, baud);

        if (const auto refused = uart_refuses(facts.port, rate.error_percent, baud)) {
            std::tie(rate.verdict, rate.reason) = std::pair{refused->verdict, refused->reason};
            rate.needed = 0;
        } else if (const auto shown = shown_by_traffic(facts, baud)) {
            std::tie(rate.verdict, rate.reason) = std::pair{shown->verdict, shown->reason};
            if (shown->verdict == Verdict::holds) rate.needed = std::min(rate.needed, rate.promised);
        } else if (rate.needed > kCeiling) {
            rate.verdict = low > kCeiling ? Verdict::cannot : Verdict::doubtful;
            rate.reason = too_long(low, rate.needed);
        } else if (auto why = doubt(facts, baud)) {
            rate.verdict = Verdict::doubtful;
            rate.reason = *std::move(why);
        } else if (!rate.error_percent || std::abs(*rate.error_percent) > kToleranceOfStandard) {
            rate.verdict = Verdict::doubtful;
            rate.reason = rate.error_percent
                              ? makes_other_rate(*rate.error_percent, baud) + ", 0.3 % is allowed"
                              : "clock of the UART not known: try as root";
        } else {
            rate.reason = rate.needed <= rate.promised ? std::string{"as promised"}
                                                       : fmt::format("with max_tsdr = {}", rate.needed);
        }
        rates.push_back(std::move(rate));
    }
    return rates;
}

} // namespace dpslave::dpctl
