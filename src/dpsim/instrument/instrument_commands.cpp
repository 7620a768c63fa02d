// SPDX-License-Identifier: Apache-2.0
#include "instrument_commands.hpp"

#include <fmt/format.h>

namespace dpslave::sim {

std::vector<std::string> InstrumentCommands::all_help()
{
    std::vector<std::string> lines{
        "  silence                    answers nothing, as if it were off",
        "  exception 2|3              answers every request with: 2 illegal address, 3 illegal value",
        "  refuse [2|3]               answers every write so, 3 if nothing is said",
        "  bad-crc                    replies carry a wrong CRC",
        "  garbage                    replies are random octets",
        "  short                      replies end one octet early",
        "  slow TIME                  replies come this much later",
        "  no-loopback                says nothing to function 8",
        "  ok                         ends all faults",
        "  panel TAG VALUE            as the operator does at the front panel: limits and access hold",
        "  bit TAG N on|off           one bit, 0 to 15; of tag 75 the summary output status",
        "  tune TIME [fails]          how long the next autotune takes (3s); 'fails' sets bit 3 of tag 76",
    };
    const auto common = common_help();
    const auto answers = AnswerFaults::help();
    lines.insert(lines.end() - 4, answers.begin(), answers.end());
    lines.insert(lines.end(), common.begin(), common.end());
    return lines;
}

std::vector<std::string> InstrumentCommands::special(const Words& words, Instant now)
{
    if (words[0] == "panel") return one(panel(words, now));
    if (words[0] == "bit") return one(bit(words, now));
    if (words[0] == "tune") return one(tune(words));
    return one(fault(words));
}

std::string InstrumentCommands::panel(const Words& words, Instant now)
{
    if (words.size() < 3) return "write it as: panel 2 50.0";
    return change_tag<Instrument>(words, [&](Instrument& instrument, const SimParameter& p) {
        const std::string wanted = rest_of(words, 2);
        const auto value = value_of_text(p.tag, wanted);
        if (!value) return no_value(p, wanted);
        if (instrument.panel(p.tag.number, value->counts, now) != Exception::none)
            return fmt::format("tag {} cannot be changed at present", p.tag.number);
        return std::string{};
    });
}

std::string InstrumentCommands::bit(const Words& words, Instant now)
{
    const auto bit = number_at(words, 2, 0, 15);
    const auto on = switch_at(words, 3);
    if (!bit || !on) return "write it as: bit 75 5 on";
    return change_tag(words, [&](Device& device, SimParameter& p) {
        if (p.tag.type == TagKind::string) return fmt::format("tag {} is a text", p.tag.number);
        const std::int32_t mask = 1 << *bit, before = p.at(now).counts;
        p.put({*on ? before | mask : before & ~mask, {}});
        device.changed(p.tag.number, now);
        return std::string{};
    });
}

std::string InstrumentCommands::tune(const Words& words)
{
    const auto time = words.size() > 1 ? read_duration(words[1]) : std::nullopt;
    const bool fails = words.size() == 3 && words[2] == "fails";
    if (!time || words.size() > 3 || (words.size() == 3 && !fails))
        return "write it as: tune 5s, or tune 5s fails";
    for (Instrument* const instrument : chosen<Instrument>()) instrument->prepare_tune(*time, fails);
    return {};
}

std::string InstrumentCommands::fault(const Words& words)
{
    InstrumentFaults faults;
    const std::string& name = words[0];
    if (name == "bad-crc") {
        faults.bad_check = true;
    } else if (name == "short") {
        faults.too_short = true;
    } else if (name == "no-loopback") {
        faults.no_loopback = true;
    } else if (name == "exception" || name == "refuse") {
        const std::string code = words.size() == 1 && name == "refuse" ? "3" : rest_of(words, 1);
        if (code != "2" && code != "3") return fmt::format("write it as: {} 2, or {} 3", name, name);
        (name == "refuse" ? faults.no_writes : faults.refuse) =
            code == "2" ? Exception::illegal_address : Exception::illegal_value;
    } else if (std::string wrong = read_fault(words, faults); !wrong.empty()) {
        return wrong;
    }
    for (Instrument* const instrument : chosen<Instrument>()) {
        instrument->faults = faults;
        instrument->answer_faults.clear();
    }
    return {};
}

std::vector<std::string> InstrumentCommands::stats()
{
    std::vector<std::string> lines;
    for (const Instrument* const instrument : chosen<Instrument>()) {
        const InstrumentCounters& c = instrument->counters;
        lines.push_back(fmt::format("unit {}: {} reads of {} words, {} values written, {} exceptions",
                                    instrument->address(), c.reads, c.words, c.writes, c.exceptions));
    }
    lines.push_back(fmt::format("line: {} requests with a wrong CRC, {} of functions that get no answer",
                                line_.bad_crc(), line_.unsupported()));
    return lines;
}

} // namespace dpslave::sim
