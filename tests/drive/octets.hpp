// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace dpslave::drive::test {

/// "04 30 30" as octets.
inline std::vector<std::uint8_t> octets(const std::string& text)
{
    std::vector<std::uint8_t> out;
    std::istringstream in{text};
    for (std::string two; in >> two;) out.push_back(static_cast<std::uint8_t>(std::stoul(two, nullptr, 16)));
    return out;
}

} // namespace dpslave::drive::test
