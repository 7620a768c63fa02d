// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"
#include "meaning.hpp"
#include "recognise.hpp"
#include "verdict.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/io_map.hpp"
#include "dpslave/gsd/sent.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

using Lines = std::vector<std::string>;

/// Returns `text` and blanks up to `width`; numbers are on the right.
std::string left(std::string text, std::size_t width)
{
    std::size_t characters = 0; // of UTF-8
    for (const char c : text) characters += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    if (characters < width) text.append(width - characters, ' ');
    return text;
}

std::string right(std::size_t number, std::size_t width)
{
    std::string text = std::to_string(number);
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string range(const std::string& prefix, std::size_t first, std::size_t last)
{
    return prefix + std::to_string(first) + (first == last ? "" : '-' + std::to_string(last));
}

void add_direction(Lines& lines, const std::string& title, const std::vector<gsd::IoValue>& values,
                   std::size_t octets)
{
    lines.emplace_back();
    lines.push_back(title + ": " + std::to_string(octets) + " octets, " + std::to_string(octets / 2) +
                    " words");
    if (values.empty()) return;
    std::size_t behind = 0; // octets of Demand Data
    for (const gsd::IoValue& value : values) behind += value.is_demand ? value.octets : 0;
    const auto row = [&](const std::string& place, const std::string& word, const std::string& tag,
                         const std::string& what) {
        lines.push_back("  " + left(place, 9) + ' ' + left(word, 7) + ' ' + left(tag, 6) + ' ' + what);
    };
    row("octets", "word", "tag", "value");
    for (const gsd::IoValue& value : values) {
        const std::size_t last = value.octet + value.octets - 1;
        // The count is that of dpctl io and dpsim: from 1, after Demand Data, whose registers count by
        // themselves.
        const std::size_t before = value.is_demand ? 0 : behind;
        row(range("", value.octet, last),
            range(value.is_demand ? "D" : "", (value.octet - before) / 2 + 1, (last - before) / 2 + 1),
            value.tag ? std::to_string(*value.tag) : "-", printable(value.what));
    }
}

void add_modules(Lines& lines, const gsd::Document& document)
{
    lines.emplace_back();
    lines.push_back("The master's tool combines these modules, " +
                    std::to_string(document.number("Max_Module").value_or(0)) +
                    " at most; their order gives the map:");
    for (const gsd::Module& module : document.modules) {
        const auto sum = gsd::sum_of_identifiers(module.identifiers);
        lines.push_back("  " + left(printable(module.name), 32) + ' ' + right(sum ? sum->in : 0, 3) +
                        " octets in " + right(sum ? sum->out : 0, 3) + " out" +
                        (gsd::empty_slots(module.identifiers) > 0 ? ", empty slot" : ""));
    }
}

/// They count in Chk_Cfg and are in no telegram of data.
void add_empty_slots(Lines& lines, const gsd::Document& document)
{
    for (const gsd::Module* module : gsd::plugged_modules(document)) {
        const std::size_t count = gsd::empty_slots(module->identifiers);
        if (count == 0) continue;
        lines.emplace_back();
        lines.push_back("The module " + printable(module->name) + " has " + std::to_string(count) +
                        " empty slot" + (count == 1 ? "" : "s") + " (identifier 0x00), which " +
                        (count == 1 ? "takes" : "take") + " no place in the telegrams.");
    }
}

void add_map(Lines& lines, const gsd::Document& document, const gsd::IoMap& map)
{
    lines.push_back(printable(document.text("Vendor_Name")) + ", " + printable(document.text("Model_Name")) +
                    ", Ident_Number " + hex_of(document.number("Ident_Number").value_or(0)));
    if (const std::string text = document.text("Info_Text"); !text.empty()) lines.push_back(printable(text));
    if (!map.fixed) return add_modules(lines, document);
    add_direction(lines, "Inputs, from the slave to the master", map.inputs, map.in_octets);
    add_direction(lines, "Outputs, from the master to the slave", map.outputs, map.out_octets);
    add_empty_slots(lines, document);
    lines.emplace_back();
    lines.emplace_back("octets: places in the Data_Exchange telegram, counted from 0");
    lines.emplace_back("word: counted from 1 after Demand Data; D1 to D4 are Demand Data");
}

/// Judges the file as the device of the profile, or of the one that the file itself names; returns nullopt if
/// it names none.
std::optional<Judged> judged_as_found(const Files& files, std::string_view file,
                                      const gsd::Document& document, const std::string& profile,
                                      const std::optional<std::vector<const gsd::Module*>>& modules)
{
    std::string name = profile;
    if (name.empty()) {
        const Recognised found = recognise(files, file, document);
        if (found.is_guess || found.profiles.empty()) return std::nullopt;
        name = found.profiles.front().name;
    }
    Outcome unsaid; // a profile that is named was loaded before
    const auto device = load(files, name, std::string{}, unsaid);
    if (!device) return std::nullopt;
    return judge_as(*device, {}, document, modules);
}

/// Returns the list if only one is possible.
std::optional<std::vector<const gsd::Module*>> only_list_of(const std::optional<Judged>& judged)
{
    if (!judged) return std::nullopt;
    const profile::FileVerdict& verdict =
        judged->verdict.refused ? judged->plant_keys.verdict : judged->verdict; // with the keys of the plant
    if (verdict.refused || verdict.other_lists || verdict.tags_are_open || verdict.modules.empty() ||
        verdict.plugging == gsd::Plugging::fixed)
        return std::nullopt;
    return verdict.modules;
}

void add_verdict(Outcome& outcome, const gsd::Document& document, const Judged& judged)
{
    const profile::FileVerdict& verdict = judged.verdict;
    if (verdict.refused) {
        const unsigned line = verdict.refused->line;
        outcome.messages.push_back("warning: " + (line > 0 ? "line " + std::to_string(line) + ": " : "") +
                                   printable(utf8_of_latin1(refusal_words(judged))));
    } else if (verdict.other_lists && !verdict.tags_are_open && verdict.taken.layout.count > 0) {
        std::string tags;
        for (const profile::GsdParameter& one : profile::parameters_of(verdict.taken))
            tags += (tags.empty() ? "" : ", ") + std::to_string(one.tag);
        outcome.lines.push_back(gsd::any_own_parameters(document)
                                    ? "The tags come with the modules of the master's project."
                                    : "User_Prm_Data has the tags " + tags +
                                          ": the modules of the master's project say their directions.");
    }
}

} // namespace

Outcome show(const Files& files, std::string_view file, const std::string& profile, const std::string& table,
             const std::vector<std::string>& modules)
{
    Outcome outcome;
    const gsd::Document document = gsd::parse(file);
    const gsd::Findings findings = gsd::check(document, gsd::Reading::tolerant);
    if (!document.has_section) {
        outcome.exit = kNo;
        outcome.refusals.push_back(not_read(document));
        return outcome;
    }
    say_unread(document, "", outcome);
    if (std::any_of(findings.begin(), findings.end(), [](const gsd::Finding& one) {
            return one.severity == gsd::Severity::error && !one.unread;
        }))
        outcome.messages.push_back("warning: the file has " + summary(findings) + ": check it to read them.");
    std::string why;
    const auto asked = modules_asked(document, modules, why);
    if (!why.empty()) return {.exit = kUsage, .refusals = {printable(why)}};
    gsd::MapHints hints = hints_of(files, profile, table, document, outcome);
    if (outcome.exit != kFine) return outcome;
    add_names(hints, file);
    const bool is_of_a_master = document.number("Station_Type") == 1U;
    const auto judged =
        is_of_a_master ? std::nullopt : judged_as_found(files, file, document, profile, asked);
    hints.modules = asked ? asked : only_list_of(judged);
    const gsd::Sent sent =
        gsd::sent_by_master(document, hints.modules ? *hints.modules : gsd::plugged_modules(document));
    const gsd::IoMap map = gsd::io_map(document, hints);
    add_map(outcome.lines, document, map);
    Json facts{{"device",
                {{"vendor", utf8_of_latin1(document.text("Vendor_Name"))},
                 {"model", utf8_of_latin1(document.text("Model_Name"))},
                 {"ident", document.number("Ident_Number").value_or(0)}}},
               {"map", facts_of(map)},
               {"set_prm", sent.user.octets},
               {"chk_cfg", sent.cfg.octets}};
    if (judged) {
        facts["verdict"] = facts_of(judged->verdict);
        add_verdict(outcome, document, *judged);
    }
    outcome.facts = text_of(facts);
    for (const gsd::Advice& advice : map.advice)
        outcome.messages.push_back("warning: " + printable(advice.text));
    return outcome;
}

} // namespace dpslave::configurator
