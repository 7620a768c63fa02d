// SPDX-License-Identifier: Apache-2.0
#include "doctor.hpp"
#include "dpctl/cli/table.hpp"
#include "dpctl/cli/tables.hpp"
#include "dpctl/cli/words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

std::string metres(std::optional<int> length)
{
    return length ? fmt::format("{} m", *length) : "not at this rate";
}

Json line_json(const LineLimit& limit)
{
    return {{"baud", limit.baud},
            {"cable_a_m", limit.cable_a},
            {"cable_b_m", limit.cable_b ? Json(*limit.cable_b) : Json(nullptr)}};
}

std::string line_table(Look look)
{
    Table table({">RATE", ">CABLE A", ">CABLE B"});
    for (const LineLimit& limit : kLineLimits)
        table.add({rate(limit.baud), metres(limit.cable_a), metres(limit.cable_b)});
    return "line length of a segment at most:\n" + table.str(look, 2);
}

std::string termination(Look look)
{
    return paragraph(
        "",
        "termination: at both ends of the segment and nowhere else, 390 ohm to +5 V, 220 ohm between B and A, 390 ohm to 0 V",
        look.width);
}

std::string line_words(const report::Bus& bus, Look look)
{
    const auto limit = line_limit(bus);
    if (!limit) return line_table(look) + termination(look);
    return fmt::format("line length of a segment at {}: cable A {}, cable B {}\n", rate(limit->baud),
                       metres(limit->cable_a), metres(limit->cable_b)) +
           termination(look);
}

std::string lamps(const report::GetLedsReply& leds, const std::string& name)
{
    for (const report::StationLeds& station : leds.stations) {
        if (station.name != name) continue;
        std::string shown;
        for (const report::Led& led : station.leds)
            shown += fmt::format("{}{} {}", shown.empty() ? "" : ", ", led.name, led.pattern);
        return shown + ": " + station.meaning;
    }
    return "-";
}

std::string picture(const Replies& replies, const std::string& wanted, Look look)
{
    Table table({"STATION", ">ADDRESS", "STATE", "DRIVE", "LAMPS"});
    for (const report::Station& station : replies.status.stations)
        if (is_meant(station, wanted))
            table.add({station.name, std::to_string(station.address), station.state, station.drive.link,
                       lamps(replies.leds, station.name)});
    const std::string bus = paragraph("", bus_line(replies.status.bus), look.width);
    return replies.status.stations.empty() ? bus : bus + '\n' + table.str(look);
}

std::string steps(const Rule& rule, Look look)
{
    std::string out;
    for (const std::string_view step : steps_of(rule)) out += paragraph("   - ", step, look.width);
    return out;
}

enum class Kind : std::uint8_t { cause, checklist, note };
Kind kind_of(const Rule& rule)
{
    if (rule.rank == Rank::note) return Kind::note;
    return rule.rank == Rank::checklist ? Kind::checklist : Kind::cause;
}

std::string head_of(Kind kind, int count)
{
    if (kind == Kind::cause) return fmt::format("{}. ", count);
    return kind == Kind::note ? "note: " : "the manual's list: ";
}

/// The findings of one kind; those of one rule under one head, with the evidence of each station. What a
/// cause has said already is not said again.
std::string paragraphs(const std::vector<Finding>& findings, Kind kind, Look look)
{
    const auto is_said = [&](const Finding& one) {
        return std::any_of(findings.begin(), findings.end(), [&](const Finding& other) {
            return kind_of(*other.rule) == Kind::cause && other.evidence == one.evidence;
        });
    };
    std::string out;
    int count = 0;
    for (std::size_t i = 0; i < findings.size();) {
        const Rule& rule = *findings[i].rule;
        std::string seen;
        for (; i < findings.size() && findings[i].rule == &rule; ++i)
            if (kind != Kind::checklist || !is_said(findings[i]))
                seen += paragraph(
                    fmt::format("   {}: ", findings[i].station.empty() ? "bus" : findings[i].station),
                    findings[i].evidence, look.width);
        if (kind_of(rule) != kind) continue;
        const std::string head = head_of(kind, ++count);
        out += '\n' + title(fmt::format("{}{} ({})", head, rule.cause, rule.source),
                            kind == Kind::cause ? Tone::bad : Tone::strong, look);
        out += seen + steps(rule, look);
    }
    return out;
}

std::string earlier_lines(const std::vector<Earlier>& earlier, Look look)
{
    std::string out;
    for (const Earlier& one : earlier)
        out += paragraph(fmt::format("   {}: ", one.station.empty() ? "bus" : one.station),
                         fmt::format("{} {}, the last {} ago", one.count, one.what, age(one.age_ms)),
                         look.width);
    return out.empty() ? out : "\nearlier, and not in the last minute:\n" + out;
}

Json rule_json(const Rule& rule)
{
    Json steps = Json::array();
    for (const std::string_view step : steps_of(rule)) steps.push_back(step);
    return {{"rule", rule.name},
            {"condition", rule.condition},
            {"cause", rule.cause},
            {"steps", steps},
            {"source", rule.source}};
}

} // namespace

Json doctor_json(const Replies& replies, const std::vector<Finding>& findings,
                 const std::vector<Earlier>& earlier)
{
    const auto station_json = [](const std::string& name) {
        return name.empty() ? Json(nullptr) : Json(name);
    };
    Json found = Json::array(), notes = Json::array(), before = Json::array();
    for (const Finding& finding : findings) {
        Json one = rule_json(*finding.rule);
        one["station"] = station_json(finding.station);
        one["evidence"] = finding.evidence;
        (finding.rule->rank == Rank::note ? notes : found).push_back(std::move(one));
    }
    for (const Earlier& one : earlier)
        before.push_back({{"station", station_json(one.station)},
                          {"what", one.what},
                          {"count", one.count},
                          {"age_ms", one.age_ms}});
    const auto limit = line_limit(replies.status.bus);
    return {{"findings", found},
            {"notes", notes},
            {"earlier", before},
            {"line", limit ? line_json(*limit) : Json(nullptr)}};
}

std::string render_doctor(const Replies& replies, const std::vector<Finding>& findings,
                          const std::vector<Earlier>& earlier, const std::string& station, Look look)
{
    std::string out = picture(replies, station, look);
    const std::string found =
        paragraphs(findings, Kind::cause, look) + paragraphs(findings, Kind::checklist, look);
    out += found.empty() ? '\n' + painted("all is well", Tone::good, look) + '\n' : found;
    return out + earlier_lines(earlier, look) + paragraphs(findings, Kind::note, look) + '\n' +
           line_words(replies.status.bus, look);
}

Json rules_json()
{
    Json all = Json::array(), lines = Json::array();
    for (const Rule& rule : rules()) {
        all.push_back(rule_json(rule));
        all.back()["note"] = rule.rank == Rank::note;
    }
    for (const LineLimit& limit : kLineLimits) lines.push_back(line_json(limit));
    return {{"rules", all}, {"lines", lines}};
}

std::string render_rules(Look look)
{
    std::string out;
    for (const Rule& rule : rules())
        out += painted(rule.condition, Tone::strong, look) + '\n' +
               paragraph("   ", fmt::format("{} ({})", rule.cause, rule.source), look.width) +
               steps(rule, look) + '\n';
    return out + line_table(look) + termination(look);
}

} // namespace dpslave::dpctl
