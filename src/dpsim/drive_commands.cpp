// SPDX-License-Identifier: Apache-2.0
#include "dpsim/drive_commands.hpp"

#include "dpsim/values.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

std::string_view text(TagAccess access)
{
    switch (access) {
        case TagAccess::read_only: return "ro";
        case TagAccess::write_only: return "wo";
        case TagAccess::read_write: break;
    }
    return "rw";
}

std::optional<std::uint16_t> tag_number(const std::vector<std::string>& words)
{
    const auto number = words.size() > 1 ? number_of(words[1]) : std::nullopt;
    if (!number || *number < 0 || *number > 65535) return std::nullopt;
    return static_cast<std::uint16_t>(*number);
}

std::string no_tag(const std::vector<std::string>& words)
{
    return fmt::format("no tag {} in the table; list shows them", words.size() > 1 ? words[1] : "");
}

} // namespace

std::vector<std::string> DriveCommands::help()
{
    return {
        "  silence                    hears nothing, as if it were off",
        "  nak [EE]                   refuses every write; EE in hexadecimal, 02C2 if none is given",
        "  bad-bcc                    replies carry a wrong block check",
        "  garbage                    replies are random octets",
        "  slow MS                    replies come so much later",
        "  ok                         ends all faults",
        "  set TAG VALUE              a value in displayed units, or a label",
        "  get TAG                    the present value",
        "  ramp TAG FROM TO SECONDS   moves and stays at TO; wave: back and forth",
        "  list                       all parameters",
        "  unit NN|all                whom the next commands concern",
        "  log on|off                 tell what is written",
        "  stats                      counters",
        "  quit                       ends",
    };
}

std::vector<DriveUnit*> DriveCommands::meant()
{
    std::vector<DriveUnit*> units;
    for (DriveUnit& unit : line_.units())
        if (unit_.empty() || unit.address == unit_) units.push_back(&unit);
    return units;
}

std::vector<std::string> DriveCommands::command(std::string_view line, Instant now)
{
    const Words words = words_of(line);
    if (words.empty()) return {};
    const auto one = [](std::string sentence) {
        return sentence.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(sentence)};
    };
    const std::string& name = words[0];
    if (name == "set") return one(set(words));
    if (name == "get") return get(words, now);
    if (name == "ramp" || name == "wave") return one(move(words, now));
    if (name == "list") return list(now);
    if (name == "stats") return stats();
    if (name == "unit") return one(choose_unit(words));
    if (name == "help") return help();
    if (name == "log" && words.size() == 2 && (words[1] == "on" || words[1] == "off")) {
        line_.set_logging(words[1] == "on");
        return {};
    }
    if (name == "quit") {
        quit_ = true;
        return {};
    }
    return one(fault(words));
}

/// Empty = done.
std::string DriveCommands::fault(const Words& words)
{
    DriveFaults faults;
    const std::string& name = words[0];
    if (name == "silence") {
        faults.silence = true;
    } else if (name == "bad-bcc") {
        faults.bad_bcc = true;
    } else if (name == "garbage") {
        faults.garbage = true;
    } else if (name == "nak") {
        const auto code =
            words.size() > 1 ? octets_of(words[1]) : Result<Octets, std::string>{Octets{0x02, 0xC2}};
        if (!code || code->size() != 2) return "EE has four hexadecimal digits, for example: nak 05C8";
        faults.nak = static_cast<Ee>(be16(*code, 0));
    } else if (name == "slow") {
        const auto ms = words.size() == 2 ? number_of(words[1]) : std::nullopt;
        if (!ms || *ms < 0 || *ms > 60'000) return "write it as: slow 50 (milliseconds)";
        faults.slow = std::chrono::milliseconds{*ms};
    } else if (name != "ok") {
        return fmt::format("there is no command '{}'; help lists them", name);
    }
    for (DriveUnit* const unit : meant()) unit->faults = faults;
    return {};
}

std::string DriveCommands::choose_unit(const Words& words)
{
    const std::string wanted = words.size() == 2 ? words[1] : "";
    const auto& units = line_.units();
    if (wanted != "all" &&
        std::none_of(units.begin(), units.end(), [&](const DriveUnit& u) { return u.address == wanted; }))
        return fmt::format("there is no unit '{}'", wanted);
    unit_ = wanted == "all" ? "" : wanted;
    return {};
}

std::vector<std::string> DriveCommands::get(const Words& words, Instant now)
{
    const auto number = tag_number(words);
    std::vector<std::string> lines;
    for (DriveUnit* const unit : meant())
        if (const Parameter* const p = number ? unit->find(*number) : nullptr)
            lines.push_back(fmt::format("{}tag {} = {}",
                                        line_.units().size() > 1 ? "unit " + unit->address + ": " : "",
                                        p->tag.number, displayed(p->tag, p->at(now))));
    if (lines.empty()) lines.push_back(no_tag(words));
    return lines;
}

std::string DriveCommands::set(const Words& words)
{
    const auto number = tag_number(words);
    if (words.size() < 3) return "write it as: set 55 12.50";
    std::string wanted = words[2];
    for (std::size_t i = 3; i < words.size(); ++i) wanted += " " + words[i];
    bool found = false;
    for (DriveUnit* const unit : meant()) {
        Parameter* const p = number ? unit->find(*number) : nullptr;
        if (p == nullptr) continue;
        const auto value = value_of_text(p->tag, wanted);
        if (!value) return fmt::format("'{}' is no value of tag {} within its limits", wanted, p->tag.number);
        p->value = *value;
        p->motion.reset();
        found = true;
    }
    return found ? std::string{} : no_tag(words);
}

std::string DriveCommands::move(const Words& words, Instant now)
{
    const auto number = tag_number(words);
    const auto takes = words.size() == 5
                           ? duration_of_text(words[4].ends_with('s') ? words[4] : words[4] + "s")
                           : std::nullopt;
    if (!takes || takes->count() <= 0)
        return fmt::format("write it as: {} 55 0.00 100.00 5 (seconds)", words[0]);
    bool found = false;
    for (DriveUnit* const unit : meant()) {
        Parameter* const p = number ? unit->find(*number) : nullptr;
        if (p == nullptr || p->tag.type == TagKind::string) continue;
        const auto from = value_of_text(p->tag, words[2]), to = value_of_text(p->tag, words[3]);
        if (!from || !to)
            return fmt::format("'{}' or '{}' is no value of tag {} within its limits", words[2], words[3],
                               *number);
        p->value = *to;
        p->motion = Motion{from->counts, to->counts, now, *takes, words[0] == "wave"};
        found = true;
    }
    return found ? std::string{} : no_tag(words);
}

std::vector<std::string> DriveCommands::list(Instant now)
{
    std::vector<std::string> lines;
    for (const DriveUnit* const unit : meant()) {
        lines.push_back("unit " + unit->address);
        for (const Parameter& p : unit->parameters)
            lines.push_back(fmt::format("  {:>5}  {:2}  {:2}  {:<44} {}", p.tag.number,
                                        p.mnemonic.empty() ? "--" : p.mnemonic, text(p.tag.access),
                                        p.tag.name, displayed(p.tag, p.at(now))));
    }
    return lines;
}

std::vector<std::string> DriveCommands::stats()
{
    std::vector<std::string> lines;
    for (const DriveUnit* const unit : meant())
        lines.push_back(
            fmt::format("unit {}: {} reads, {} writes, {} refusals, {} malformed messages, EE >{:04X}",
                        unit->address, unit->reads, unit->writes, unit->refusals, unit->bad_messages,
                        static_cast<unsigned>(unit->error)));
    return lines;
}

} // namespace dpslave::sim
