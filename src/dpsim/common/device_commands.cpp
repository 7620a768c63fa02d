// SPDX-License-Identifier: Apache-2.0
#include "device_commands.hpp"

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
        "  ramp TAG FROM TO TIME      moves and stays at TO; wave: back and forth",
        "  list                       all parameters",
        "  unit NN|all                the unit for the next commands",
        "  echo on|off                the transceiver of the master receives what it sends",
        "  log on|off                 print what is written",
        "  stats                      counters",
        "  quit                       ends",
    };
}

std::vector<std::string> DeviceCommands::one(std::string sentence)
{
    return sentence.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(sentence)};
}

std::string DeviceCommands::no_tag(const Words& words)
{
    return fmt::format("no tag {} in the table; list shows them", words.size() > 1 ? words[1] : "");
}

std::string DeviceCommands::no_value(const SimParameter& parameter, const std::string& text)
{
    return fmt::format("'{}' is no value of tag {} within its limits", text, parameter.tag.number);
}

std::string DeviceCommands::read_fault(const Words& words, DeviceFaults& faults)
{
    const std::string& name = words[0];
    if (name == "slow") {
        const auto time = words.size() == 2
                              ? read_duration(words[1], std::chrono::nanoseconds{0}, kLongestDelay)
                              : std::nullopt;
        if (!time) return "write it as: slow 50ms";
        faults.slow = *time;
        return {};
    }
    faults.silence = name == "silence";
    faults.garbage = name == "garbage";
    if (faults.silence || faults.garbage || name == "ok") return {};
    return fmt::format("there is no command '{}'; help lists them", name);
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
    if (const auto on = switch_at(words, 1); on && (name == "log" || name == "echo")) {
        if (name == "log")
            line_.set_logging(*on);
        else
            line_.set_echo(*on);
        return {};
    }
    if (name == "quit") {
        quit_ = true;
        return {};
    }
    if (!AnswerFaults::knows(name)) return special(words, now);
    std::string wrong;
    for (Device* const device : chosen()) wrong = device->answer_faults.add(words);
    return one(wrong);
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
    std::vector<std::string> lines;
    std::string wrong = change_tag(words, [&](const Device& device, const SimParameter& p) {
        lines.push_back(fmt::format("{}tag {} = {}",
                                    line_.devices().size() > 1 ? "unit " + device.address() + ": " : "",
                                    p.tag.number, displayed(p.tag, p.at(now))));
        return std::string{};
    });
    return wrong.empty() ? lines : one(std::move(wrong));
}

std::string DeviceCommands::set(const Words& words, Instant now)
{
    if (words.size() < 3) return fmt::format("write it as: {} 55 12.50", words[0]);
    return change_tag(words, [&](Device& device, SimParameter& p) {
        const std::string wanted = rest_of(words, 2);
        auto value = value_of_text(p.tag, wanted);
        if (!value) return no_value(p, wanted);
        p.put(std::move(*value));
        device.changed(p.tag.number, now);
        return std::string{};
    });
}

std::string DeviceCommands::move(const Words& words, Instant now)
{
    const auto takes = words.size() == 5 ? read_duration(words[4]) : std::nullopt;
    if (!takes || takes->count() <= 0) return fmt::format("write it as: {} 55 0.00 100.00 5s", words[0]);
    return change_tag(words, [&](const Device& /*device*/, SimParameter& p) {
        if (p.tag.type == TagKind::string) return fmt::format("tag {} is a text", p.tag.number);
        const auto from = value_of_text(p.tag, words[2]), to = value_of_text(p.tag, words[3]);
        if (!from || !to) return no_value(p, words[from ? 3 : 2]);
        p.value = *to;
        p.motion = Motion{from->counts, to->counts, now, *takes, words[0] == "wave"};
        return std::string{};
    });
}

std::vector<std::string> DeviceCommands::list(Instant now)
{
    std::vector<std::string> lines;
    for (const Device* const device : chosen()) {
        lines.push_back("unit " + device->address());
        for (const SimParameter& p : device->parameters())
            lines.push_back(fmt::format("  {:>5}  {:2}  {:2}  {:<44} {}", p.tag.number,
                                        p.mnemonic.empty() ? "--" : p.mnemonic, text(p.tag.access),
                                        p.tag.name, displayed(p.tag, p.at(now))));
    }
    return lines;
}

} // namespace dpslave::sim
