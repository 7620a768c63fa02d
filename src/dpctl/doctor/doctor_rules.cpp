// SPDX-License-Identifier: Apache-2.0
// What rules of several tables look at, and all tables as one.
#include "doctor_rules.hpp"

#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

/// ms without an octet: the counters are looked at once a second.
constexpr double kSilence = 3'000;
/// ms without a telegram that has a checksum: masters talk all the time, a search tries rate after rate.
constexpr double kNoTelegram = 5'000, kNoTelegramInSearch = 15'000;
constexpr double kAsked = 10'000;

} // namespace

bool is_in(const Facts& f, std::string_view state)
{
    return f.station.state == state;
}
bool exchanges(const Facts& f)
{
    return is_in(f, "Data_Exch");
}

Count counted(const report::CounterGroup& group, std::string_view name)
{
    for (const report::Counter& counter : group.counters)
        if (counter.name == name)
            return {.total = counter.value,
                    .minute = counter.minute,
                    .last_ms = counter.last_age_ms,
                    .since_ms = counter.since_age_ms};
    return {};
}

std::string lately(const Count& count)
{
    constexpr double kMinute = 60'000;
    if (!count.since_ms || *count.since_ms <= kMinute) return "in the last minute";
    return "in the last minute, since " + age(count.since_ms);
}

bool is_asked(const report::CounterGroup& station_counters)
{
    constexpr std::array kAsks = std::to_array<std::string_view>(
        {"data_exchange", "slave_diag", "set_prm", "chk_cfg", "get_cfg", "rd_inp", "rd_outp"});
    return std::any_of(kAsks.begin(), kAsks.end(),
                       [&](std::string_view name) { return counted(station_counters, name).within(kAsked); });
}

namespace {

/// As of now, where the counters may be a second old.
bool is_telegram_within(const Facts& f, double ms)
{
    const auto last = f.bus.last_telegram_age_ms;
    return last && *last <= ms;
}

} // namespace

bool bus_is_heard(const Facts& f)
{
    if (!f.bus.port_open) return true;
    const Count octets = counted(f.counters, "octets");
    return octets.within(kSilence) || is_telegram_within(f, kSilence) ||
           static_cast<double>(f.uptime_ms) < kSilence;
}

bool telegrams_are_heard(const Facts& f)
{
    const double limit = f.bus.baud_state == "Baud_Search" ? kNoTelegramInSearch : kNoTelegram;
    return counted(f.counters, "checked").within(limit) || is_telegram_within(f, limit) ||
           static_cast<double>(f.uptime_ms) < limit;
}

bool has_just_started(const Facts& f)
{
    if (!is_in(f, "Wait_Prm") && !is_in(f, "Wait_Cfg")) return false;
    if (is_asked(f.station_counters) || !silence(f).empty()) return false;
    const bool is_heard = counted(f.counters, "checked").last_ms || f.bus.last_telegram_age_ms;
    return !is_heard || static_cast<double>(f.uptime_ms) < kAsked;
}

std::string silence(const Facts& f)
{
    if (bus_is_heard(f) && telegrams_are_heard(f)) return {};
    const Count octets = counted(f.counters, "octets"), checked = counted(f.counters, "checked");
    if (!bus_is_heard(f))
        return octets.last_ms ? "the last octet from the bus was received " + age(octets.last_ms) + " ago"
                              : "not one octet has been received from the bus";
    if (checked.last_ms)
        return fmt::format(
            "the last telegram with a checksum was received {} ago; {} came in the last minute",
            age(checked.last_ms), plural(octets.minute, "octet"));
    return fmt::format("{} came in the last minute, but never a telegram with a checksum",
                       plural(octets.minute, "octet"));
}

std::string refusal(const Facts& f)
{
    if (!f.diagnosis.refusal) return {};
    const report::Refusal& r = *f.diagnosis.refusal;
    const std::string expected = r.expected.value_or(""), got = r.got.value_or("");
    return fmt::format("{} was refused{}: {}{}{}; {}", r.telegram,
                       r.octet ? fmt::format(", octet {}", *r.octet) : "", r.what,
                       expected.empty() ? "" : ", expected " + expected, got.empty() ? "" : ", got " + got,
                       r.advice);
}

std::string tag_trouble(const Facts& f)
{
    std::string all;
    for (const report::RefusedTag& item : f.diagnosis.refused) all += (all.empty() ? "" : "; ") + item.text;
    return all;
}

std::string drive_silence(const Facts& f)
{
    const report::Drive& d = f.station.drive;
    if (d.stalled_ms || (d.link != "silent" && d.link != "gone")) return {};
    return fmt::format("unit {} on {} ({}, {}) does not answer: {} unanswered", d.unit, d.line, d.port,
                       d.protocol, plural(d.silences, "request"));
}

bool master_left(const Facts& f)
{
    const std::string code = f.station.left_code.value_or("");
    return code == "output_length" || code == "unlock" || code == "new_parameters";
}

std::string restlessness(const Facts& f)
{
    const Count left = counted(f.station_counters, "left_data_exchange");
    if (left.minute < 2) return {};
    return fmt::format("Data_Exch was left {} {}, the last time: {}", plural(left.minute, "time"),
                       lately(left), f.station.left_because.value_or("?"));
}

std::string no_exchange(const Facts& f)
{
    if (std::string silent = silence(f); !silent.empty()) return silent;
    const std::string address = std::to_string(f.station.address);
    if (is_in(f, "Wait_Cfg"))
        return "the master has parameterised address " + address + " and sends no Chk_Cfg";
    if (is_asked(f.station_counters))
        return "a master asks address " + address + ", but does not parameterise it";
    return not_asked(f);
}

std::string not_asked(const Facts& f)
{
    return "telegrams are received, but no master asks for address " + std::to_string(f.station.address);
}

bool is_of_bus(const Rule& rule)
{
    return rule.name.starts_with("bus.");
}

std::vector<std::string_view> steps_of(const Rule& rule)
{
    std::vector<std::string_view> steps;
    for (std::string_view rest = rule.steps; !rest.empty();) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        steps.push_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return steps;
}

std::span<const Rule> rules()
{
    static const std::vector<Rule> all = [] {
        std::vector<Rule> joined;
        for (const auto table : {port_rules(), bus_rules(), drive_rules(), station_rules(), board_rules(),
                                 box_rules(), controller_rules(), lamp_rules()})
            joined.insert(joined.end(), table.begin(), table.end());
        return joined;
    }();
    return all;
}

} // namespace dpslave::dpctl
