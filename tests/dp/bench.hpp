// SPDX-License-Identifier: Apache-2.0
/// The tests of DP use this: device types made by hand, masters that keep their frame count bit, and a
/// slave 5 behind a real layer 2 on the simulated bus.
#pragma once

#include "support/bus.hpp"
#include "support/master.hpp"

#include "dpslave/dp/slave.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace test {

/// The slave of the examples in the wire reference: ident 4711, two octets in (11), two out (21), no tags.
dpslave::dp::Personality example_device();
/// HA389815: ident 0533, 24 octets with 12 tags, 73 / 50 / 60, Sync and Freeze, six octets of diagnosis.
dpslave::dp::Personality option_board();
/// HA463561: DPV1_Status, tags from octet 3, also 70 (read and write), up to 30 parameters, four octets of
/// extended diagnosis.
dpslave::dp::Personality technology_box();
/// 2408f/2404f handbook: no Sync, no Freeze, 117 words, extended Demand Data, three octets of extended
/// diagnosis.
dpslave::dp::Personality controller();

/// A tag that the master reads, and one that it writes.
inline dpslave::LayoutEntry input(std::uint16_t tag)
{
    return {tag, true, false};
}
inline dpslave::LayoutEntry output(std::uint16_t tag)
{
    return {tag, false, true};
}

/// Set_Prm of the option board: status, factors, min T_SDR, ident, group, then 12 tags (the rest 0).
std::string board_prm(const std::vector<std::uint16_t>& tags,
                      std::string_view header = "88 14 01 0B 05 33 01");

class DpBench : public testing::Test {
protected:
    explicit DpBench(dpslave::dp::Personality device);

    /// Set_Prm and Chk_Cfg, which must be accepted.
    void start_up(std::string_view prm, std::string_view cfg);
    /// The drive side has tried every input of the present layout; these are its words.
    void inputs_are(const std::vector<std::uint16_t>& words);
    /// The owner reads diagnosis, so that nothing is pending any more.
    void diagnosis_is_read() { master.slave_diag(); }
    void time_is(dpslave::Instant at) { bus.advance(at - bus.now()); }

    dpslave::dp::State state() const { return slave.state(); }
    dpslave::dp::Snapshot seen() const { return slave.snapshot(); }
    dpslave::Generation generation() const { return slave.snapshot().layout.generation; }
    std::vector<dpslave::dp::Event> events();
    /// Each "left Data_Exch" that was reported since the last call.
    std::vector<dpslave::Generation> left();

    dpslave::dp::Personality personality;
    dpslave::fdl::Layer2 station{{.baud = dpslave::Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dpslave::dp::Slave slave{personality, kUs};
    Bus bus{station};
    Master master{bus, 2};
    Master foreign{bus, 9};
};

/// The example device, with the prm and cfg of wire reference 4.2.
class ExampleSlave : public DpBench {
protected:
    explicit ExampleSlave(dpslave::dp::Personality device = example_device()) : DpBench(std::move(device)) {}
    static constexpr std::string_view kPrm = "88 14 01 0B 47 11 01";
    static constexpr std::string_view kPrmNoWatchdog = "80 00 00 0B 47 11 01";
    static constexpr std::string_view kPrmSyncFreeze = "B8 14 01 0B 47 11 01";
    static constexpr std::string_view kCfg = "11 21";
    /// Data_Exch without Stat_Diag, nothing pending.
    void exchanges(std::string_view prm = kPrm);
    /// All master to slave: Slave_Diag without the ident, "02 05 00 FF".
    std::string diag_of(Master& who) { return who.slave_diag().substr(3, 11); }
};

class OptionBoard : public DpBench {
protected:
    OptionBoard() : DpBench(option_board()) {}
};

} // namespace test
