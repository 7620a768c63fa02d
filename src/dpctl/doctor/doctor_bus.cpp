// SPDX-License-Identifier: Apache-2.0
// The bus as a whole, by the counters.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kDriverSteps =
    "Run gpioinfo. Check that gpio_chip under [bus] is there, and that no other program has gpio_line.\n"
    "See which values of [bus] direction this port can do: journalctl -u dpslaved\n"
    "Check whether `driver_errors` and `driver_guarded` still grow: dpctl counters";

constexpr std::int64_t kOften = 1000;  ///< one in so many is more than a sound machine has
constexpr double kBurst = 2'000;       ///< ms: a plug or a switch makes flaws for less than that, once
constexpr std::int64_t kSomeFlaws = 5; ///< in a minute: a sound line has none

/// A telegram with a good checksum that says what no DP slave understands: the line is sound.
constexpr std::array kNotUnderstood = std::to_array<std::string_view>({
    "flaw: missing SAP",
    "flaw: unknown address extension",
    "flaw: source address",
});

/// Pieces of the stream that are damaged, of all kinds, as one count.
Count flaws(const Facts& f)
{
    Count sum;
    for (const report::Counter& counter : f.counters.counters) {
        const std::string& name = counter.name;
        if (!name.starts_with("flaw: ") ||
            std::find(kNotUnderstood.begin(), kNotUnderstood.end(), name) != kNotUnderstood.end())
            continue;
        const Count one = counted(f.counters, name);
        sum.total += one.total;
        sum.minute += one.minute;
        if (one.last_ms && (!sum.last_ms || *one.last_ms < *sum.last_ms)) sum.last_ms = one.last_ms;
        if (one.minute > 0 && one.since_ms && (!sum.since_ms || *one.since_ms > *sum.since_ms))
            sum.since_ms = one.since_ms;
    }
    return sum;
}

std::string seen_gone(const Facts& f)
{
    if (f.bus.port_open) return {};
    return f.bus.trouble.value_or(f.bus.port + " is not there");
}
std::string seen_driver_gone(const Facts& f)
{
    if (f.bus.driver_works) return {};
    return fmt::format("{} failed; nothing is sent until one works again",
                       plural(counted(f.counters, "driver_errors").total, "edge"));
}
/// Does each of our replies come back, and the master hears them all the same? A second device with our
/// address would spoil them.
bool is_echo(const Facts& f)
{
    const Count back = counted(f.counters, "came_back");
    const std::int64_t replies = counted(f.counters, "replies").minute;
    const std::int64_t retries = counted(f.counters, "retries").minute;
    return replies >= kSomeFlaws && back.minute * 10 >= replies * 9 && retries * 10 < replies;
}
std::string seen_echo(const Facts& f)
{
    if (!is_echo(f)) return {};
    const Count back = counted(f.counters, "came_back");
    return fmt::format("{} of {} came back to the gateway {}, and the master goes on", back.minute,
                       plural(counted(f.counters, "replies").minute, "reply", "replies"), lately(back));
}
bool is_without_echo(const Facts& f)
{
    return counted(f.counters, "echo_missing").minute >= kSomeFlaws;
}
std::string seen_no_echo(const Facts& f)
{
    if (!is_without_echo(f)) return {};
    const Count missing = counted(f.counters, "echo_missing");
    return fmt::format("the echo of {} did not come {}", plural(missing.minute, "reply", "replies"),
                       lately(missing));
}
std::string seen_double(const Facts& f)
{
    Count strange = counted(f.counters, "own_address");
    if (is_echo(f)) strange.minute -= counted(f.counters, "came_back").minute;
    if (strange.minute <= 0) return {};
    return fmt::format("{} of another device with one of our addresses as the sender {}",
                       plural(strange.minute, "telegram"), lately(strange));
}
std::string seen_silent(const Facts& f)
{
    return bus_is_heard(f) ? std::string{} : silence(f);
}
std::string seen_rate(const Facts& f)
{
    if (!bus_is_heard(f) || telegrams_are_heard(f)) return {};
    if (!f.bus.port_open) return {};
    const auto fixed = f.bus.configured_baud;
    return silence(f) +
           (fixed ? fmt::format("; the rate is fixed at {} ([bus] baud)", rate(*fixed))
                  : std::string{"; the rate is searched (all but 45.45 kbit/s), and none gives telegrams"});
}
std::string seen_other_address(const Facts& f)
{
    constexpr double kNow = 10'000;
    constexpr std::int64_t kEnough = 3; // a master that starts asks each of its slaves
    if (!telegrams_are_heard(f) || f.bus.listens) return {};
    bool is_bus = true;
    for (const report::CounterGroup& group : f.replies.counters.groups)
        if (!std::exchange(is_bus, false) && is_asked(group)) return {};
    std::string asked;
    for (const report::Unanswered& one : f.bus.unanswered)
        if (one.requests >= kEnough && one.age_ms < kNow)
            asked +=
                fmt::format("{}master {} asks for address {} ({}) and gets no answer",
                            asked.empty() ? "" : "; ", one.master, one.address, plural(one.requests, "time"));
    if (asked.empty()) return {};
    std::string ours;
    for (const report::Station& station : f.replies.status.stations)
        ours += (ours.empty() ? "" : ", ") + std::to_string(station.address);
    return asked + "; no master asks for ours: " + ours;
}
std::string seen_listens(const Facts& f)
{
    if (!f.bus.listens) return {};
    return "listen = true under [bus]: there is no station, and nothing is sent";
}
std::string seen_late(const Facts& f)
{
    const Count late = counted(f.counters, "late"), written_late = counted(f.counters, "too_late"),
                overtaken = counted(f.counters, "overtaken");
    const std::int64_t all = late.minute + written_late.minute + overtaken.minute;
    if (all < 10 || all * kOften < counted(f.counters, "requests").minute) return {};
    const Count& longest = late.minute > 0 ? late : written_late.minute > 0 ? written_late : overtaken;
    return fmt::format(
        "{} suppressed because MaxTsdr had passed, {} begun in time and written too late, {} dropped because something followed them, {}",
        late.minute == 1 ? "1 reply was" : fmt::format("{} replies were", late.minute), written_late.minute,
        plural(overtaken.minute, "request"), lately(longest));
}
std::string seen_flaws(const Facts& f)
{
    const Count bad = flaws(f), good = counted(f.counters, "telegrams");
    if (bad.minute < kSomeFlaws || !telegrams_are_heard(f) || is_without_echo(f)) return {};
    if (!counted(f.counters, "checked").last_ms) return {}; // it may be the rate
    if (bad.since_ms.value_or(0) - bad.last_ms.value_or(0) < kBurst) return {};
    return fmt::format("{} (damaged telegrams, or noise between them) beside {} {}",
                       plural(bad.minute, "flaw"), plural(good.minute, "valid telegram"), lately(bad));
}
std::string seen_retries(const Facts& f)
{
    const Count retries = counted(f.counters, "retries"), requests = counted(f.counters, "requests");
    if (retries.minute < kSomeFlaws || retries.minute * kOften < requests.minute) return {};
    return fmt::format("the master asked again {} in {} {}", plural(retries.minute, "time"),
                       plural(requests.minute, "request"), lately(retries));
}
std::string seen_port(const Facts& f)
{
    const Count errors = counted(f.counters, "write_errors");
    if (errors.minute == 0) return {};
    return fmt::format("the port did not accept {} {}",
                       errors.minute == 1 ? "1 reply" : fmt::format("{} replies", errors.minute),
                       lately(errors));
}
std::string seen_settings(const Facts& f)
{
    const Count changed = counted(f.counters, "settings_changed"),
                raised = counted(f.counters, "driver_raised");
    if (raised.minute != 0)
        return fmt::format("RTS of {} was raised by another program {} {}: the bus was blocked", f.bus.port,
                           plural(raised.minute, "time"), lately(raised));
    if (changed.minute == 0) return {};
    return fmt::format("settings of {} were changed {} {}: {}", f.bus.port, plural(changed.minute, "time"),
                       lately(changed), f.bus.port_settings.value_or("dpslaved does not say which"));
}
std::string seen_driver(const Facts& f)
{
    const Count failed = counted(f.counters, "driver_errors"),
                guarded = counted(f.counters, "driver_guarded");
    if (failed.minute + guarded.minute == 0) return {};
    return fmt::format("{} failed, and the guard released the driver {} {}", plural(failed.minute, "edge"),
                       plural(guarded.minute, "time"), lately(failed.minute > 0 ? failed : guarded));
}

constexpr std::array kBusRules = std::to_array<Rule>({
    {"bus.gone", Rank::gone, "the port of the bus cannot be used",
     "The port of the bus or its driver enable is missing: unplugged, failed, or used by another program",
     "Do what the sentence above says.\n"
     "Check that the adapter is plugged in. See where it is now: ls -l /dev/serial/by-id\n"
     "Name the port under [bus] by its stable path in /dev/serial/by-id.\n"
     "See when it went: journalctl -u dpslaved. It is opened again as soon as it returns.",
     kGateway, seen_gone},
    {"bus.driver_gone", Rank::gone, "the driver enable cannot be switched",
     "The transceiver cannot be switched to sending", kDriverSteps, kGateway, seen_driver_gone},
    {"bus.echo", Rank::stands, "each reply of the gateway comes back to it",
     "The transceiver receives what it sends, and [bus] echo is off",
     "Set echo = \"on\" under [bus]. Then restart the service: systemctl restart dpslaved\n"
     "Or switch the echo off at the transceiver. Its receiver must be off while it sends.\n"
     "If echo is on already: find the other device that has the address of a station.",
     kGateway, seen_echo},
    {"bus.no_echo", Rank::stands, "[bus] echo is on, and replies do not come back",
     "No echo comes: the transceiver has none, or it does not send",
     "If the transceiver has no echo: set echo = \"off\" under [bus]. Then restart the service: systemctl restart dpslaved\n"
     "If it has one: it does not send. Check its power and its driver enable ([bus] direction).",
     kGateway, seen_no_echo},
    {"bus.double_address", Rank::stands, "another device sends with one of our addresses",
     "External communications fault: an address is used twice",
     "Check that no other PROFIBUS-DP slave or master has the same address.\n"
     "Give this station another address, in the configuration and in the master's project.",
     kBoard, seen_double},
    {"bus.silent", Rank::stands, "not one octet comes from the bus",
     "Nothing is received from the bus: cable, transceiver, or the master is off",
     "Check that the master is on and its bus is running.\n"
     "Check the cable from A and B of the transceiver (D-sub 8 and 3) to the master. On the old board B was "
     "terminal 3 and A was terminal 4.\n"
     "Check that the transceiver has power. Check that the cable is on the port that [bus] port names.",
     kGateway, seen_silent},
    {"bus.rate", Rank::stands, "octets come from the bus, but no telegram with a checksum",
     "The rate is wrong, or the two wires of the bus are swapped",
     "Compare [bus] baud with the rate in the master's project.\n"
     "baud = \"auto\" finds every rate except 45.45 kbit/s. For this rate set baud = 45450.\n"
     "Check that A is D-sub 8 and B is D-sub 3. If not, swap the two wires at the transceiver.\n"
     "See which flaws grow: dpctl counters. If only bad characters grow, it is the rate or the wires.",
     kGateway, seen_rate},
    {"bus.other_address", Rank::stands,
     "a master asks for an address where no station answers, and for none of ours",
     "The master's project has another address",
     "Give [[station]] address and the master's project the same address.\n"
     "If another device has that address: switch it on or connect it. Then add this station to the master's "
     "project.",
     kGateway, seen_other_address},
    {"bus.settings", Rank::recent,
     "another program has changed settings of the port of the bus, or raised its RTS",
     "Another program uses the port of the bus",
     "Find that program: sudo dpctl doctor names it while it has the port open. A login prompt, a console, ModemManager and brltty do this.\n"
     "Keep it away from this port: docs/guide/hardware.md. The gateway sets its settings again each time.\n"
     "Check whether `settings_changed` still grows: dpctl counters",
     kGateway, seen_settings},
    {"bus.driver", Rank::recent, "the driver enable cannot be switched, or is released too late",
     "The transceiver is not switched as configured", kDriverSteps, kGateway, seen_driver},
    {"bus.port", Rank::recent, "the port does not accept replies", "The port of the bus fails",
     "See what the system answered: journalctl -u dpslaved. Check [bus] port.", kGateway, seen_port},
    {"bus.flaws", Rank::recent, "five flaws in a minute: damaged telegrams, or noise between them",
     "The line of the bus is disturbed",
     "Check wiring, paying particular attention to the screening.\n"
     "Check that the line is not longer than the rate allows (below).\n"
     "Check that both ends of the segment are terminated, and no device between. Some equipment has resistors that can be switched in and out.\n"
     "See which flaws grow: dpctl counters",
     kBox, seen_flaws},
    {"bus.late", Rank::recent,
     "more than one reply in a thousand came too late, or its request was overtaken",
     "This machine answers too late",
     "Set priority, cpu and lock_memory under [realtime]. Then other programs delay the bus thread less.\n"
     "If the machine cannot be faster: set max_tsdr under [bus]. Give the master the GSD that `dpctl gsd "
     "make` then writes.\n"
     "Run dpctl tune. It says what delays this machine, and which rates it can serve.\n"
     "Check whether `late`, `too_late` and `overtaken` still grow: dpctl counters",
     kGateway, seen_late},
    {"bus.retries", Rank::recent, "the master repeats more than one request in a thousand",
     "The master does not receive the replies",
     "Check [bus] direction: the transceiver must send in time, and receive at once afterwards.\n"
     "Check wiring and termination. The signal can be worse at the master than at this gateway.\n"
     "Look at `late`: dpctl counters. If it is not 0, the machine answers too late.",
     kGateway, seen_retries},
    {"bus.listens", Rank::note, "listen = true under [bus]", "The daemon only listens",
     "See who is on the bus: dpctl bus. See the telegrams: dpctl trace\n"
     "To have stations: remove 'listen', add [[line]] and [[station]], and restart the service.",
     kGateway, seen_listens},
});

} // namespace

std::span<const Rule> bus_rules()
{
    return kBusRules;
}

} // namespace dpslave::dpctl
