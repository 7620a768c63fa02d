// SPDX-License-Identifier: Apache-2.0
#include "identify_report.hpp"

#include "dpctl/cli/words.hpp"

#include "dpslave/profile/survey.hpp"

#include <fmt/format.h>

namespace dpslave::dpctl {
namespace {

std::string name_of(const report::Answering& one)
{
    return fmt::format("{} unit {}", one.protocol, one.unit);
}

std::string tags_text(const std::vector<std::int64_t>& tags)
{
    std::vector<std::uint16_t> numbers;
    for (const std::int64_t tag : tags) numbers.push_back(static_cast<std::uint16_t>(tag));
    return profile::spans_text(numbers);
}

/// "18 of 24 tags answer: 1, 10-12; 6 denied: 13-18"
std::string rule_words(const report::RuleAnswers& rule)
{
    const std::size_t asked = rule.answering.size() + rule.denied.size() + rule.silent.size();
    std::string words = fmt::format("{} of {} answer", rule.answering.size(),
                                    plural(static_cast<std::int64_t>(asked), "tag"));
    if (!rule.answering.empty()) words += ": " + tags_text(rule.answering);
    const auto add = [&](const std::vector<std::int64_t>& tags, const char* what) {
        if (!tags.empty()) words += fmt::format("; {} {}: {}", tags.size(), what, tags_text(tags));
    };
    add(rule.denied, "denied");
    add(rule.silent, "silent");
    add(rule.unasked, "not asked");
    if (rule.nameless > 0) words += fmt::format("; {} without a mnemonic under this rule", rule.nameless);
    return words;
}

std::string rule_name(const report::Answering& one, const std::string& rule)
{
    if (one.protocol == "modbus-rtu") return "by register";
    return rule == "none" ? "by the table" : "rule " + rule;
}

void note_unit(const report::Answering& one, std::vector<std::string>& notes)
{
    const std::string name = name_of(one);
    const bool is_modbus = one.protocol == "modbus-rtu";
    if (!one.identity)
        notes.push_back(name + (is_modbus
                                    ? ": what device it is: no register holds an identity that a manual names"
                                    : ": what device it is: it gives no II"));
    else if (!one.device)
        notes.push_back(
            fmt::format("{}: what device it is: no manual says what II {} stands for", name, *one.identity));
    if (!one.version) notes.push_back(name + (is_modbus ? ": its version" : ": its version: it gives no V0"));
    if (one.rules.empty())
        notes.push_back(name +
                        ": which tags answer: only the first units are asked; name this one with --unit");
    else if (is_modbus)
        return;
    else if (one.best_rules.empty())
        notes.push_back(
            name +
            ": its rule of the mnemonics: no tag answers under any; name tags that it has with --tags or --table");
    else if (one.best_rules.size() > 1)
        notes.push_back(fmt::format(
            "{}: its rule of the mnemonics: as many tags answer under {}; name other tags with --tags", name,
            joined(one.best_rules, " and ")));
    else
        notes.push_back(
            name +
            ": whether each mnemonic stands for this tag: an answer shows only that the drive has it. Compare a value with its display");
}

const char* end_words(SearchEnd end)
{
    switch (end) {
        case SearchEnd::interrupted: return ", ended by a signal";
        case SearchEnd::time_is_over: return ", ended because the time was over";
        case SearchEnd::full: return ", ended because so many units answer";
        case SearchEnd::failed: return ", ended because the port failed";
        case SearchEnd::complete: break;
    }
    return "";
}

const char* end_name(SearchEnd end)
{
    switch (end) {
        case SearchEnd::interrupted: return "interrupted";
        case SearchEnd::time_is_over: return "time";
        case SearchEnd::full: return "full";
        case SearchEnd::failed: return "failed";
        case SearchEnd::complete: break;
    }
    return "complete";
}

} // namespace

std::string render_answering(const report::Answering& one, Look look)
{
    std::string out = headline(name_of(one), fmt::format(" at {}, {}", rate(one.baud), one.format), look);
    Block block;
    const std::string identity = one.identity.value_or("not answered");
    block.add("identity", one.device ? fmt::format("{} ({})", identity, *one.device) : identity);
    block.add("version", one.version.value_or("not answered"));
    for (const report::RuleAnswers& rule : one.rules) block.add(rule_name(one, rule.rule), rule_words(rule));
    if (one.best_rules.size() == 1 && one.protocol != "modbus-rtu")
        block.add("fits", rule_name(one, one.best_rules.front()));
    return out + block.str(2, look);
}

std::vector<std::string> not_found_out(const Identified& found)
{
    std::vector<std::string> notes;
    for (const report::Answering& one : found.answering) note_unit(one, notes);
    if (found.end != SearchEnd::complete)
        notes.push_back(fmt::format("what answers to the other questions: {} of at most {} were asked",
                                    found.asked, found.most));
    if (found.unsure > 0)
        notes.push_back(fmt::format(
            "{} answered only once, or without a value: noise, or a drive that is hard to hear. Check the wires and the termination",
            plural(found.unsure, "unit")));
    if (found.damaged > 0 && found.answering.empty()) // beside a drive: what came at the wrong rates
        notes.push_back(fmt::format(
            "after {} came octets that are no answer: another rate or format, another protocol, or noise",
            plural(found.damaged, "question")));
    if (found.answering.empty()) notes.insert(notes.end(), found.not_asked.begin(), found.not_asked.end());
    for (const std::string& sentence : found.refused) notes.push_back(sentence);
    if (!found.answering.empty())
        notes.emplace_back("the PROFIBUS address, the ident and the tags: they are in the PLC's project");
    return notes;
}

std::string render_identified(const Identified& found, Look look)
{
    std::string out = fmt::format("{}: {} in {} s{}\n", found.port, plural(found.asked, "question"),
                                  found.took.count(), end_words(found.end));
    for (const report::Answering& one : found.answering) out += '\n' + render_answering(one, look);
    if (found.answering.empty())
        out +=
            "\nNothing answers: check the power of the drive, that its port is set to EI-ASCII or Modbus RTU, and the wires; exchange A and B, or RX and TX.\n";
    if (found.hears_itself) out += "\nThe adapter hears what it sends (echo); it is no answer.\n";
    if (const auto notes = not_found_out(found); !notes.empty()) {
        out += "\nNot found out:\n";
        for (const std::string& note : notes) out += paragraph("- ", note, look.width);
    }
    if (const std::string blocks = config_blocks(found); !blocks.empty())
        out += "\nFor /etc/dpslaved/dpslaved.toml:\n\n" + blocks;
    return out;
}

Json identified_json(const Identified& found)
{
    Json answering = Json::array();
    for (const report::Answering& one : found.answering) answering.push_back(report::json_of(one));
    return {{"port", found.port},
            {"end", end_name(found.end)},
            {"asked", found.asked},
            {"most", found.most},
            {"answering", std::move(answering)},
            {"echo", found.hears_itself},
            {"not_found_out", not_found_out(found)},
            {"config", config_blocks(found)}};
}

} // namespace dpslave::dpctl
