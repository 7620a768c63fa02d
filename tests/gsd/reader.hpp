// SPDX-License-Identifier: Apache-2.0
/// Files and devices are judged by a second hand: the reader of dpsim, which shares nothing with the
/// project's own. Here a key that is not there is a failure of the test.
#pragma once

#include "dpsim/common/gsd_file.hpp"

#include <map>

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
