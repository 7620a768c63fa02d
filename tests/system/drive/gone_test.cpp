// SPDX-License-Identifier: Apache-2.0
// Tests what the master sees of a drive that is gone, for each value of when_drive_lost.
// Only here: a station that a drive thread takes off the bus of another thread.
#include "gateway.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

/// One station in data exchange with its drive, which holds 12.50 in tag 55 and was sent 5.00 in tag 56.
class GoneDrive : public ::testing::Test {
protected:
    void begins(const std::string& when_drive_lost)
    {
        gateway = std::make_unique<Gateway>(Wiring{.when_drive_lost = when_drive_lost});
        master = std::make_unique<Master>(*gateway, Arguments{"--tags", "55,56w"});
        ASSERT_TRUE(master->does("start 60s"));
        gateway->drive().send_line("set 55 12.50");
        ASSERT_TRUE(master->does("wait 60s for in 1 = 1250"));
        ASSERT_TRUE(master->does("out 1 = 500"));
        ASSERT_TRUE(gateway->drive().says("tag 56 written 5.00"));
    }
    std::string link() const { return gateway->station().at("drive").at("link"); }
    std::string state() const { return gateway->station().at("state"); }

    std::unique_ptr<Gateway> gateway;
    std::unique_ptr<Master> master;
};

TEST_F(GoneDrive, TakesItsStationOffTheBusAndTheReturnBringsFreshValues)
{
    begins("silent");
    gateway->drive().skip();
    gateway->drive().send_line("silence");
    EXPECT_TRUE(gateway->daemon().says("The drive is gone"));
    EXPECT_TRUE(eventually([&] { return state() == "Power_On"; }));
    EXPECT_EQ(link(), "gone");
    EXPECT_THAT(gateway->dpctl({"status"}).out, HasSubstr("gone"));
    EXPECT_THAT(gateway->dpctl({"events"}).out, HasSubstr("The drive is gone"));
    EXPECT_THAT(gateway->dpctl({"doctor"}).out, HasSubstr("no longer answers"));
    EXPECT_TRUE(master->does("try wait 2s for in 1 = 1250"));
    EXPECT_TRUE(eventually([&] { return master->ever_said("no longer answers"); }));

    gateway->drive().send_line("set 55 20.00");
    gateway->drive().send_line("ok");
    EXPECT_TRUE(gateway->drive().says("tag 56 written 0.00")) << "before the station appears";
    EXPECT_TRUE(gateway->daemon().says("the station is on the bus again"));
    EXPECT_TRUE(master->does("start 60s"));
    EXPECT_TRUE(master->does("expect in 1 = 2000")) << "the first word that it reads is fresh";
    EXPECT_TRUE(master->does("out 1 = 700"));
    EXPECT_TRUE(gateway->drive().says("tag 56 written 7.00"));
}

TEST_F(GoneDrive, AsksForDiagnosisUntilEveryInputHasBeenReadAgain)
{
    begins("diagnosis");
    gateway->drive().send_line("silence");
    EXPECT_TRUE(gateway->daemon().says("The drive is gone"));
    EXPECT_TRUE(master->does("wait 60s for diag stat-diag"));
    EXPECT_EQ(state(), "Data_Exch");
    EXPECT_EQ(link(), "gone");

    gateway->drive().send_line("set 55 20.00");
    gateway->drive().send_line("ok");
    EXPECT_TRUE(master->does("wait 60s for diag not stat-diag"));
    EXPECT_TRUE(master->does("wait 10s for in 1 = 2000"));
    EXPECT_EQ(gateway->station().at("left_count"), 0);
}

TEST_F(GoneDrive, WithHoldTheMasterSeesNothing)
{
    begins("hold");
    gateway->drive().send_line("silence");
    EXPECT_TRUE(gateway->daemon().says("the drive does not answer"));
    EXPECT_TRUE(master->does("wait 4s"));
    EXPECT_TRUE(master->does("expect in 1 = 1250"));
    EXPECT_EQ(state(), "Data_Exch");
    EXPECT_EQ(link(), "silent");
}

TEST(AbsentDrive, ItsStationAppearsWhenItHasAnswered)
{
    Gateway gateway{{.when_drive_lost = "silent", .drive = {"--fault", "silence"}}};
    EXPECT_TRUE(gateway.daemon().says("is gone"));
    EXPECT_EQ(gateway.station().at("state"), "Power_On");

    gateway.drive().send_line("ok");
    Master master{gateway, {"--tags", "55,56w"}};
    EXPECT_TRUE(gateway.daemon().says("the station is on the bus again"));
    EXPECT_TRUE(master.does("start 60s"));
}

TEST(GoneDriveOfABox, IsAHardwareFaultOfTheBoxAndItsLampsAreOff)
{
    Gateway gateway{{.profile = "605", .when_drive_lost = "silent"}};
    EXPECT_TRUE(eventually([&] { return gateway.station().at("state") == "Wait_Prm"; }));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(gateway.daemon().says("The drive is gone"));
    EXPECT_TRUE(eventually([&] { return gateway.tec("FAULT") == 4; }));
    EXPECT_EQ(gateway.tec("NETWORK STATE"), 5);

    gateway.drive().send_line("ok");
    EXPECT_TRUE(eventually([&] { return gateway.tec("FAULT") == 0; }));
}

TEST(GoneDriveOnASearchedRate, WhileAllStationsAreSilentANewRateOfTheMasterIsFound)
{
    Gateway gateway{{.bus_baud = 187'500, .when_drive_lost = "silent", .started = false}};
    std::string text = gateway.config_text();
    text.replace(text.find("baud = 187500"), 13, "baud = \"auto\"");
    write_file(gateway.config(), text);
    gateway.start_daemon();
    const auto bus = [&](const char* field) { return gateway.json({"status"}).at("bus").at(field); };
    {
        Master master{gateway, {"--tags", "55,56w"}};
        ASSERT_TRUE(master.does("start 50s"));
        ASSERT_EQ(bus("baud_state"), "DP_Control");
        gateway.drive().send_line("silence");
        ASSERT_TRUE(gateway.daemon().says("The drive is gone"));
        EXPECT_TRUE(eventually([&] { return bus("baud_state") != "DP_Control"; }))
            << "what is not on the bus supervises nothing";
    }
    gateway.bus().send_line("baud 500000");
    Process other{{program_path("dpsim"), "master", "--port", gateway.bus_end(), "--baud", "500000",
                   "--slave", "5", "--watchdog", "5s", "--tags", "55,56w"}};
    other.send_line("start 50s");
    other.send_line("out 1 = 600");
    EXPECT_TRUE(eventually([&] { return bus("baud") == 500'000 && bus("baud_state") == "Baud_Control"; }))
        << "by the requests to a station that is not there";
    EXPECT_EQ(gateway.station().at("state"), "Power_On");

    gateway.drive().send_line("ok");
    EXPECT_TRUE(gateway.drive().says("tag 56 written 6.00", 2 * kLimit));
}

} // namespace
} // namespace dpslave::test
