// SPDX-License-Identifier: Apache-2.0
/// Layer 2 and slave with a shipped profile on the simulated clock. The bus of tests/support is its judge
/// too: a reply outside of the window fails the case.
#pragma once

#include "family.hpp"
#include "slave_at_wire.hpp"
#include "support/bus.hpp"

#include "dpslave/dp/slave.hpp"

#include <map>
#include <memory>
#include <optional>

namespace conformance {

class SimulatedSlave final : public SlaveAtWire {
public:
    explicit SimulatedSlave(const Family& family);

    std::optional<Octets> ask(const Octets& request) override;
    testing::AssertionResult is_silent_to(const Octets& octets) override;
    void send(const Octets& telegram) override;
    void pass(std::chrono::milliseconds time) override { pass_exactly(time); }

    void restart(std::uint8_t address) override;
    void drive_answers(bool does) override { drive_answers_ = does; }
    void set_input(std::size_t index, std::uint16_t word) override;
    testing::AssertionResult drive_gets(std::uint16_t word) override;
    std::vector<std::uint16_t> written() override { return std::exchange(written_, {}); }
    void report_fault(bool stands) override;

    // ---- what only this clock can do.

    test::Bus& bus() { return *bus_; }
    dpslave::fdl::Layer2& layer2() { return *layer2_; }
    dpslave::dp::Slave& slave() { return *slave_; }
    const dpslave::dp::Personality& personality() const { return personality_; }
    void pass_exactly(std::chrono::nanoseconds time);
    /// The same device on a bus of `rate`; with `search` it begins at the highest rate and looks for it.
    void restart_at(dpslave::Baud rate, bool search);

private:
    void settle();
    void power_off();
    void power_on(const dpslave::fdl::Layer2Settings& settings, dpslave::Baud rate, std::uint8_t address);

    const Family& family_;
    dpslave::dp::Personality personality_;
    std::unique_ptr<dpslave::fdl::Layer2> layer2_;
    std::unique_ptr<dpslave::dp::Slave> slave_;
    std::unique_ptr<test::Bus> bus_;

    // The drive.
    std::map<std::uint16_t, std::uint16_t> words_; ///< by tag
    bool drive_answers_ = true;
    dpslave::OutputImage outputs_{};
    std::optional<dpslave::Generation> refreshed_; ///< the layout whose inputs were read
    std::vector<std::uint16_t> written_;
};

} // namespace conformance
