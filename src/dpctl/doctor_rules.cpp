// SPDX-License-Identifier: Apache-2.0
// What rules of several tables look at, and all tables as one.
#include "doctor_rules.hpp"

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

constexpr double kLongSilence = 10'000; ///< ms without a telegram: the master or the line is gone
constexpr double kHour = 3'600'000;

} // namespace

bool is_in(const Facts& f, std::string_view state)
{
    return text(f.station, "state") == state;
}
bool exchanges(const Facts& f)
{
    return is_in(f, "Data_Exch");
}

std::int64_t counted(const Facts& f, std::string_view name)
{
    for (const Json& counter : list(f.counters, "counters"))
        if (text(counter, "name") == name) return integer(counter, "value").value_or(0);
    return 0;
}

std::string silence(const Facts& f)
{
    const auto heard = real(f.bus, "last_telegram_age_ms");
    if (text(f.bus, "baud_state") != "Baud_Search" && heard && *heard < kLongSilence) return {};
    if (heard) return fmt::format("the last valid telegram on the bus was heard {} ago", age(heard));
    const std::int64_t octets = counted(f, "octets");
    if (octets == 0) return "not one octet has been received from the bus";
    return fmt::format("{} have been received, but not one valid telegram", plural(octets, "octet"));
}

std::string refusal(const Facts& f)
{
    const Json& r = part(f.diagnosis, "refusal");
    if (r.empty()) return {};
    const auto octet = integer(r, "octet");
    return fmt::format("{} was refused{}: {}; {}", text(r, "telegram"),
                       octet ? fmt::format(", octet {}", *octet) : "", text(r, "what"), text(r, "advice"));
}

std::string tag_trouble(const Facts& f)
{
    std::string all;
    for (const Json& item : list(f.diagnosis, "trouble")) {
        if (!item.is_string()) continue;
        const auto sentence = item.get<std::string>();
        if (!sentence.starts_with("the drive does not answer")) all += (all.empty() ? "" : "; ") + sentence;
    }
    return all;
}

std::string drive_silence(const Facts& f)
{
    const Json& d = part(f.station, "drive");
    if (text(d, "link") != "silent") return {};
    return fmt::format("unit {} on {} ({}, {}) does not answer: {} unanswered", text(d, "unit"),
                       text(d, "line"), text(d, "port"), text(d, "protocol"),
                       plural(integer(d, "silences").value_or(0), "request"));
}

std::string restlessness(const Facts& f)
{
    const std::int64_t left = integer(f.station, "left_count").value_or(0);
    const double hours = std::max(static_cast<double>(f.uptime_ms) / kHour, 1.0);
    if (left < 2 || static_cast<double>(left) <= hours) return {};
    return fmt::format("Data_Exch was left {} in {}, the last time: {}", plural(left, "time"),
                       age(static_cast<double>(f.uptime_ms)), text(f.station, "left_because"));
}

std::string no_exchange(const Facts& f)
{
    if (std::string silent = silence(f); !silent.empty()) return silent;
    const std::string address = number(f.station, "address");
    if (is_in(f, "Wait_Cfg"))
        return "the master has parameterised address " + address + " and sends no Chk_Cfg";
    return "telegrams are heard, but no master parameterises address " + address;
}

std::span<const Rule> rules()
{
    static const std::vector<Rule> all = [] {
        std::vector<Rule> joined;
        for (const auto table :
             {bus_rules(), board_rules(), box_rules(), controller_rules(), station_rules()})
            joined.insert(joined.end(), table.begin(), table.end());
        return joined;
    }();
    return all;
}

} // namespace dpslave::dpctl
