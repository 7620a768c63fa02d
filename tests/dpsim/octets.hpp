// SPDX-License-Identifier: Apache-2.0
/// Octets of the tests, written as the references print them.
#pragma once

#include "dpsim/common/telegram.hpp"

#include <cstdlib>
#include <sstream>

namespace dpslave::sim {

/// "68 05" as octets: not the reader of the simulators, which is under test itself.
inline Octets wire(const std::string& text)
{
    std::istringstream in{text};
    Octets octets;
    for (std::string part; in >> part;)
        octets.push_back(static_cast<std::uint8_t>(std::strtoul(part.c_str(), nullptr, 16)));
    return octets;
}

} // namespace dpslave::sim
