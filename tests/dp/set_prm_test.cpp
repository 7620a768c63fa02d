// SPDX-License-Identifier: Apache-2.0
/// Set_Prm in all its forms (conformance tests C-09, C-21, C-22 of wire reference 10).
#include "bench.hpp"

namespace test {
namespace {

using dpslave::Tbit;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;
using namespace std::chrono_literals;

using SetPrm = ExampleSlave;

TEST_F(SetPrm, C09_AllFourLockBits)
{
    master.set_prm("08 14 01 0B 47 11 01"); // neither
    EXPECT_EQ(state(), State::wait_prm);
    master.set_prm("48 14 01 0B 47 11 01"); // unlock
    EXPECT_EQ(state(), State::wait_prm);
    master.set_prm("C8 14 01 0B 47 11 01"); // both: unlock
    EXPECT_EQ(state(), State::wait_prm);
    master.set_prm("88 14 01 0B 47 11 01"); // lock
    EXPECT_EQ(state(), State::wait_cfg);
}

TEST_F(SetPrm, C09_TheReservedBitsAreIgnored)
{
    master.set_prm("8F 14 01 0B 47 11 01");

    EXPECT_EQ(diag_of(master), "02 0C 00 02");
}

TEST_F(SetPrm, C09_EachReservedBitAloneIsIgnored)
{
    for (const std::string_view status : {"81", "82", "84", "87"}) {
        EXPECT_EQ(master.set_prm(std::string{status} + " 00 00 0B 47 11 01"), "SC");
        EXPECT_EQ(diag_of(master), "02 04 00 02") << status << ": neither watchdog nor Sync nor Freeze";
        master.chk_cfg(kCfg);
        EXPECT_EQ(state(), State::data_exch) << status;
        master.control("28 00");
        EXPECT_FALSE(seen().sync || seen().freeze) << status;
        master.set_prm("40 00 00 00 47 11 00");
    }
}

TEST_F(SetPrm, C09_AsLongAsATelegramCanBe)
{
    Octets longest = octets(kPrm);
    longest.resize(244, 0x5A);

    EXPECT_EQ(master.set_prm(show(longest)), "SC");

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().prm.size(), 244u);
}

TEST_F(SetPrm, C09_AWatchdogFactorOf0IsAPrmFault)
{
    master.set_prm("88 00 01 0B 47 11 01");
    EXPECT_EQ(diag_of(master), "42 05 00 FF");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_watchdog, 2, 1, 0}));
    master.set_prm("88 01 00 0B 47 11 01");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_watchdog, 3, 1, 0}));
}

TEST_F(SetPrm, C09_WithTheWatchdogOffTheFactorsDoNotMatter)
{
    master.set_prm("80 00 00 0B 47 11 01");

    EXPECT_EQ(state(), State::wait_cfg);
}

TEST_F(SetPrm, C09_TheIdentIsCheckedBeforeEverythingElse)
{
    master.set_prm("B8 00 00 0B 11 47 01");

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_ident, 5, 0x4711, 0x1147}));
}

class SetPrmWithoutSync : public ExampleSlave {
protected:
    SetPrmWithoutSync() : ExampleSlave(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = example_device();
        device.sync = false;
        return device;
    }
};

TEST_F(SetPrmWithoutSync, C09_UnsupportedSyncIsReportedBeforeTheWatchdogFactors)
{
    master.set_prm("B8 00 00 0B 47 11 01");

    EXPECT_EQ(diag_of(master), "12 05 00 FF");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_not_supported, 1, 0x98, 0xB8}));
}

TEST_F(SetPrm, C21_InDataExchTheWatchdogIsTakenAtOnce)
{
    exchanges();

    master.set_prm("88 03 01 0B 47 11 01"); // 30 ms instead of 200
    time_is(bus.asked_at() + 30ms);

    EXPECT_EQ(state(), State::wait_prm);
}

TEST_F(SetPrm, C21_InDataExchTheWatchdogCanBeSwitchedOff)
{
    exchanges();

    master.set_prm(kPrmNoWatchdog);
    bus.advance(10s);

    EXPECT_EQ(state(), State::data_exch);
    EXPECT_EQ(diag_of(master), "00 04 00 02");
}

TEST_F(SetPrm, C21_AMasterThatGivesSyncUpInDataExchEndsIt)
{
    exchanges(kPrmSyncFreeze);
    master.control("28 00");
    master.data_exchange("A5 01");

    master.set_prm(kPrm);

    EXPECT_EQ(diag_of(master), "00 0C 00 02");
    EXPECT_EQ(master.rd_outp(), "DL A5 01");
}

TEST_F(SetPrm, C21_MinTsdrAloneWithAWrongIdentInDataExch)
{
    exchanges();

    EXPECT_EQ(master.set_prm("00 00 00 32 FF FF 00"), "SC");
    bus.set_min_tsdr({50});

    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
    EXPECT_EQ(bus.turnaround(), bus.bits(50));
}

struct Pause {
    const char* name;
    const char* octet;
    std::uint32_t before; // what Set_Prm before it brought
    std::uint32_t after;
};

class MinTsdr : public ExampleSlave, public testing::WithParamInterface<Pause> {};

TEST_P(MinTsdr, C22_IsKeptBeforeTheReplyThatFollows)
{
    const Pause& pause = GetParam();
    master.set_prm("00 00 00 " + show({static_cast<std::uint8_t>(pause.before)}) + " 00 00 00");
    bus.set_min_tsdr({pause.before});

    EXPECT_EQ(master.set_prm(std::string{"88 14 01 "} + pause.octet + " 47 11 01"), "SC");
    EXPECT_EQ(bus.turnaround(), bus.bits(pause.before)); // its own acknowledgement: as before
    bus.set_min_tsdr({pause.after});
    diag_of(master);

    EXPECT_EQ(bus.turnaround(), bus.bits(pause.after));
    EXPECT_EQ(seen().min_tsdr, Tbit{pause.after});
}

INSTANTIATE_TEST_SUITE_P(SetPrm, MinTsdr,
                         testing::Values(Pause{"Zero_KeepsTheOld", "00", 37, 37},
                                         Pause{"One_Is11", "01", 37, 11}, Pause{"Five_Is11", "05", 37, 11},
                                         Pause{"Ten_Is11", "0A", 37, 11}, Pause{"Eleven", "0B", 37, 11},
                                         Pause{"Twelve", "0C", 11, 12}, Pause{"Hundred", "64", 11, 100},
                                         Pause{"Longest", "FF", 11, 255}),
                         [](const auto& one) { return std::string{one.param.name}; });

TEST_F(SetPrm, C22_MinTsdrOutlivesTheWayBackToWaitPrm)
{
    master.set_prm("88 14 01 64 47 11 01");
    bus.set_min_tsdr({100});
    master.set_prm("40 00 00 00 47 11 00");

    EXPECT_EQ(state(), State::wait_prm);
    EXPECT_EQ(slave.min_tsdr(), Tbit{100});
}

} // namespace
} // namespace test
