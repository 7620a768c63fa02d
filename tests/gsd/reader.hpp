// SPDX-License-Identifier: Apache-2.0
/// A small GSD reader of the tests' own, so that files and devices are judged by a second hand.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace dpslave::test {

struct SecondHand {
    std::map<std::string, std::string> keys; ///< as printed; the last one counts, as in the masters' tools
    struct Module {
        std::string name;
        std::vector<std::uint8_t> identifiers;
        bool preset = false;
    };
    std::vector<Module> modules;

    /// A key that is not there is a failure of the test.
    int number(const std::string& key) const;
    std::vector<std::uint8_t> octets(const std::string& key) const;
    /// All identifiers of the plugged modules: those of a compact station, and the preset ones.
    std::vector<std::uint8_t> cfg() const;
};
SecondHand second_hand(const std::string& content);

} // namespace dpslave::test
