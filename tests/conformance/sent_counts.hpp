// SPDX-License-Identifier: Apache-2.0
/// What a program has put on a bus since the daemon was started, and whether the daemon's counters agree.
#pragma once

#include "support/wire.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>

namespace conformance {

/// Is this one telegram with a right checksum? By a hand of its own.
bool is_whole(const test::Octets& octets);

class SentCounts {
public:
    /// The daemon has `address` and has heard nothing yet.
    void begin(std::uint8_t address);

    void note_request(const test::Octets& octets); ///< one that is to be answered, each time it is sent
    void note_other(const test::Octets& octets);   ///< whatever is not answered
    void note_answer() { ++answers_; }             ///< in time or not

    /// Each request that the daemon has counted is answered, or is in `late`, `overtaken` or `unsent`. For
    /// each that it has not counted it has a flaw: the pty has delivered it in pieces. (A piece of what is
    /// damaged may be a request.) `counters`: of dpctl.
    testing::AssertionResult agree(const nlohmann::json& counters) const;

private:
    std::uint8_t address_ = 0;
    std::uint64_t octets_ = 0;
    std::uint64_t requests_ = 0;
    std::uint64_t to_us_without_answer_ = 0; ///< SDN to the station or to all: the daemon counts it, too
    std::uint64_t answers_ = 0;
};

} // namespace conformance
