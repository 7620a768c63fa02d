// SPDX-License-Identifier: Apache-2.0
#include "drive_commands.hpp"

#include <fmt/format.h>

namespace dpslave::sim {

std::vector<std::string> DriveCommands::all_help()
{
    std::vector<std::string> lines{
        "  silence                    answers nothing, as if it were off",
        "  nak [EE]                   refuses every write but that of EE; EE is hexadecimal, else 02C2",
        "  bad-bcc                    replies carry a wrong block check",
        "  garbage                    replies are random octets",
        "  slow TIME                  replies come this much later",
        "  text TAG [TEXT]            the tag answers with this text; without TEXT with its value again",
        "  ok                         ends all faults",
    };
    const auto answers = AnswerFaults::help();
    lines.insert(lines.end() - 1, answers.begin(), answers.end());
    const auto common = common_help();
    lines.insert(lines.end(), common.begin(), common.end());
    return lines;
}

std::vector<std::string> DriveCommands::special(const Words& words, Instant /*now*/)
{
    const std::string& name = words[0];
    if (name == "text") return one(text(words));
    DriveFaults faults;
    if (name == "bad-bcc") {
        faults.bad_check = true;
    } else if (name == "nak") {
        const auto code =
            words.size() > 1 ? octets_of(words[1]) : Result<Octets, std::string>{Octets{0x02, 0xC2}};
        if (!code || code->size() != 2) return one("EE has four hexadecimal digits, for example: nak 05C8");
        faults.nak = static_cast<Ee>(be16(*code, 0));
    } else if (std::string wrong = read_fault(words, faults); !wrong.empty()) {
        return one(std::move(wrong));
    }
    for (DriveUnit* const unit : chosen<DriveUnit>()) {
        unit->faults = faults;
        unit->answer_faults.clear();
    }
    return {};
}

/// Empty = done.
std::string DriveCommands::text(const Words& words)
{
    if (!number_at(words, 1, 0, 0xFFFF)) return "write it as: text 55 12.34";
    return change_tag<DriveUnit>(words, [&](DriveUnit& unit, const SimParameter& p) {
        unit.texts.erase(p.tag.number);
        if (words.size() > 2) unit.texts[p.tag.number] = rest_of(words, 2);
        return std::string{};
    });
}

std::vector<std::string> DriveCommands::stats()
{
    std::vector<std::string> lines;
    for (const DriveUnit* const unit : chosen<DriveUnit>())
        lines.push_back(
            fmt::format("unit {}: {} reads, {} writes, {} refusals, {} malformed messages, EE >{:04X}",
                        unit->address(), unit->reads, unit->writes, unit->refusals, unit->bad_messages,
                        static_cast<unsigned>(unit->error)));
    return lines;
}

} // namespace dpslave::sim
