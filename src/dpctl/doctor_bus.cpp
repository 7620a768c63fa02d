// SPDX-License-Identifier: Apache-2.0
// The bus as a whole, by the counters.
#include "doctor_rules.hpp"
#include "words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kBoard = "HA389815 chapter 9";
constexpr std::string_view kBox = "HA463561U002, Troubleshooting";
constexpr std::string_view kGateway = "dpslaved";

constexpr std::int64_t kOften = 1000; ///< one in so many is more than a sound line has

std::int64_t flaws(const Facts& f)
{
    std::int64_t sum = 0;
    for (const Json& counter : list(f.counters, "counters"))
        if (text(counter, "name").starts_with("flaw")) sum += integer(counter, "value").value_or(0);
    return sum;
}

constexpr std::array kLateSteps = std::to_array<std::string_view>({
    "Look at [realtime] in the configuration: priority, cpu and lock_memory keep the machine's other work "
    "away.",
    "Where the machine cannot be faster, set max_tsdr under [bus] and give the master the GSD that `dpctl "
    "gsd make` then writes.",
    "dpctl tune: what holds this machine up, and which rates it can serve.",
    "dpctl counters: do `late`, `too_late` and `overtaken` still grow?",
});
constexpr std::array kDoubleSteps = std::to_array<std::string_view>({
    "Check that no other PROFIBUS-DP slave or master has the same address.",
    "Give this station another address, in the configuration and in the master's project.",
});
constexpr std::array kLineSteps = std::to_array<std::string_view>({
    "Check wiring, paying particular attention to the screening.",
    "Check that the line is not longer than the rate allows (below).",
    "Check that the last device of the segment, and no other but the ends, is terminated. Some equipment has "
    "resistors that can be switched in and out.",
    "dpctl counters: which flaws grow?",
});
constexpr std::array kRetrySteps = std::to_array<std::string_view>({
    "Check that the transceiver is switched to sending in time ([bus] direction) and back at once.",
    "Check wiring and termination: the master hears worse than this gateway does.",
    "dpctl counters: is `late` 0? Else the machine answers too late.",
});
constexpr std::array kPortSteps = std::to_array<std::string_view>({
    "Look at the port ([bus] port): journalctl -u dpslaved says what the system answered.",
});
constexpr std::array kDriverSteps = std::to_array<std::string_view>({
    "Look whether the GPIO chip is there and nobody else has the line (gpioinfo): gpio_chip and gpio_line "
    "under "
    "[bus].",
    "journalctl -u dpslaved says which ways of [bus] direction this port can do.",
    "dpctl counters: do `driver_errors` and `driver_guarded` still grow?",
});

std::string seen_late(const Facts& f)
{
    const std::int64_t late = counted(f, "late"), written_late = counted(f, "too_late"),
                       overtaken = counted(f, "overtaken");
    const std::int64_t all = late + written_late + overtaken;
    if (all < 10 || all * kOften < counted(f, "requests")) return {};
    return fmt::format("{} suppressed because MaxTsdr had passed, {} begun in time and written too late, {} "
                       "dropped because something followed them",
                       late == 1 ? "1 reply was" : fmt::format("{} replies were", late), written_late,
                       plural(overtaken, "request"));
}
std::string seen_double(const Facts& f)
{
    const std::int64_t strange = counted(f, "own_address");
    if (strange == 0) return {};
    return fmt::format("{} of somebody else with one of our addresses as the sender",
                       plural(strange, "telegram"));
}
std::string seen_flaws(const Facts& f)
{
    const std::int64_t bad = flaws(f), good = counted(f, "telegrams");
    if (good == 0 || bad < 10 || bad * kOften < good) return {};
    return fmt::format("{} beside {} valid ones", plural(bad, "bad telegram"), good);
}
std::string seen_retries(const Facts& f)
{
    const std::int64_t retries = counted(f, "retries"), requests = counted(f, "requests");
    if (retries < 10 || retries * kOften < requests) return {};
    return fmt::format("the master asked again {} in {}", plural(retries, "time"),
                       plural(requests, "request"));
}
std::string seen_port(const Facts& f)
{
    const std::int64_t errors = counted(f, "write_errors");
    return errors == 0 ? std::string{}
                       : fmt::format("the port did not take {}",
                                     errors == 1 ? "1 reply" : fmt::format("{} replies", errors));
}
std::string seen_driver(const Facts& f)
{
    const std::int64_t failed = counted(f, "driver_errors"), guarded = counted(f, "driver_guarded");
    if (failed + guarded == 0) return {};
    return fmt::format("{} failed, and the guard let the driver go {}",
                       failed == 1 ? "1 edge" : fmt::format("{} edges", failed), plural(guarded, "time"));
}

constexpr std::array kRules = std::to_array<Rule>({
    {"bus.late", Scope::bus, false,
     "more than one reply in a thousand came too late, or its request was overtaken",
     "This machine answers too late", kLateSteps, kGateway, seen_late},
    {"bus.double_address", Scope::bus, false, "somebody else sends with one of our addresses",
     "External communications fault: an address is used twice", kDoubleSteps, kBoard, seen_double},
    {"bus.flaws", Scope::bus, false, "more than one telegram in a thousand is damaged",
     "Intermittent failure: the line", kLineSteps, kBox, seen_flaws},
    {"bus.retries", Scope::bus, false, "the master repeats more than one request in a thousand",
     "The master does not hear the replies", kRetrySteps, kGateway, seen_retries},
    {"bus.port", Scope::bus, false, "the port does not take replies", "The port of the bus fails", kPortSteps,
     kGateway, seen_port},
    {"bus.driver", Scope::bus, false, "the driver enable cannot be switched, or is not let go in time",
     "The transceiver is not switched as it should be", kDriverSteps, kGateway, seen_driver},
});

} // namespace

std::span<const Rule> bus_rules()
{
    return kRules;
}

} // namespace dpslave::dpctl
