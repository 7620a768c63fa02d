// SPDX-License-Identifier: Apache-2.0
#include "device.hpp"
#include "facts.hpp"

#include "dpslave/base/printable.hpp"
#include "dpslave/gsd/identifier.hpp"
#include "dpslave/gsd/io_map.hpp"

#include <algorithm>

namespace dpslave::configurator {
namespace {

using Lines = std::vector<std::string>;

/// `text` and blanks up to `width`; numbers stand on the right.
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
        // As dpctl io and dpsim count: from 1, behind Demand Data, whose registers count by themselves.
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
                        " octets in " + right(sum ? sum->out : 0, 3) + " out");
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
    lines.emplace_back();
    lines.emplace_back("octets: places in the Data_Exchange telegram, counted from 0");
    lines.emplace_back("word: counted from 1 after Demand Data; D1 to D4 are Demand Data");
}

} // namespace

Outcome show(const Files& files, std::string_view file, const std::string& profile, const std::string& table)
{
    Outcome outcome;
    const gsd::Document document = gsd::parse(file);
    const gsd::Findings findings = gsd::check(document, gsd::Reading::tolerant);
    if (!document.has_section) {
        outcome.exit = kNo;
        outcome.refusals.emplace_back("this is no GSD file: it has no line #Profibus_DP.");
        return outcome;
    }
    if (any_error(findings))
        outcome.messages.push_back("warning: the file has " + summary(findings) + ": check it to read them.");
    const gsd::MapHints hints = hints_of(files, profile, table, outcome);
    if (outcome.exit != kFine) return outcome;
    const gsd::IoMap map = gsd::io_map(document, hints);
    add_map(outcome.lines, document, map);
    outcome.facts = text_of({{"device",
                              {{"vendor", utf8_of_latin1(document.text("Vendor_Name"))},
                               {"model", utf8_of_latin1(document.text("Model_Name"))},
                               {"ident", document.number("Ident_Number").value_or(0)}}},
                             {"map", facts_of(map)},
                             {"set_prm", document.user_prm_data()},
                             {"chk_cfg", identifiers_of(document)}});
    for (const gsd::Advice& advice : map.advice)
        outcome.messages.push_back("warning: " + printable(advice.text));
    return outcome;
}

} // namespace dpslave::configurator
