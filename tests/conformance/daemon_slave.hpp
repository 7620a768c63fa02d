// SPDX-License-Identifier: Apache-2.0
/// The real daemon at 93.75 kbit/s on a pty, with a drive line and a simulated drive. A telegram comes whole.
#pragma once

#include "dpsim/common/system.hpp"
#include "family.hpp"
#include "sent_counts.hpp"
#include "slave_at_wire.hpp"
#include "system/gateway.hpp"

#include <chrono>
#include <string>

namespace conformance {

class DaemonSlave final : public SlaveAtWire {
public:
    explicit DaemonSlave(const Family& family);

    /// Device and drive are switched off and on: nothing is left of the case before.
    void begin_case();
    /// The daemon has counted each request that it has not answered.
    void end_case();

    std::optional<Octets> ask(const Octets& request) override;
    testing::AssertionResult is_silent_to(const Octets& octets) override;
    void send(const Octets& telegram) override;
    void pass(std::chrono::milliseconds time) override;

    void restart(std::uint8_t address) override;
    void drive_answers(bool does) override;
    void set_input(std::size_t index, std::uint16_t word) override;
    testing::AssertionResult drive_gets(std::uint16_t word) override;
    std::vector<std::uint16_t> written() override;
    void report_fault(bool stands) override;

private:
    using Time = std::chrono::steady_clock::time_point;

    void after_pause();
    void write(const Octets& octets);
    void write_request(const Octets& request);
    void write_other(const Octets& octets);
    void expect_nothing(Time until);
    std::optional<Octets> reply_until(Time slot_ends);
    std::optional<Octets> reply_before_repetition(const Octets& damaged);
    void start(std::uint8_t address);
    void drop_doubles(const Octets& reply);
    void tell_drive(const std::string& command);

    const Family& family_;
    dpslave::sim::Pty bus_;
    dpslave::test::Gateway gateway_;
    SentCounts sent_;
    Octets damaged_;                ///< what was sent last, if it is no telegram
    Octets heard_;                  ///< behind the last telegram
    std::size_t written_until_ = 0; ///< line of what the drive says
};

} // namespace conformance
