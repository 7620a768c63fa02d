// SPDX-License-Identifier: Apache-2.0
// What is lost and comes back: a drive, the master, the bus cable, the adapter. The last value of the master
// is never lost, and a drive without a master gets its safe state once.
#include "gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHealthy = "00 0C 00 02 05 33"; ///< Slave_Diag: watchdog on, master 2, ident 0x0533

TEST(DriveLoss, HoldsTheInputsAndWritesWhatTheMasterChangedMeanwhileAfterTheReturn)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 30s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("hex") == kHealthy; }));

    gateway.drive().send_line("silence");
    EXPECT_TRUE(gateway.daemon().says("unwinder: the drive does not answer"));
    EXPECT_TRUE(master.does("out 1 = 700"));
    EXPECT_TRUE(master.does("expect in 1 = 1250"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag 000C00020533"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("drive").at("link") == "silent"; }));
    EXPECT_EQ(gateway.station().at("state"), "Data_Exch");
    EXPECT_EQ(gateway.word(55).at("state"), "stale");
    EXPECT_EQ(gateway.word(55).at("raw"), 1250);
    EXPECT_EQ(gateway.diagnosis().at("hex"), kHealthy);
    EXPECT_THAT(gateway.dpctl({"diag"}).out, HasSubstr("the drive does not answer"));
    EXPECT_THAT(gateway.dpctl({"io"}).out, HasSubstr("stale"));

    gateway.drive().skip();
    gateway.drive().send_line("set 55 20.00");
    gateway.drive().send_line("ok");
    EXPECT_TRUE(gateway.drive().says("tag 56 written 7.00"));
    EXPECT_TRUE(master.does("wait 30s for in 1 = 2000"));
    EXPECT_TRUE(eventually([&] { return gateway.word(55).at("state") == "good"; }));
    EXPECT_EQ(gateway.station().at("drive").at("link"), "answers");
    EXPECT_EQ(gateway.station().at("left_count"), 0);
}

TEST(DriveLoss, OfOneStationLeavesTheOtherOnTheSameLineAtWork)
{
    Gateway gateway{{.units = {"00", "01"}}};
    Process& drive = gateway.drive();
    {
        Master first{gateway, {"--tags", "55,56w", "--no-watchdog"}, 5}; // the slave keeps its last words
        ASSERT_TRUE(first.does("start 30s"));
        EXPECT_TRUE(first.does("out 1 = 500"));
        EXPECT_TRUE(drive.says("unit 00: tag 56 written 5.00"));
        EXPECT_TRUE(first.does("stop"));
        EXPECT_TRUE(first.leaves());
    }
    Master second{gateway, {"--tags", "55,56w"}, 6};
    ASSERT_TRUE(second.does("start 30s"));
    EXPECT_TRUE(gateway.exchange_ends_with(0)) << "both are";

    drive.send_line("unit 00");
    drive.send_line("silence");
    EXPECT_TRUE(gateway.daemon().says("unwinder: the drive does not answer"));
    drive.send_line("unit 01");
    for (const char* const value : {"11", "12", "13", "14", "15"}) {
        drive.send_line(std::string{"set 55 "} + value);
        EXPECT_TRUE(second.does(std::string{"wait 30s for in 1 = "} + value + "00"));
        EXPECT_TRUE(second.does(std::string{"out 1 = "} + value + "00"));
        EXPECT_TRUE(drive.says(std::string{"unit 01: tag 56 written "} + value + ".00"));
    }
    EXPECT_EQ(gateway.station(0).at("drive").at("link"), "silent");
    EXPECT_EQ(gateway.station(0).at("state"), "Data_Exch");
    EXPECT_EQ(gateway.station(1).at("drive").at("link"), "answers");
    EXPECT_EQ(gateway.station(1).at("drive").at("losses"), 0);

    drive.skip();
    drive.send_line("unit 00");
    drive.send_line("ok");
    EXPECT_TRUE(drive.says("unit 00: tag 56 written 5.00"));
}

TEST(Drive, ThatIsSlowIsWaitedFor)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    gateway.drive().send_line("slow 50");
    ASSERT_TRUE(master.does("start 30s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 30s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_EQ(gateway.station().at("drive").at("losses"), 0);
}

TEST(Drive, ThatRefusesAnOutputIsShownWithItsReasonUntilItTakesTheValue)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,62w"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(master.does("out 1 = 2001")); // the drive's limit is 200.0
    EXPECT_TRUE(gateway.drive().says("refused, EE"));
    EXPECT_TRUE(eventually([&] { return gateway.word(62).at("state") == "out_of_range"; }));
    EXPECT_THAT(gateway.dpctl({"diag"}).out, HasSubstr("tag 62: "));
    EXPECT_EQ(gateway.station().at("drive").at("link"), "answers");
    EXPECT_TRUE(master.does("out 1 = 2000"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written 200.0"));
    EXPECT_TRUE(eventually([&] { return gateway.word(62).at("state") == "good"; }));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("trouble").empty(); }));
}

TEST(MasterLoss, ByACutCableZeroesTheOutputsOnceAndTheMasterStartsUpAgain)
{
    Gateway gateway{{.output_refresh_s = "0"}}; // every round, so that going on writing would be seen
    Master master{gateway, {"--tags", "55,56w", "--watchdog", "500"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));

    gateway.bus().send_line("cut");
    EXPECT_TRUE(gateway.daemon().says("the watchdog expired: the master is silent"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(master.does("wait 30s for state not data-exchange"));
    for (int i = 0; i < 5; ++i)
        EXPECT_THAT(gateway.dpctl({"read", "56"}).out, HasSubstr("is 0.00")) << "the drive is still served";
    EXPECT_EQ(gateway.drive().how_often("tag 56 written"), 0U) << "zero is written once, then writing stops";
    EXPECT_TRUE(gateway.exchange_ends_with(1));
    EXPECT_EQ(gateway.station().at("left_because"), "the watchdog expired: the master is silent");

    gateway.bus().send_line("restore");
    EXPECT_TRUE(master.does("wait 30s for state data-exchange"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(gateway.exchange_ends_with(0));
}

TEST(MasterLoss, WithoutWatchdogIsNoneTheOutputsHold)
{
    Gateway gateway{{.output_refresh_s = "0.1"}};
    Master master{gateway, {"--tags", "55,56w", "--no-watchdog"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(gateway.daemon().says("runs without watchdog"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));

    gateway.bus().send_line("cut");
    EXPECT_TRUE(master.does("wait 30s for state not data-exchange"));
    EXPECT_TRUE(eventually([&] {
        const Json age = gateway.json({"status"}).at("bus").at("last_telegram_age_ms");
        return age.is_number() && age > 1500;
    }));
    gateway.drive().skip();
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_EQ(gateway.station().at("state"), "Data_Exch");
    EXPECT_EQ(gateway.word(56).at("raw"), 500);
    EXPECT_TRUE(gateway.station().at("watchdog_ms").is_null());
}

TEST(BusPort, ThatVanishesAndReturnsIsOpenedAgain)
{
    Gateway gateway;
    {
        Master master{gateway, {"--tags", "55,56w", "--watchdog", "500"}};
        ASSERT_TRUE(master.does("start 30s"));
        EXPECT_TRUE(master.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
        gateway.unplug_bus();
        EXPECT_TRUE(gateway.daemon().says("bus-gateway is missing"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"))
            << "the watchdog works without a port as well";
    }
    gateway.plug_bus();
    EXPECT_TRUE(gateway.daemon().says("bus-gateway is back"));
    Master master{gateway, {"--tags", "55,56w"}};
    EXPECT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(master.does("out 1 = 600"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 6.00"));
}

} // namespace
} // namespace dpslave::test
