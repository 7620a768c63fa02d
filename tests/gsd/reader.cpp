// SPDX-License-Identifier: Apache-2.0
#include "reader.hpp"

#include <gtest/gtest.h>

namespace dpslave::test {

int SecondHand::number(const std::string& key) const
{
    const auto found = keys.find(key);
    const auto number = found == keys.end() ? std::nullopt : sim::gsd_number(found->second);
    EXPECT_TRUE(number) << key;
    return static_cast<int>(number.value_or(-1));
}

std::vector<std::uint8_t> SecondHand::octets(const std::string& key) const
{
    const auto found = keys.find(key);
    const auto octets = found == keys.end() ? std::nullopt : sim::gsd_octets(found->second);
    EXPECT_TRUE(octets) << key;
    return octets.value_or(std::vector<std::uint8_t>{});
}

std::vector<std::uint8_t> SecondHand::cfg() const
{
    std::vector<std::uint8_t> out;
    for (const Module& module : modules)
        if (module.preset || number("Modular_Station") == 0)
            out.insert(out.end(), module.identifiers.begin(), module.identifiers.end());
    return out;
}

SecondHand second_hand(const std::string& content)
{
    SecondHand out;
    const auto file = sim::parse_gsd(content);
    EXPECT_TRUE(file) << (file ? "" : file.error());
    if (!file) return out;
    for (const sim::GsdEntry& entry : file->entries.all)
        out.keys[entry.at ? entry.key + '(' + std::to_string(*entry.at) + ')' : entry.key] = entry.value;
    for (const sim::GsdModule& module : file->modules) {
        EXPECT_EQ(module.fault, "");
        out.modules.push_back({module.name, module.identifiers, module.entries.is_on("Preset")});
    }
    return out;
}

} // namespace dpslave::test
