// SPDX-License-Identifier: Apache-2.0
#include "identify_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace dpslave::dpctl {
namespace {

using profile::Profile;

constexpr std::chrono::milliseconds kEiAsciiTimeout{200},
    kModbusTimeout{600}; ///< of a [[line]] without the key

/// A basic string of TOML: JSON has the same escapes.
std::string quoted(const std::string& text)
{
    return Json(text).dump();
}

struct Candidates {
    /// Those that follow the rule; the first ones have a source for it.
    std::vector<const Profile*> fitting;
    bool follow_rule = false; ///< the first one does
};

Candidates candidates_for(const report::Answering& one, const std::vector<Profile>& profiles)
{
    const auto follows = [&](const Profile& profile) {
        // A mnemonic of the table stands above the rule of the profile.
        return one.best_rules.empty() || one.best_rules == std::vector<std::string>{"none"} ||
               std::find(one.best_rules.begin(), one.best_rules.end(), drive::text(profile.mnemonics)) !=
                   one.best_rules.end();
    };
    Candidates found;
    for (const Profile& profile : profiles)
        if (std::find(profile.protocols.begin(), profile.protocols.end(), one.protocol) !=
            profile.protocols.end())
            found.fitting.push_back(&profile);
    std::stable_partition(found.fitting.begin(), found.fitting.end(),
                          [](const Profile* profile) { return !profile->mnemonics_assumed; });
    std::stable_partition(found.fitting.begin(), found.fitting.end(),
                          [&](const Profile* profile) { return follows(*profile); });
    found.follow_rule = !found.fitting.empty() && follows(*found.fitting.front());
    if (found.follow_rule)
        std::erase_if(found.fitting, [&](const Profile* profile) { return !follows(*profile); });
    return found;
}

std::string line_block(const Identified& found)
{
    const report::Answering& one = found.answering.front();
    const bool is_modbus = one.protocol == "modbus-rtu";
    std::string out = fmt::format("[[line]]\n"
                                  "name = \"drives\"\n"
                                  "port = {}\n"
                                  "protocol = \"{}\"\n"
                                  "baud = {}\n"
                                  "format = \"{}\"\n",
                                  quoted(found.port), one.protocol, one.baud, one.format);
    if (found.timeout > (is_modbus ? kModbusTimeout : kEiAsciiTimeout))
        out += fmt::format("timeout_ms = {}\n", found.timeout.count());
    if (found.hears_itself) out += "echo = \"on\"\n";
    if (found.driver.direction == io::Direction::none) return out;
    out += fmt::format("direction = \"{}\"\n", io::text(found.driver.direction));
    if (found.driver.direction == io::Direction::gpio)
        out += fmt::format("gpio_chip = {}\ngpio_line = {}\n", quoted(found.driver.gpio_chip),
                           found.driver.gpio_line);
    if (found.driver.active_low) out += "gpio_active_low = true\n";
    return out;
}

std::string profile_lines(const report::Answering& one, const Candidates& candidates)
{
    if (candidates.fitting.empty())
        return "profile = \"\"  # FILL IN: the profile of this drive. The folder of profiles has none that fits\n";
    std::vector<std::string> names;
    for (const Profile* profile : candidates.fitting) names.push_back(profile->name);
    std::string out = fmt::format("profile = \"{}\"  # FILL IN: the profile of this drive. These fit: {}\n",
                                  names.front(), joined(names, ", "));
    if (candidates.follow_rule) return out;
    return out + fmt::format("# No profile has the rule {}: copy one and set mnemonic_rule = \"{}\" in it.\n",
                             joined(one.best_rules, " or "), one.best_rules.front());
}

std::string station_block(const Identified& found, const report::Answering& one, int address)
{
    const Candidates candidates = candidates_for(one, found.profiles);
    const Profile* const profile = candidates.fitting.empty() ? nullptr : candidates.fitting.front();
    if (profile != nullptr) address = std::clamp<int>(address, profile->min_address, profile->max_address);
    std::string out = fmt::format("[[station]]\n"
                                  "name = \"drive-{0}\"  # FILL IN: what you call it\n"
                                  "address = {1}  # FILL IN: its PROFIBUS address in the PLC's project\n",
                                  one.unit, address);
    out += profile_lines(one, candidates);
    out += fmt::format("line = \"drives\"\nunit = \"{}\"\n", one.unit);
    if (profile != nullptr && !profile->ident)
        out += "ident = 0x0001  # FILL IN: Ident_Number of the GSD in the PLC's project\n";
    if (!found.table.empty()) out += fmt::format("tags = {}\n", quoted(found.table));
    return out;
}

} // namespace

std::string config_blocks(const Identified& found)
{
    if (found.answering.empty()) return {};
    constexpr int kFirstAddress = 3; // 0 to 2 usually belong to masters and tools
    std::string out = line_block(found);
    int address = kFirstAddress;
    for (const report::Answering& one : found.answering) out += '\n' + station_block(found, one, address++);
    return out;
}

} // namespace dpslave::dpctl
