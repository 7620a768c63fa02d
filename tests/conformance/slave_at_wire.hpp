// SPDX-License-Identifier: Apache-2.0
/// What a case of conformance has before it: a slave at a wire, and the drive behind it. A case is written
/// once and runs on the simulated clock (simulated_slave.hpp) and against the real daemon (daemon_slave.hpp).
#pragma once

#include "support/master.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <vector>

namespace conformance {

using test::Octets;

class SlaveAtWire : public test::Wire {
public:
    virtual ~SlaveAtWire() = default;

    // ---- the wire. Each telegram goes out T_SYN after the last octet on the line.

    /// A request that has to be answered. What the machine was too busy for is repeated, as a master does:
    /// the slave must not speak late. It must have counted each of them that it did not answer.
    std::optional<Octets> ask(const Octets& request) override = 0;
    /// Octets that must not be answered, and a slot time without a word.
    virtual testing::AssertionResult is_silent_to(const Octets& octets) = 0;
    /// A telegram without acknowledgement: the line is free behind it. A word of the slave before the next
    /// telegram is a failure.
    void send(const Octets& telegram) override = 0;
    /// No station sends.
    virtual void pass(std::chrono::milliseconds time) = 0;

    // ---- the device and its drive.

    /// The supply goes off and on. The address switch stands at `address`.
    virtual void restart(std::uint8_t address) = 0;
    /// The drive is off (false) or on.
    virtual void drive_answers(bool does) = 0;
    /// The drive has another value of input `index`. Returns when the slave has taken it.
    virtual void set_input(std::size_t index, std::uint16_t word) = 0;
    /// The drive gets `word` for the first output.
    virtual testing::AssertionResult drive_gets(std::uint16_t word) = 0;
    /// What the drive has got for the first output since the last call, in order.
    virtual std::vector<std::uint16_t> written() = 0;
    /// The device reports its fault in the diagnosis, or none any more. Returns when Slave_Diag has it.
    virtual void report_fault(bool stands) = 0;
};

} // namespace conformance
