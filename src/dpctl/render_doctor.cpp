// SPDX-License-Identifier: Apache-2.0
#include "doctor.hpp"
#include "table.hpp"
#include "tables.hpp"
#include "words.hpp"

#include <fmt/format.h>

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

std::string line_table(bool colour)
{
    Table table({">RATE", ">CABLE A", ">CABLE B"});
    for (const LineLimit& limit : kLineLimits)
        table.add({rate(limit.baud), metres(limit.cable_a), metres(limit.cable_b)});
    return "line length of a segment at most:\n" + table.str(colour, 2);
}

constexpr const char* kTermination = "termination: at both ends of the segment and nowhere else, 390 ohm to "
                                     "+5 V, 220 ohm between B and A, 390 ohm to "
                                     "0 V\n";

std::string line_words(const Json& bus, bool colour)
{
    const auto limit = line_limit(bus);
    if (!limit) return line_table(colour) + kTermination;
    return fmt::format("line length of a segment at {}: cable A {}, cable B {}\n", rate(limit->baud),
                       metres(limit->cable_a), metres(limit->cable_b)) +
           kTermination;
}

std::string lamps(const Json& leds, const std::string& name)
{
    for (const Json& station : list(leds, "stations")) {
        if (text(station, "name") != name) continue;
        std::string shown;
        for (const Json& led : list(station, "leds"))
            shown +=
                fmt::format("{}{} {}", shown.empty() ? "" : ", ", text(led, "name"), text(led, "pattern"));
        return shown + ": " + text(station, "meaning");
    }
    return "-";
}

std::string picture(const Replies& replies, const std::string& wanted, bool colour)
{
    Table table({"STATION", ">ADDRESS", "STATE", "DRIVE", "LAMPS"});
    for (const Json& station : list(replies.status, "stations"))
        if (station.is_object() && is_meant(station, wanted))
            table.add({text(station, "name"), number(station, "address"), text(station, "state"),
                       text(part(station, "drive"), "link"), lamps(replies.leds, text(station, "name"))});
    return bus_line(part(replies.status, "bus")) + "\n\n" + table.str(colour);
}

std::string steps(const Rule& rule)
{
    std::string out;
    for (const std::string_view step : rule.steps) out += fmt::format("   - {}\n", step);
    return out;
}

/// The findings of one kind; those of one rule under one head, with the evidence of each station.
std::string paragraphs(const std::vector<Finding>& findings, bool notes, bool colour)
{
    std::string out;
    int count = 0;
    for (std::size_t i = 0; i < findings.size();) {
        const Rule& rule = *findings[i].rule;
        std::string seen;
        for (; i < findings.size() && findings[i].rule == &rule; ++i)
            seen += fmt::format("   {}: {}\n", findings[i].station.empty() ? "bus" : findings[i].station,
                                findings[i].evidence);
        if (rule.note != notes) continue;
        const std::string head =
            notes ? fmt::format("note: {}", rule.cause) : fmt::format("{}. {}", ++count, rule.cause);
        out += fmt::format("\n{} ({})\n{}{}", painted(head, notes ? Tone::strong : Tone::bad, colour),
                           rule.source, seen, steps(rule));
    }
    return out;
}

Json rule_json(const Rule& rule)
{
    Json steps = Json::array();
    for (const std::string_view step : rule.steps) steps.push_back(step);
    return {{"rule", rule.name},
            {"condition", rule.condition},
            {"cause", rule.cause},
            {"steps", steps},
            {"source", rule.source}};
}

} // namespace

Json doctor_json(const Replies& replies, const std::vector<Finding>& findings)
{
    Json found = Json::array(), notes = Json::array();
    for (const Finding& finding : findings) {
        Json one = rule_json(*finding.rule);
        one["station"] = finding.station.empty() ? Json(nullptr) : Json(finding.station);
        one["evidence"] = finding.evidence;
        (finding.rule->note ? notes : found).push_back(std::move(one));
    }
    const auto limit = line_limit(part(replies.status, "bus"));
    return {{"findings", found}, {"notes", notes}, {"line", limit ? line_json(*limit) : Json(nullptr)}};
}

std::string render_doctor(const Replies& replies, const std::vector<Finding>& findings,
                          const std::string& station, bool colour)
{
    std::string out = picture(replies, station, colour);
    const std::string found = paragraphs(findings, false, colour);
    out += found.empty() ? '\n' + painted("all is well", Tone::good, colour) + '\n' : found;
    return out + paragraphs(findings, true, colour) + '\n' + line_words(part(replies.status, "bus"), colour);
}

Json rules_json()
{
    Json all = Json::array(), lines = Json::array();
    for (const Rule& rule : rules()) {
        all.push_back(rule_json(rule));
        all.back()["note"] = rule.note;
    }
    for (const LineLimit& limit : kLineLimits) lines.push_back(line_json(limit));
    return {{"rules", all}, {"lines", lines}};
}

std::string render_rules(bool colour)
{
    std::string out;
    for (const Rule& rule : rules())
        out += fmt::format("{}\n   {} ({})\n{}\n", painted(rule.condition, Tone::strong, colour), rule.cause,
                           rule.source, steps(rule));
    return out + line_table(colour) + kTermination;
}

} // namespace dpslave::dpctl
