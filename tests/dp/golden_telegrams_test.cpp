// SPDX-License-Identifier: Apache-2.0
/// Every worked telegram of the wire reference that DP answers, octet by octet.
#include "bench.hpp"

namespace test {
namespace {

using dpslave::dp::State;

using GoldenTelegrams = ExampleSlave;

TEST_F(GoldenTelegrams, ExampleSequence4_2)
{
    EXPECT_EQ(master.says("10 05 02 49 50 16"), "10 02 05 00 07 16");
    EXPECT_EQ(master.says("68 05 05 68 85 82 6D 3C 3E EE 16"),
              "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
    EXPECT_EQ(master.says("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16"), "E5");
    EXPECT_EQ(master.says("68 07 07 68 85 82 7D 3E 3E 11 21 32 16"), "E5");
    EXPECT_EQ(master.says("68 05 05 68 85 82 5D 3C 3E DE 16"),
              "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16");
    inputs_are({0x1234});
    EXPECT_EQ(master.says("68 05 05 68 85 82 7D 3C 3E FE 16"),
              "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16");
    EXPECT_EQ(master.says("68 05 05 68 05 02 5D 00 00 64 16"), "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(master.says("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16"), "-");
    slave.set_ext_diag(octets("02 01"), true);
    EXPECT_EQ(master.says("68 05 05 68 05 02 7D A5 01 2A 16"), "68 05 05 68 02 05 0A 12 34 57 16");
    EXPECT_EQ(master.says("68 05 05 68 85 82 5D 3C 3E DE 16"),
              "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 01 FA 16");
    EXPECT_EQ(master.says("68 05 05 68 05 02 7D A5 01 2A 16"), "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{200});
    EXPECT_EQ(seen().groups, 0x01);
}

TEST_F(GoldenTelegrams, GetCfg4_5)
{
    exchanges();

    EXPECT_EQ(master.says("68 05 05 68 85 82 5D 3B 3E DD 16"), "68 07 07 68 82 85 08 3E 3B 11 21 BA 16");
}

TEST_F(GoldenTelegrams, NoOutputsTwoInputs4_7)
{
    start_up(kPrm, "11");
    inputs_are({0x1234});
    diagnosis_is_read();

    EXPECT_EQ(master.says("10 05 02 7D 84 16"), "68 05 05 68 02 05 08 12 34 55 16");
}

TEST_F(GoldenTelegrams, TwoOutputsNoInputs4_7)
{
    start_up(kPrm, "21");

    EXPECT_EQ(master.says("68 05 05 68 05 02 5D 01 02 67 16"), "E5");
}

TEST_F(GoldenTelegrams, PendingDiagnosisWithoutInputs4_7)
{
    start_up(kPrm, "21");
    slave.set_ext_diag(octets("02 01"), true);

    EXPECT_EQ(master.says("68 05 05 68 05 02 5D 01 02 67 16"), "10 02 05 0A 11 16");
}

TEST_F(GoldenTelegrams, NotInDataExchange4_7)
{
    EXPECT_EQ(master.says("68 05 05 68 05 02 7D 00 00 84 16"), "10 02 05 03 0A 16");
}

TEST_F(GoldenTelegrams, ReadingBackByAnotherMaster4_8)
{
    exchanges();
    master.data_exchange("A5 01");

    EXPECT_EQ(foreign.says("68 05 05 68 85 89 6D 38 3E F1 16"), "68 07 07 68 89 85 08 3E 38 12 34 D2 16");
    EXPECT_EQ(foreign.says("68 05 05 68 85 89 5D 39 3E E2 16"), "68 07 07 68 89 85 08 3E 39 A5 01 33 16");
}

TEST_F(GoldenTelegrams, GlobalControls4_10)
{
    exchanges(kPrmSyncFreeze);
    master.data_exchange("A5 01");

    master.says("68 07 07 68 FF 82 46 3A 3E 20 01 60 16"); // Sync, group 1
    EXPECT_TRUE(seen().sync);
    master.says("68 07 07 68 FF 82 46 3A 3E 10 01 50 16"); // Unsync, group 1
    EXPECT_FALSE(seen().sync);
    master.says("68 07 07 68 FF 82 46 3A 3E 08 00 47 16"); // Freeze, all
    EXPECT_TRUE(seen().freeze);
    master.says("68 07 07 68 FF 82 46 3A 3E 04 00 43 16"); // Unfreeze, all
    EXPECT_FALSE(seen().freeze);
    EXPECT_EQ(seen().outputs[1], 0xA501);
    master.says("68 07 07 68 FF 82 44 3A 3E 00 00 3D 16"); // Operate, SDN low
    EXPECT_EQ(seen().outputs[1], 0xA501);
    master.says("68 07 07 68 FF 82 46 3A 3E 02 00 41 16"); // Clear all
    EXPECT_EQ(seen().outputs[1], 0);
}

TEST_F(GoldenTelegrams, LostReply2_6)
{
    start_up(kPrm, kCfg);
    inputs_are({0xAA55});
    diagnosis_is_read();

    EXPECT_EQ(master.says("68 05 05 68 05 02 7D 12 34 CA 16"), "68 05 05 68 02 05 08 AA 55 0E 16");
    inputs_are({0xAA56});
    EXPECT_EQ(master.says("68 05 05 68 05 02 7D 12 34 CA 16"), "68 05 05 68 02 05 08 AA 55 0E 16");
    EXPECT_EQ(master.says("68 05 05 68 05 02 5D 12 35 AB 16"), "68 05 05 68 02 05 08 AA 56 0F 16");
}

class GoldenFailSafe : public ExampleSlave {
protected:
    GoldenFailSafe() : ExampleSlave(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = example_device();
        device.fail_safe = true;
        return device;
    }
};

TEST_F(GoldenFailSafe, Clear4_7)
{
    exchanges();
    master.data_exchange("00 00");
    master.data_exchange("A5 01"); // frame count bit 1: the next one is no retry

    EXPECT_EQ(master.says("10 05 02 5D 64 16"), "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(master.rd_outp(), "DL 00 00");
    EXPECT_EQ(state(), State::data_exch);
}

TEST_F(GoldenTelegrams, ExtendedDiagnosisOfAllThreeKinds5_3)
{
    exchanges();
    slave.set_ext_diag(octets("04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7"), true);

    EXPECT_EQ(
        master.says("68 05 05 68 85 82 6D 3C 3E EE 16"),
        "68 1A 1A 68 82 85 08 3E 3C 08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7 95 16");
}

/// The frames of a real master towards an ET 200S (slave 8, master 1): the same device made of data.
class CapturedStartUp : public testing::Test {
protected:
    CapturedStartUp()
    {
        device.ident = 0x80E0;
        device.max_tsdr = kClassMaxTsdr;
        device.identifiers = {{0x00, false, false}, {0x10, true, false}};
        device.max_parameters = 63;
        device.prm = {.max_length = 237, .may_be_absent = true, .list = dpslave::dp::TagList::none};
        device.sync = device.freeze = true;
        slave.start(bus.now());
        station.attach(8, slave, device.max_tsdr);
    }

    dpslave::dp::Personality device;
    dpslave::fdl::Layer2 station{{.baud = dpslave::Baud::k187_5, .search = {}, .start_up_latency = {}}};
    dpslave::dp::Slave slave{device, 8};
    Bus bus{station};
    Master master{bus, 1};
};

TEST_F(CapturedStartUp, RunsAsCaptured)
{
    EXPECT_EQ(master.says("68 07 07 68 FF 81 46 3A 3E 00 00 3E 16"), "-");
    EXPECT_EQ(master.says("68 05 05 68 88 81 6D 3C 3E F0 16"),
              "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 80 E0 F1 16");
    EXPECT_EQ(master.says("68 0C 0C 68 88 81 7D 3D 3E B8 0D 0F 0B 80 E0 00 40 16"), "E5");
    EXPECT_EQ(slave.snapshot().watchdog, std::chrono::milliseconds{1950});
    EXPECT_EQ(master.says("68 08 08 68 88 81 5D 3E 3E 00 10 10 02 16"), "E5");
    EXPECT_EQ(slave.state(), State::data_exch);
    EXPECT_EQ(master.says("68 05 05 68 88 81 7D 3C 3E 00 16"),
              "68 0B 0B 68 81 88 08 3E 3C 00 0E 00 01 80 E0 FA 16");
    EXPECT_EQ(master.says("68 05 05 68 88 81 5D 3B 3E DF 16"), "68 08 08 68 81 88 08 3E 3B 00 10 10 AA 16");
}

} // namespace
} // namespace test
