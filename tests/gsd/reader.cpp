// SPDX-License-Identifier: Apache-2.0
#include "reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace dpslave::test {
namespace {

std::string without_blanks(std::string text)
{
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
}

std::vector<std::uint8_t> list(const std::string& text)
{
    std::vector<std::uint8_t> out;
    std::istringstream parts{text};
    for (std::string part; std::getline(parts, part, ',');)
        out.push_back(static_cast<std::uint8_t>(std::stoi(part, nullptr, 0)));
    return out;
}

} // namespace

int SecondHand::number(const std::string& key) const
{
    EXPECT_TRUE(keys.count(key)) << key;
    return keys.count(key) ? std::stoi(keys.at(key), nullptr, 0) : -1;
}

std::vector<std::uint8_t> SecondHand::octets(const std::string& key) const
{
    EXPECT_TRUE(keys.count(key)) << key;
    return keys.count(key) ? list(keys.at(key)) : std::vector<std::uint8_t>{};
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
    std::string joined = content;
    for (auto at = joined.find("\\\r\n"); at != std::string::npos; at = joined.find("\\\r\n"))
        joined.erase(at, 3);
    SecondHand found;
    std::istringstream lines{joined};
    for (std::string line; std::getline(lines, line);) {
        line = line.substr(0, line.find_first_of(";\r"));
        const auto equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string key = without_blanks(line.substr(0, equals));
        std::string value = line.substr(equals + 1);
        if (key == "Module") {
            const auto open = value.find('"');
            const auto close = value.find('"', open + 1);
            found.modules.push_back({value.substr(open + 1, close - open - 1),
                                     list(without_blanks(value.substr(close + 1))), false});
        } else if (key == "Preset") {
            found.modules.back().preset = without_blanks(value) == "1";
        } else if (value.find('"') != std::string::npos) {
            found.keys[key] = value.substr(value.find('"'));
        } else {
            found.keys[key] = without_blanks(value);
        }
    }
    return found;
}

} // namespace dpslave::test
