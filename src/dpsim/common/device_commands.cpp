// SPDX-License-Identifier: Apache-2.0
#include "device_commands.hpp"

#include "values.hpp"

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

} // namespace

std::vector<std::string> DeviceCommands::common_help()
{
    return {
        "  set TAG VALUE              a value in displayed units, or a label",
        "  get TAG                    the present value",
        "  ramp TAG FROM TO SECONDS   moves and stays at TO; wave: back and forth",
        "  list                       all parameters",
        "  unit NN|all                whom the next commands concern",
        "  echo on|off                the transceiver of the master hears what it sends",
        "  log on|off                 tell what is written",
        "  stats                      counters",
        "  quit                       ends",
    };
}

std::vector<Device*> DeviceCommands::meant()
{
    std::vector<Device*> devices = line_.devices();
    devices.erase(
        std::remove_if(devices.begin(), devices.end(), [&](const Device* d) { return !is_meant(*d); }),
        devices.end());
    return devices;
}

std::vector<std::string> DeviceCommands::one(std::string sentence)
{
    return sentence.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(sentence)};
}

std::optional<std::uint16_t> DeviceCommands::tag_number(const Words& words)
{
    const auto number = words.size() > 1 ? number_of(words[1]) : std::nullopt;
    if (!number || *number < 0 || *number > 65535) return std::nullopt;
    return static_cast<std::uint16_t>(*number);
}

std::string DeviceCommands::no_tag(const Words& words)
{
    return fmt::format("no tag {} in the table; list shows them", words.size() > 1 ? words[1] : "");
}

std::string DeviceCommands::rest_of(const Words& words, std::size_t from)
{
    std::string rest;
    for (std::size_t i = from; i < words.size(); ++i) rest += (rest.empty() ? "" : " ") + words[i];
    return rest;
}

std::vector<std::string> DeviceCommands::command(std::string_view line, Instant now)
{
    const Words words = words_of(line);
    if (words.empty()) return {};
    for (Device* const device : line_.devices()) device->settle(now);
    const std::string& name = words[0];
    if (name == "set") return one(set(words, now));
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
    if (name == "echo" && words.size() == 2 && (words[1] == "on" || words[1] == "off")) {
        line_.set_echo(words[1] == "on");
        return {};
    }
    if (AnswerFaults::knows(name)) {
        std::string wrong;
        for (Device* const device : meant()) wrong = device->answer_faults.add(words);
        return one(wrong);
    }
    return special(words, now);
}

/// Empty = done.
std::string DeviceCommands::choose_unit(const Words& words)
{
    const std::string wanted = words.size() == 2 ? words[1] : "";
    const auto devices = line_.devices();
    if (wanted != "all" &&
        std::none_of(devices.begin(), devices.end(), [&](const Device* d) { return d->address() == wanted; }))
        return fmt::format("there is no unit '{}'", wanted);
    unit_ = wanted == "all" ? "" : wanted;
    return {};
}

std::vector<std::string> DeviceCommands::get(const Words& words, Instant now)
{
    const auto number = tag_number(words);
    std::vector<std::string> lines;
    for (Device* const device : meant())
        if (const Parameter* const p = number ? device->find(*number) : nullptr)
            lines.push_back(fmt::format("{}tag {} = {}",
                                        line_.devices().size() > 1 ? "unit " + device->address() + ": " : "",
                                        p->tag.number, displayed(p->tag, p->at(now))));
    if (lines.empty()) lines.push_back(no_tag(words));
    return lines;
}

std::string DeviceCommands::set(const Words& words, Instant now)
{
    const auto number = tag_number(words);
    if (words.size() < 3) return fmt::format("write it as: {} 55 12.50", words[0]);
    const std::string wanted = rest_of(words, 2);
    bool found = false;
    for (Device* const device : meant()) {
        Parameter* const p = number ? device->find(*number) : nullptr;
        if (p == nullptr) continue;
        auto value = value_of_text(p->tag, wanted);
        if (!value) return fmt::format("'{}' is no value of tag {} within its limits", wanted, p->tag.number);
        p->put(std::move(*value));
        device->changed(*number, now);
        found = true;
    }
    return found ? std::string{} : no_tag(words);
}

std::string DeviceCommands::move(const Words& words, Instant now)
{
    const auto number = tag_number(words);
    const auto takes = words.size() == 5
                           ? duration_of_text(words[4].ends_with('s') ? words[4] : words[4] + "s")
                           : std::nullopt;
    if (!takes || takes->count() <= 0)
        return fmt::format("write it as: {} 55 0.00 100.00 5 (seconds)", words[0]);
    bool found = false;
    for (Device* const device : meant()) {
        Parameter* const p = number ? device->find(*number) : nullptr;
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

std::vector<std::string> DeviceCommands::list(Instant now)
{
    std::vector<std::string> lines;
    for (const Device* const device : meant()) {
        lines.push_back("unit " + device->address());
        for (const Parameter& p : device->parameters())
            lines.push_back(fmt::format("  {:>5}  {:2}  {:2}  {:<44} {}", p.tag.number,
                                        p.mnemonic.empty() ? "--" : p.mnemonic, text(p.tag.access),
                                        p.tag.name, displayed(p.tag, p.at(now))));
    }
    return lines;
}

} // namespace dpslave::sim
