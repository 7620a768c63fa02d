// SPDX-License-Identifier: Apache-2.0
/// A slave that is taken off the bus at run time and comes back, elsewhere if its owner wants (B-043, B-044).
#include "bench.hpp"

namespace test {
namespace {

using dpslave::dp::State;

class SetAddress : public ExampleSlave {
protected:
    void leaves_the_bus()
    {
        slave.stop(bus.now());
        station.detach(kUs);
        bus.advance({}); // the edge wakes up once
    }
    void comes_to(std::uint8_t address)
    {
        slave.start(bus.now());
        station.attach(address, slave, personality.max_tsdr);
        bus.advance({});
    }
};

TEST_F(SetAddress, IsRefusedUntilTheSlaveIsStopped)
{
    EXPECT_FALSE(slave.set_address(7));
    EXPECT_EQ(seen().address, kUs);
    exchanges();
    EXPECT_FALSE(slave.set_address(7));

    slave.stop(bus.now());

    EXPECT_TRUE(slave.set_address(7));
    EXPECT_EQ(seen().address, 7);
}

TEST_F(SetAddress, AStoppedSlaveIsSilentAndReportsThatItLeft)
{
    exchanges();
    const auto layout = generation();
    leaves_the_bus();

    EXPECT_EQ(master.slave_diag(), "-");
    EXPECT_EQ(master.fdl_status(), "-");
    EXPECT_EQ(left(), std::vector<dpslave::Generation>{layout});
    EXPECT_EQ(state(), State::power_on);
}

TEST_F(SetAddress, TheSlaveAnswersAtItsNewAddressAndNotAtTheOld)
{
    exchanges();
    leaves_the_bus();
    ASSERT_TRUE(slave.set_address(7));
    comes_to(7);

    EXPECT_EQ(master.slave_diag(), "-");
    bus.master_sends(sd2(7, 2, 0x6D, Saps{60, 62}));
    EXPECT_EQ(bus.reply(), sd2(2, 7, 0x08, Saps{62, 60}, octets("02 05 00 FF 47 11")));
}

TEST_F(SetAddress, ComingBackToTheSameAddressIsAFreshStart)
{
    exchanges();
    leaves_the_bus();
    comes_to(kUs);

    EXPECT_EQ(diag_of(master), "02 05 00 FF");
    exchanges();
    EXPECT_EQ(master.data_exchange("00 00"), "DL 12 34");
}

} // namespace
} // namespace test
