// SPDX-License-Identifier: Apache-2.0
// The link to the drive, for a station of any family.
#include "doctor_rules.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kSilentSteps =
    "Check the power of the drive, and the cable between gateway and drive.\n"
    "Compare the port of the drive with the configuration: protocol, rate, unit.\n"
    "Ask the drive now: dpctl read TAG";
constexpr std::string_view kNoiseSteps =
    "Check the cable to the drive: screen, routing away from motor cables, the common of the port (0 V).\n"
    "RS-485: check A and B, the bias, and a terminator at both ends of a long cable.\n"
    "A lower rate of drive and [[line]] is less sensitive.\n"
    "Check whether drive_silences and drive_damaged still grow: dpctl counters";

constexpr std::int64_t kSome = 3;         ///< in a minute: a sound line has none
constexpr std::int64_t kShare = 100;      ///< one in so many transactions
constexpr double kFirstQuestions = 5'000; ///< ms: a drive that was not asked yet is not silent
constexpr double kComesBack = 30'000;     ///< ms: a drive that comes and goes is lost again within that
constexpr double kOfNow = 15'000;         ///< ms: a lost drive is asked every few seconds

bool is_silent(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    return d.port_open && !d.stalled_ms && (d.link == "silent" || d.link == "gone");
}

/// "EI-ASCII unit 00 on p3: /dev/ttyS2 at 9.6 kbit/s, 7E1, direction gpio".
std::string settings_of(const report::Drive& d)
{
    return fmt::format("{} unit {} on {}: {} at {}, {}, direction {}", d.protocol, d.unit, d.line, d.port,
                       rate(d.baud), d.format, d.direction);
}

std::string seen_drive_port_gone(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    return !d.port_open ? fmt::format("{} of line {} is not there, or cannot be opened", d.port, d.line) : "";
}
std::string seen_stalled(const Facts& f)
{
    return f.station.drive.stalled_ms ? stall_text(f.station.drive) : std::string{};
}
std::string seen_line_settings(const Facts& f)
{
    const Count changed = counted(f.station_counters, "line_settings_changed"),
                raised = counted(f.station_counters, "line_driver_raised");
    const report::Drive& d = f.station.drive;
    if (raised.minute != 0)
        return fmt::format("RTS of {} was raised by another program {} {}: the line was blocked", d.port,
                           plural(raised.minute, "time"), lately(raised));
    if (changed.minute == 0) return {};
    return fmt::format("settings of {} were changed {} {}: {}", d.port, plural(changed.minute, "time"),
                       lately(changed), d.port_settings.value_or("dpslaved does not say which"));
}
/// Do we hear ourselves? Then what else is heard says nothing of the drive.
bool is_drive_echo(const Facts& f)
{
    const Count back = counted(f.station_counters, "drive_came_back");
    return back.minute >= kSome && back.within(kOfNow);
}
std::string seen_drive_echo(const Facts& f)
{
    const Count back = counted(f.station_counters, "drive_came_back");
    if (!is_drive_echo(f)) return {};
    return fmt::format("{} came back {}: the adapter of {} receives what it sends, and [[line]] echo is off",
                       plural(back.minute, "request"), lately(back), f.station.drive.port);
}
/// Is it the timeout, and not the drive, that is wrong? Then it is not silent.
bool is_late(const Facts& f)
{
    return counted(f.station_counters, "drive_late").within(kOfNow);
}
/// "23 answers could not be read in the last minute, 20 of them only for a wrong checksum".
std::string damaged_words(const Facts& f)
{
    const Count damaged = counted(f.station_counters, "drive_damaged");
    const std::int64_t checksum = counted(f.station_counters, "drive_bad_checksum").minute;
    return fmt::format("{} could not be read {}{}", plural(damaged.minute, "answer"), lately(damaged),
                       checksum == 0
                           ? std::string{}
                           : fmt::format(", {} of them only for a wrong checksum",
                                         checksum == damaged.minute ? "all" : std::to_string(checksum)));
}
/// It answers, and nothing of it can be read: it is not silent.
bool is_unreadable(const Facts& f)
{
    const Count damaged = counted(f.station_counters, "drive_damaged");
    return is_silent(f) && !is_drive_echo(f) && damaged.minute >= kSome && damaged.within(kOfNow);
}
std::string seen_unreadable(const Facts& f)
{
    if (!is_unreadable(f)) return {};
    const report::Drive& d = f.station.drive;
    return fmt::format("{}; {}, and {}", settings_of(d), damaged_words(f),
                       d.ever_answered ? "it answered well before" : "none was ever good");
}
std::string seen_never(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    if (!is_silent(f) || d.ever_answered || is_late(f) || is_unreadable(f) || is_drive_echo(f)) return {};
    return fmt::format("{}; {} and never an answer", settings_of(d), plural(d.silences, "request"));
}
/// Was it lost more than once, and not for a reason that has a rule of its own?
bool is_unsteady(const Facts& f)
{
    const Count lost = counted(f.station_counters, "drive_losses");
    return f.station.drive.port_open && lost.minute >= 2 && lost.within(kComesBack) && !is_late(f) &&
           !is_unreadable(f) && !is_drive_echo(f);
}
/// "; tag 57 was not read for 14.6 s": where others were.
std::string unread(const Facts& f)
{
    constexpr double kOld = 10'000, kNew = 5'000;
    std::string old;
    bool is_one_new = false;
    for (const report::Word& word : f.io.words) {
        const auto ms = word.age_ms;
        if (word.direction != "in" || !ms) continue;
        if (*ms > kOld) old += fmt::format("; tag {} was not read for {}", word.tag, age(ms));
        is_one_new = is_one_new || *ms < kNew;
    }
    return is_one_new ? old : std::string{};
}
std::string seen_unsteady(const Facts& f)
{
    if (!is_unsteady(f)) return {};
    const Count lost = counted(f.station_counters, "drive_losses");
    return fmt::format("{}; it was lost {} {}{}", settings_of(f.station.drive), plural(lost.minute, "time"),
                       lately(lost), unread(f));
}
std::string seen_drive_silent(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    if (is_unsteady(f) || !is_silent(f) || !d.ever_answered || is_late(f) || is_unreadable(f) ||
        is_drive_echo(f))
        return {};
    const Count lost = counted(f.station_counters, "drive_losses");
    return fmt::format("{}; it does not answer{}", settings_of(d),
                       lost.last_ms ? " since " + age(lost.last_ms) : std::string{});
}
std::string seen_drive_late(const Facts& f)
{
    const Count late = counted(f.station_counters, "drive_late");
    if (late.minute < kSome || !is_late(f)) return {};
    const report::Drive& d = f.station.drive;
    const std::int64_t needed = counted(f.station_counters, "drive_needs_timeout_ms").total;
    const std::int64_t delay = counted(f.station_counters, "drive_delay_ms").total;
    return fmt::format(
        "{} came after timeout_ms = {} {}{}", plural(late.minute, "answer"), d.timeout_ms, lately(late),
        needed > 0 ? fmt::format("; the slowest took {} ms: set timeout_ms = {} at least", delay, needed)
                   : std::string{});
}
std::string seen_damaged(const Facts& f)
{
    if (counted(f.station_counters, "drive_damaged").minute < kSome || is_unreadable(f) || is_drive_echo(f))
        return {};
    if (!f.station.drive.ever_answered) return {};
    const std::int64_t good = counted(f.station_counters, "drive_reads").minute +
                              counted(f.station_counters, "drive_writes").minute;
    return fmt::format("{}, beside {} good ones", damaged_words(f), good);
}
std::string seen_foreign(const Facts& f)
{
    const Count foreign = counted(f.station_counters, "drive_foreign");
    if (foreign.minute < kSome || is_drive_echo(f)) return {};
    return fmt::format("{} not to what was asked, {}",
                       foreign.minute == 1 ? "1 answer was" : fmt::format("{} answers were", foreign.minute),
                       lately(foreign));
}
std::string seen_not_accepted(const Facts& f)
{
    const Count refused = counted(f.station_counters, "drive_not_accepted");
    if (refused.minute < kSome) return {};
    return fmt::format("the drive refused {} for a wrong checksum (EE 02) {}",
                       plural(refused.minute, "write"), lately(refused));
}
/// Those that were not for the checksum.
std::string seen_not_understood(const Facts& f)
{
    const Count refused = counted(f.station_counters, "drive_not_understood");
    const std::int64_t others = refused.minute - counted(f.station_counters, "drive_not_accepted").minute;
    if (others < kSome) return {};
    return fmt::format("the drive could not take {} {}", plural(others, "request"), lately(refused));
}
/// Octets before answers: between question and answer nothing holds the line at rest.
std::string seen_noise_before(const Facts& f)
{
    const Count noise = counted(f.station_counters, "drive_noise");
    if (noise.minute < kSome || is_drive_echo(f) || is_unreadable(f)) return {};
    return fmt::format("noise came before or instead of {} {}", plural(noise.minute, "answer"),
                       lately(noise));
}
std::string seen_noise(const Facts& f)
{
    if (f.station.drive.link != "answers") return {};
    const Count silences = counted(f.station_counters, "drive_silences");
    const std::int64_t all = silences.minute + counted(f.station_counters, "drive_reads").minute +
                             counted(f.station_counters, "drive_writes").minute;
    const bool is_known = counted(f.station_counters, "drive_late").minute >= kSome ||
                          counted(f.station_counters, "drive_damaged").minute >= kSome || is_drive_echo(f) ||
                          is_unsteady(f);
    if (is_known || silences.minute < kSome || silences.minute * kShare < all) return {};
    return fmt::format("{} of {} were not answered {}", silences.minute, plural(all, "request"),
                       lately(silences));
}
std::string seen_own_value(const Facts& f)
{
    std::string all;
    for (const report::RefusedTag& one : f.diagnosis.refused)
        if (one.code == "does_not_fit") all += (all.empty() ? "" : "; ") + one.text;
    return all;
}
std::string seen_not_zeroed(const Facts& f)
{
    const auto tag = f.station.drive.not_zeroed;
    return tag ? fmt::format("tag {} was not set to 0 when the drive came back", *tag) : std::string{};
}
std::string seen_late_release(const Facts& f)
{
    const Count late = counted(f.station_counters, "line_late_releases");
    if (late.minute < kSome) return {};
    return fmt::format("the transceiver of line {} (direction {}) was released late {} {}",
                       f.station.drive.line, f.station.drive.direction, plural(late.minute, "time"),
                       lately(late));
}
std::string seen_line_driver(const Facts& f)
{
    const Count failed = counted(f.station_counters, "line_driver_errors"),
                guarded = counted(f.station_counters, "line_driver_guarded");
    if (failed.minute + guarded.minute < kSome) return {};
    return fmt::format("line {} (direction {}): {} failed, and the guard released the driver {} {}",
                       f.station.drive.line, f.station.drive.direction, plural(failed.minute, "edge"),
                       plural(guarded.minute, "time"), lately(failed.minute > 0 ? failed : guarded));
}
std::string seen_unknown(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    if (!d.port_open || d.link != "unknown" || static_cast<double>(f.uptime_ms) < kFirstQuestions) return {};
    return settings_of(d) + "; it was not asked yet";
}

constexpr std::array kDriveRules = std::to_array<Rule>({
    {"drive.stalled", Rank::gone, "a call of the port of the drive line does not come back",
     "The adapter of the drive line, its driver or the USB bus hangs: no drive of this line is asked any more",
     "Unplug the adapter and plug it in again. The line goes on by itself.\n"
     "See what the kernel says: journalctl -k\n"
     "If it comes again: another adapter, another USB port or hub, a shorter USB cable.\n"
     "If nothing helps, restart the machine: a call in the kernel cannot be ended.",
     kGateway, seen_stalled},
    {"drive.gone", Rank::gone, "the port of the drive line is missing",
     "The port of the drive line is missing: no adapter is plugged in there, or its driver failed",
     "Check that the adapter is plugged in. See where it is now: ls -l /dev/serial/by-id\n"
     "Name the port under [[line]] by its stable path in /dev/serial/by-id.\n"
     "See what the system answered: journalctl -u dpslaved. It is tried again every second.",
     kGateway, seen_drive_port_gone},
    {"drive.echo", Rank::stands, "requests to the drive come back from the line",
     "The transceiver of the drive line receives what it sends",
     "Set echo = \"on\" in the [[line]] of this drive. Then: dpctl reload\n"
     "Or switch the echo off at the adapter. Many two-wire RS-485 adapters have a switch for it.",
     kGateway, seen_drive_echo},
    {"drive.unreadable", Rank::stands, "answers of the drive come, and none can be read",
     "The drive answers, but damaged: rate or format of the line, or a disturbed cable",
     "Compare rate and format of [[line]] with those of the drive.\n"
     "Run dpctl doctor --probe. It tries other rates and formats, and names those that are answered.\n"
     "Check the cable to the drive: screen, routing away from motor cables, the common of the port (0 V), A and B.\n"
     "If only the checksums are wrong: look for a converter or a gateway between.",
     kGateway, seen_unreadable},
    {"drive.never", Rank::stands, "the drive has never answered",
     "The drive has never answered: cable, unit, rate or format",
     "Check the cable, its plug and the power of the drive. If there are several lines: check that their cables are not swapped.\n"
     "Compare the port of the drive with the configuration: protocol, group and unit, rate, format.\n"
     "Two-wire line: check direction of [[line]], and A and B.\n"
     "Run dpctl doctor --probe. It tries other rates, formats and units, and names those that are answered.",
     kGateway, seen_never},
    {"drive.not_zeroed", Rank::stands, "an output was not set to 0 when the drive came back",
     "The drive may still hold an old word in an output",
     "Look what it holds before the shaft turns: dpctl read TAG\n"
     "If the drive refuses 0: look for the limits of this tag in its manual.",
     kGateway, seen_not_zeroed},
    {"drive.late", Rank::stands, "answers of the drive come after timeout_ms",
     "The drive answers later than timeout_ms allows",
     "Set timeout_ms of its [[line]] above what was measured. Then: dpctl reload\n"
     "Look for a response delay in the menu of the drive, and for a converter between.",
     kGateway, seen_drive_late},
    {"drive.unsteady", Rank::stands, "the drive is lost and answers again, more than once",
     "The drive is lost from time to time: a loose plug, its power, or a disturbed cable",
     "Check the plugs at both ends. Check the supply of the drive, and of a converter between.\n"
     "Check the cable: screen, routing away from motor cables, the common of the port (0 V).\n"
     "If one tag alone is not answered: take it out of the master's project. Check whether the rest is steady.",
     kGateway, seen_unsteady},
    {"drive.silent", Rank::stands, "the drive answered once, and does not answer now",
     "The drive no longer answers: power, cable, or changed settings of its port", kSilentSteps, kGateway,
     seen_drive_silent},
    {"drive.not_asked", Rank::stands, "the drive was not asked yet", "The line has not asked this drive yet",
     kSilentSteps, kGateway, seen_unknown},
    {"drive.value", Rank::stands, "the drive itself has a value beyond 16 bits, or no number",
     "A value of the drive does not fit on the bus: it is the drive's own, not the master's",
     "Look at this value on the drive. A broken sensor, an overflow or a calculation without a result shows there.\n"
     "Correct number: give the row of the tag fewer decimals. Then: dpctl reload\n"
     "Meanwhile the master has the last value that did fit: dpctl io",
     kGateway, seen_own_value},
    {"drive.settings", Rank::recent,
     "another program has changed settings of the port of the drive line, or raised its RTS",
     "Another program uses the port of the drive line",
     "Find that program: sudo dpctl doctor names it while it has the port open. A login prompt, a console, ModemManager and brltty do this.\n"
     "Keep it away from this port: docs/guide/hardware.md. The gateway sets its settings again each time.\n"
     "Check whether `line_settings_changed` still grows: dpctl counters",
     kGateway, seen_line_settings},
    {"drive.driver", Rank::recent, "the driver enable of a drive line fails, or only the guard releases it",
     "The transceiver of the drive line is not switched as configured",
     "Run gpioinfo. Check that gpio_chip under [[line]] is there, and that no other program has gpio_line.\n"
     "See which values of direction this port can do: journalctl -u dpslaved\n"
     "Check whether line_driver_errors and line_driver_guarded still grow: dpctl counters",
     kGateway, seen_line_driver},
    {"drive.late_release", Rank::recent, "the transceiver of a drive line is released late",
     "This machine releases the transceiver of the drive line too late: an answer may lose its first octet",
     "Set priority under [realtime] to 2 or more. Then other programs delay the drive line less.\n"
     "Use direction = \"kernel\" where the port can do it, or an adapter that switches by itself.\n"
     "Do not use a line of an I2C or USB expander: each edge takes long.\n"
     "Check whether line_late_releases still grows: dpctl counters",
     kGateway, seen_late_release},
    {"drive.foreign", Rank::recent, "answers of the drive are not to what was asked",
     "Another device answers on this line",
     "Check that no other drive of this line has the same unit.\n"
     "Check that no other master (a PC tool, an operator station) asks on this line.",
     kGateway, seen_foreign},
    {"drive.damaged", Rank::recent, "answers of the drive are damaged",
     "The cable from the drive is disturbed, or its format is another one", kNoiseSteps, kGateway,
     seen_damaged},
    {"drive.noise_before", Rank::recent, "noise comes before the answers of the drive",
     "Nothing holds the line at rest before an answer: bias resistors are missing, or the direction is switched at the wrong moment",
     "RS-485: fit bias resistors at one place of the line, or switch them on at the adapter. Check A, B and the terminators.\n"
     "Check what switches the direction of the transceiver: it must be released right behind the request.\n"
     "Check whether drive_noise still grows: dpctl counters. The noise itself: dpctl trace --line LINE",
     kGateway, seen_noise_before},
    {"drive.not_accepted", Rank::recent, "the drive refuses requests for their checksum (EE 02)",
     "Checksum refused: the cable to the drive is disturbed",
     "Check the cable from the gateway to the drive. This direction is disturbed.\n"
     "RS-485: check A and B, the bias, and a terminator at both ends of a long cable. Check that the "
     "transceiver does not cut off the first character.\n"
     "Check whether drive_not_accepted still grows: dpctl counters",
     kGateway, seen_not_accepted},
    {"drive.not_understood", Rank::recent, "the drive cannot take requests for another reason",
     "The drive cannot read what it gets: format of the line, or a disturbed cable",
     "Look at the EE of the drive: journalctl -u dpslaved. 03 is framing, 07 is the format of the message.\n"
     "Compare [[line]] format with that of the drive. With another parity it cannot read what it gets.\n"
     "Check the cable from the gateway to the drive.",
     kGateway, seen_not_understood},
    {"drive.noise", Rank::recent, "more than one request in a hundred is not answered",
     "The cable of the drive is disturbed, or the drive is overloaded", kNoiseSteps, kGateway, seen_noise},
});

} // namespace

std::span<const Rule> drive_rules()
{
    return kDriveRules;
}

} // namespace dpslave::dpctl
