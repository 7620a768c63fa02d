// SPDX-License-Identifier: Apache-2.0
// The link to the drive, for a station of any family.
#include "doctor_rules.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

constexpr std::string_view kGateway = "dpslaved";

constexpr std::int64_t kSome = 3;         ///< in a minute: a sound line has none
constexpr std::int64_t kShare = 100;      ///< one in so many transactions
constexpr double kFirstQuestions = 5'000; ///< ms: a drive that was not asked yet is not silent
constexpr double kComesBack = 30'000;     ///< ms: a drive that comes and goes is lost again within that
constexpr double kOfNow = 15'000;         ///< ms: a lost drive is asked every few seconds

constexpr std::array kGoneSteps = std::to_array<std::string_view>({
    "Look whether the adapter is plugged in and where it is now: ls -l /dev/serial/by-id",
    "Name the port under [[line]] by its stable path in /dev/serial/by-id.",
    "journalctl -u dpslaved says what the system answered. It is tried again every second.",
});
constexpr std::array kNeverSteps = std::to_array<std::string_view>({
    "Check the cable and its plug, and that the drive has power. If there are several lines: check that "
    "their "
    "cables are not swapped.",
    "Check at the drive: the port is set to the protocol of the line, and group and unit, rate and format "
    "are "
    "those of the configuration.",
    "Let the gateway look for it: dpctl doctor --probe tries other rates, formats and units and names what "
    "answers.",
});
constexpr std::array kSilentSteps = std::to_array<std::string_view>({
    "Check that the drive has power, and the cable between gateway and drive.",
    "Check whether the port of the drive was set to another protocol, rate or unit since.",
    "dpctl read TAG asks the drive at once.",
});
constexpr std::array kLateSteps = std::to_array<std::string_view>({
    "Give the drive more time: timeout_ms of its [[line]], above what was measured.",
    "Look whether the drive delays its answers: a response delay in its menu, or a converter between.",
});
constexpr std::array kNoiseSteps = std::to_array<std::string_view>({
    "Check the cable to the drive: screen, routing away from motor cables, the common of the port (0 V).",
    "RS-485: check A and B, the bias, and a terminator at both ends of a long cable.",
    "A lower rate of drive and [[line]] is less sensitive.",
    "dpctl counters: do drive_silences and drive_damaged still grow?",
});
constexpr std::array kUnsteadySteps = std::to_array<std::string_view>({
    "Check the plugs at both ends, and the supply of the drive and of a converter between.",
    "Check the cable: screen, routing away from motor cables, the common of the port (0 V).",
    "If one tag alone is not answered: take it out of the master's project and look whether the rest is "
    "steady.",
});
constexpr std::array kEchoSteps = std::to_array<std::string_view>({
    "Set echo = \"on\" in the [[line]] of this drive, then dpctl reload.",
    "Or switch the echo off at the adapter: many two-wire RS-485 adapters have a switch for it.",
});
constexpr std::array kUnreadableSteps = std::to_array<std::string_view>({
    "Compare rate and format of [[line]] with those that the drive is set to.",
    "Let the gateway look for it: dpctl doctor --probe tries other rates and formats and names what answers.",
    "Check the cable to the drive: screen, routing away from motor cables, the common of the port (0 V), A "
    "and "
    "B.",
    "Where every answer is whole but for its checksum: look at what stands between, a converter or a "
    "gateway.",
});
constexpr std::array kNotAcceptedSteps = std::to_array<std::string_view>({
    "Check the cable from the gateway to the drive: it is this direction that is disturbed.",
    "RS-485: check A and B, the bias, and a terminator at both ends of a long cable; look whether the "
    "transceiver cuts off the first character.",
    "dpctl counters: does drive_not_accepted still grow?",
});
constexpr std::array kNotUnderstoodSteps = std::to_array<std::string_view>({
    "Look at what the drive says: journalctl -u dpslaved has its EE (03 framing, 07 format of the message).",
    "Check that the format ([[line]] format) is that of the drive: with another parity it cannot read what "
    "it gets.",
    "Check the cable from the gateway to the drive.",
});
constexpr std::array kForeignSteps = std::to_array<std::string_view>({
    "Check that no other drive of this line has the same unit.",
    "Check that no other master (a PC tool, an operator station) asks on this line.",
});

bool is_gone(const Json& drive)
{
    return drive.contains("port_open") && !flag(drive, "port_open");
}
bool is_silent(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    return !is_gone(d) && text(d, "link") == "silent";
}

/// "EI-ASCII unit 00 on p3: /dev/ttyS2 at 9.6 kbit/s, 7E1".
std::string settings_of(const Json& d)
{
    return fmt::format("{} unit {} on {}: {} at {}, {}", text(d, "protocol"), text(d, "unit"),
                       text(d, "line"), text(d, "port"), rate(integer(d, "baud").value_or(0)),
                       text(d, "format"));
}

std::string seen_gone(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    return is_gone(d) ? fmt::format("{} of line {} is not there", text(d, "port"), text(d, "line")) : "";
}
/// Do we hear ourselves? Then what else is heard says nothing of the drive.
bool is_echo(const Facts& f)
{
    const Count back = counted(f.station_counters, "drive_came_back");
    return back.minute >= kSome && back.within(kOfNow);
}
std::string seen_echo(const Facts& f)
{
    const Count back = counted(f.station_counters, "drive_came_back");
    if (!is_echo(f)) return {};
    return fmt::format("{} came back {}: the adapter of {} hears what it sends, and [[line]] echo is off",
                       plural(back.minute, "request"), lately(back), text(part(f.station, "drive"), "port"));
}
/// Is it the time-out, and not the drive, that is wrong? Then it is not silent.
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
    return is_silent(f) && !is_echo(f) && damaged.minute >= kSome && damaged.within(kOfNow);
}
std::string seen_unreadable(const Facts& f)
{
    if (!is_unreadable(f)) return {};
    const Json& d = part(f.station, "drive");
    return fmt::format("{}; {}, and {}", settings_of(d), damaged_words(f),
                       flag(d, "ever_answered") ? "it answered well before" : "none was ever good");
}
std::string seen_never(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    if (!is_silent(f) || flag(d, "ever_answered") || is_late(f) || is_unreadable(f) || is_echo(f)) return {};
    return fmt::format("{}; {} and never an answer", settings_of(d),
                       plural(integer(d, "silences").value_or(0), "request"));
}
/// Was it lost more than once, and not for a reason that has a rule of its own?
bool is_unsteady(const Facts& f)
{
    const Count lost = counted(f.station_counters, "drive_losses");
    return !is_gone(part(f.station, "drive")) && lost.minute >= 2 && lost.within(kComesBack) && !is_late(f) &&
           !is_unreadable(f) && !is_echo(f);
}
/// "; tag 57 was not read for 14.6 s": where others were.
std::string unread(const Facts& f)
{
    constexpr double kOld = 10'000, kNew = 5'000;
    std::string old;
    bool is_one_new = false;
    for (const Json& word : list(f.io, "words")) {
        const auto ms = real(word, "age_ms");
        if (text(word, "direction") != "in" || !ms) continue;
        if (*ms > kOld) old += fmt::format("; tag {} was not read for {}", number(word, "tag"), age(ms));
        is_one_new = is_one_new || *ms < kNew;
    }
    return is_one_new ? old : std::string{};
}
std::string seen_unsteady(const Facts& f)
{
    if (!is_unsteady(f)) return {};
    const Count lost = counted(f.station_counters, "drive_losses");
    return fmt::format("{}; it was lost {} {}{}", settings_of(part(f.station, "drive")),
                       plural(lost.minute, "time"), lately(lost), unread(f));
}
std::string seen_silent(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    if (is_unsteady(f) || !is_silent(f) || !flag(d, "ever_answered") || is_late(f) || is_unreadable(f) ||
        is_echo(f))
        return {};
    const Count lost = counted(f.station_counters, "drive_losses");
    return fmt::format("{}; it does not answer{}", settings_of(d),
                       lost.last_ms ? " since " + age(lost.last_ms) : std::string{});
}
std::string seen_late(const Facts& f)
{
    const Count late = counted(f.station_counters, "drive_late");
    if (late.minute < kSome || !is_late(f)) return {};
    const Json& d = part(f.station, "drive");
    const std::int64_t needed = counted(f.station_counters, "drive_needs_timeout_ms").total;
    const std::int64_t delay = counted(f.station_counters, "drive_delay_ms").total;
    return fmt::format(
        "{} came after timeout_ms = {} {}{}", plural(late.minute, "answer"), number(d, "timeout_ms"),
        lately(late),
        needed > 0 ? fmt::format("; the slowest took {} ms: set timeout_ms = {} at least", delay, needed)
                   : std::string{});
}
std::string seen_damaged(const Facts& f)
{
    if (counted(f.station_counters, "drive_damaged").minute < kSome || is_unreadable(f) || is_echo(f))
        return {};
    if (!flag(part(f.station, "drive"), "ever_answered")) return {};
    const std::int64_t good = counted(f.station_counters, "drive_reads").minute +
                              counted(f.station_counters, "drive_writes").minute;
    return fmt::format("{}, beside {} good ones", damaged_words(f), good);
}
std::string seen_foreign(const Facts& f)
{
    const Count foreign = counted(f.station_counters, "drive_foreign");
    if (foreign.minute < kSome || is_echo(f)) return {};
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
std::string seen_noise(const Facts& f)
{
    if (text(part(f.station, "drive"), "link") != "answers") return {};
    const Count silences = counted(f.station_counters, "drive_silences");
    const std::int64_t all = silences.minute + counted(f.station_counters, "drive_reads").minute +
                             counted(f.station_counters, "drive_writes").minute;
    const bool is_told = counted(f.station_counters, "drive_late").minute >= kSome ||
                         counted(f.station_counters, "drive_damaged").minute >= kSome || is_echo(f) ||
                         is_unsteady(f);
    if (is_told || silences.minute < kSome || silences.minute * kShare < all) return {};
    return fmt::format("{} of {} were not answered {}", silences.minute, plural(all, "request"),
                       lately(silences));
}
std::string seen_unknown(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    if (is_gone(d) || text(d, "link") != "unknown" || static_cast<double>(f.uptime_ms) < kFirstQuestions)
        return {};
    return settings_of(d) + "; it was not asked yet";
}

constexpr std::array kRules = std::to_array<Rule>({
    {"drive.gone", Scope::station, Rank::gone, "the port of the drive line has vanished",
     "The port of the drive line is gone: adapter pulled, or its driver failed", kGoneSteps, kGateway,
     seen_gone},
    {"drive.echo", Scope::station, Rank::stands, "requests to the drive come back from the line",
     "The line of the drive hears itself: it has an echo", kEchoSteps, kGateway, seen_echo},
    {"drive.unreadable", Scope::station, Rank::stands, "answers of the drive come, and none can be read",
     "The drive answers, but damaged: rate or format of the line, or a disturbed cable", kUnreadableSteps,
     kGateway, seen_unreadable},
    {"drive.never", Scope::station, Rank::stands, "the drive has never answered",
     "The drive was never heard: cable, unit, rate or format", kNeverSteps, kGateway, seen_never},
    {"drive.late", Scope::station, Rank::stands, "answers of the drive come after timeout_ms",
     "The drive answers later than timeout_ms allows", kLateSteps, kGateway, seen_late},
    {"drive.unsteady", Scope::station, Rank::stands, "the drive is lost and answers again, more than once",
     "The drive comes and goes: a loose plug, its power, or a disturbed cable", kUnsteadySteps, kGateway,
     seen_unsteady},
    {"drive.silent", Scope::station, Rank::stands, "the drive answered and does not any more",
     "The drive has fallen silent: power, cable, or its port was set otherwise", kSilentSteps, kGateway,
     seen_silent},
    {"drive.not_asked", Scope::station, Rank::stands, "the drive was not asked yet",
     "The line does not come to this drive", kSilentSteps, kGateway, seen_unknown},
    {"drive.foreign", Scope::station, Rank::recent, "answers of the drive are not to what was asked",
     "Another device answers on this line", kForeignSteps, kGateway, seen_foreign},
    {"drive.damaged", Scope::station, Rank::recent, "answers of the drive are damaged",
     "The cable from the drive is disturbed, or its format is another one", kNoiseSteps, kGateway,
     seen_damaged},
    {"drive.not_accepted", Scope::station, Rank::recent,
     "the drive refuses requests for their checksum (EE 02)",
     "Checksum refused: the cable to the drive is disturbed", kNotAcceptedSteps, kGateway, seen_not_accepted},
    {"drive.not_understood", Scope::station, Rank::recent,
     "the drive cannot take requests for another reason",
     "The drive cannot read what it gets: format of the line, or a disturbed cable", kNotUnderstoodSteps,
     kGateway, seen_not_understood},
    {"drive.noise", Scope::station, Rank::recent, "more than one request in a hundred is not answered",
     "The cable of the drive is disturbed, or the drive is overloaded", kNoiseSteps, kGateway, seen_noise},
});

} // namespace

std::span<const Rule> drive_rules()
{
    return kRules;
}

} // namespace dpslave::dpctl
