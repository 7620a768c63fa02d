// SPDX-License-Identifier: Apache-2.0
// A Modbus server of another project (pymodbus) as the instrument: register = tag.
// Only here: a server of another hand on a tty.
#include "gateway.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

class Pymodbus : public ::testing::Test {
protected:
    Pymodbus()
    {
        Wiring wiring;
        wiring.profile = "2408f";
        wiring.protocol = "modbus-rtu";
        wiring.units = {"1"};
        wiring.keys = "ident = 0x0A0B\n";
        wiring.drive_baud = 19'200;
        wiring.simulated = false;
        wiring.started = false;
        gateway.emplace(wiring);
        start_instrument();
        gateway->start_daemon();
    }
    ~Pymodbus() override
    {
        if (!instrument) return;
        EXPECT_EQ(instrument->end(), 0);
    }
    void start_instrument()
    {
        instrument.emplace(std::vector<std::string>{"/usr/bin/python3",
                                                    source_path("tests/system/pymodbus_instrument.py"),
                                                    gateway->drive_end(), "--baud", "19200"});
        ASSERT_TRUE(instrument->says("ready"));
    }
    Arguments with(const std::string& tags) const
    {
        return {"--family", "controller", "--ident", "0x0A0B", "--tags", tags};
    }

    std::optional<Gateway> gateway;
    std::optional<Process> instrument;
};

TEST_F(Pymodbus, IsReadInBlocksAndWritten)
{
    Master master{*gateway, with("1,2,3,4,5,75,76,77,24w,25w")};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 183"));
    EXPECT_TRUE(master.does("wait 60s for in 5 = 216"));
    EXPECT_TRUE(master.does("wait 60s for in 6 = 0x0021"));
    EXPECT_TRUE(master.does("wait 60s for diag ext 030021"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(instrument->says("24 = 605"));
    EXPECT_TRUE(master.does("out 2 = 401"));
    EXPECT_TRUE(instrument->says("25 = 401"));

    instrument->send_line("set 1 -5");
    EXPECT_TRUE(instrument->says("done"));
    EXPECT_TRUE(master.does("demand read-ext 8329"));
    EXPECT_TRUE(master.does("expect demand = 50"));
    EXPECT_TRUE(master.leaves());
}

TEST_F(Pymodbus, HasATagMissingInTheMiddleAndTheOthersGoOn)
{
    instrument->send_line("drop 3");
    ASSERT_TRUE(instrument->says("done"));
    Master master{*gateway, with("1,2,3,4,5")};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 5 = 216"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 183"));
    EXPECT_TRUE(master.does("expect in 3 = 0")) << "exception 2";
    EXPECT_TRUE(gateway->word_becomes(3, "state", "invalid_tag"));
    EXPECT_EQ(gateway->word(4).at("state"), "good");
    instrument->send_line("set 5 300");
    EXPECT_TRUE(master.does("wait 60s for in 5 = 300"));
    EXPECT_TRUE(master.does("demand read 3"));
    EXPECT_TRUE(master.does("expect demand reject 0"));
}

TEST_F(Pymodbus, IsRestartedInTheMiddleAndGetsWhatTheMasterWanted)
{
    Master master{*gateway, with("1,24w")};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(instrument->says("24 = 605"));
    EXPECT_EQ(instrument->end(), 0);
    EXPECT_TRUE(gateway->daemon().says("the drive does not answer"));
    EXPECT_TRUE(master.does("out 1 = 700"));
    EXPECT_TRUE(master.does("expect state data-exchange"));

    start_instrument();
    EXPECT_TRUE(gateway->daemon().says("the drive answers"));
    EXPECT_TRUE(instrument->says("24 = 700"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 183"));
    EXPECT_TRUE(master.leaves());
}

} // namespace
} // namespace dpslave::test
