// SPDX-License-Identifier: Apache-2.0
// The technology box (6053/6055): extended diagnosis, the TEC OPTION function block, RIDE THROUGH, lamps.
// Only here: commands that change the function block of a running daemon.
#include "system/gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Of a drive that was made for these tests: a trip code in tag 4, lamps in tag 272.
constexpr const char* kTable = R"(tag,name,type,decimals,min,max,access,values,start
4,Trip code,WORD,,0000,FFFF,ro,,0000
31,Event word,WORD,,0000,FFFF,ro,,0000
55,Speed feedback,INT,2,-300.00,300.00,ro,,0.00
56,Speed setpoint,INT,2,-105.00,105.00,rw,,0.00
57,Torque setpoint,INT,2,-200.00,200.00,rw,,0.00
272,Status,WORD,,0000,FFFF,ro,bit3=Healthy;bit4=Stopped,0008
)";

Wiring box(const std::string& tec = "trip_tag = 4\n", const std::string& keys = "")
{
    Wiring wiring;
    wiring.profile = "605";
    wiring.table = kTable;
    wiring.keys = keys + "[station.tec]\n" + tec;
    return wiring;
}

Arguments for_box(Arguments more)
{
    more.insert(more.begin(), {"--family", "technology-box", "--ident", "0x1649", "--master", "1"});
    return more;
}

constexpr auto kFault = "FAULT";
constexpr auto kNetwork = "NETWORK STATE";
enum : int {
    kDataExchange = 0,
    kDataExError = 1,
    kWaitConfig = 2,
    kWaitParam = 3,
    kBaudSearch = 4,
    kDisabled = 5
};

bool becomes(const Gateway& gateway, const char* row, int value)
{
    return eventually([&] { return gateway.tec(row) == value; });
}

TEST(TechnologyBox, ReportsTripAndExtDiagnosticInTheGoldenDiagnosisTelegram)
{
    Gateway gateway{box()};
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for diag 000C0001164904000000")) << "the block is always sent";

    gateway.drive().send_line("set 4 0001");
    EXPECT_TRUE(master.does("wait 60s for diag 000C0001164904010000")) << "a change is an event of its own";
    EXPECT_EQ(gateway.dpctl({"tec", "set", "EXT DIAGNOSTIC", "0x6AB5"}).status, 0);
    EXPECT_TRUE(master.does("wait 60s for diag 000C00011649 04016AB5"));
    EXPECT_TRUE(master.does("expect state data-exchange"));

    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("hex") == "00 0C 00 01 16 49 04 01 6A B5"; }));
    EXPECT_THAT(gateway.dpctl({"diag"}).out, AllOf(HasSubstr("LINK OVERVOLTS"), HasSubstr("6AB5")));
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("1: LINK OVERVOLTS"));
    EXPECT_TRUE(gateway.daemon().says("trip of the drive: 1: LINK OVERVOLTS"));

    gateway.drive().send_line("set 4 0000");
    EXPECT_TRUE(master.does("wait 60s for diag 000C0001164904006AB5"));
    EXPECT_TRUE(gateway.daemon().says("trip of the drive: none any more"));
    EXPECT_TRUE(master.leaves());
}

TEST(TechnologyBox, ReportsTheFirstDiagnosisOfAStartUpWithTheTripThatStands)
{
    Gateway gateway{box("trip_tag = 4\next_diagnostic_tag = 31\n", "ext_diag_bit = true\n")};
    gateway.drive().send_line("set 4 0014");
    gateway.drive().send_line("set 31 1234");
    EXPECT_TRUE(becomes(gateway, "EXT DIAGNOSTIC", 0x1234)) << "it follows the drive, without any master";
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("hex") == "0A 05 00 FF 16 49 04 14 12 34"; }))
        << gateway.diagnosis().at("hex");
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag ext-diag"));
    EXPECT_TRUE(master.does("expect diag ext 04141234"));
    EXPECT_EQ(gateway.dpctl({"tec", "set", "EXT DIAGNOSTIC", "1"}).status, 5) << "a tag of the drive says it";
}

TEST(TechnologyBox, Of590PlusReportsThatItHasTrippedButNotWhy)
{
    Wiring wiring = box("trip_tag = 4\n", "ident = 0x0B0B\n");
    wiring.profile = "590plus";
    Gateway gateway{wiring};
    Master master{gateway, {"--family", "technology-box", "--ident", "0x0B0B", "--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 4 0005");
    EXPECT_TRUE(master.does("wait 60s for diag ext 041F0000"));
}

TEST(TechnologyBox, Of590PlusIsTrippedWhileItSaysThatItIsNotHealthy)
{
    Wiring wiring = box("trip_tag = \"!12\"\n", "ident = 0x0B0B\n");
    wiring.profile = "590plus";
    wiring.table =
        "tag,name,type,decimals,min,max,access,mnemonic,values,start\n12,HEALTHY,BOOL,,0,1,ro,,,1\n"
        "55,Speed feedback,INT,2,-300.00,300.00,ro,,,0.00\n";
    Gateway gateway{wiring};
    Master master{gateway, {"--family", "technology-box", "--ident", "0x0B0B", "--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(
        eventually([&] { return gateway.dpctl({"show"}).out.find("trip 0: NO TRIP") != std::string::npos; }));
    EXPECT_TRUE(master.does("wait 60s for diag ext 04000000")) << "a healthy drive has not tripped";

    gateway.drive().send_line("set 12 0");
    EXPECT_TRUE(master.does("wait 60s for diag ext 041F0000"));
    EXPECT_TRUE(gateway.daemon().says("trip of the drive: 31: TRIPPED"));
    gateway.drive().send_line("set 12 1");
    EXPECT_TRUE(master.does("wait 60s for diag ext 04000000"));
}

TEST(TechnologyBox, ThatReadsAndWritesOneParameterHasItInBothDirections)
{
    Gateway gateway{box()};
    Master master{gateway, for_box({"--tags", "56rw,55"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 500"));

    EXPECT_TRUE(
        eventually([&] { return gateway.json({"io"}).at("stations").at(0).at("words").size() == 3; }));
    const Json words = gateway.json({"io"}).at("stations").at(0).at("words");
    EXPECT_EQ(words.at(0).at("direction"), "in");
    EXPECT_EQ(words.at(1).at("direction"), "out");
    EXPECT_EQ(words.at(0).at("tag"), 56);
    EXPECT_EQ(words.at(1).at("tag"), 56);
    EXPECT_EQ(words.at(2).at("tag"), 55);
}

TEST(TechnologyBox, WhoseTripTagTheDriveDoesNotHaveDoesNotKnowTheTrip)
{
    Gateway gateway{box("trip_tag = 999\n")};

    EXPECT_TRUE(eventually([&] {
        return gateway.dpctl({"show"}).out.find("trip unknown: tag 999 was never read") != std::string::npos;
    }));
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for diag ext 04000000")) << "what is not known is no trip";
    EXPECT_TRUE(gateway.json({"show"}).at("stations").at(0).at("tec").at("tripped").is_null());
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("trip unknown"));
}

class FunctionBlock : public ::testing::Test {
protected:
    explicit FunctionBlock(Wiring wiring = box()) : gateway{std::move(wiring)} {}

    Outcome set(const std::string& name, const std::string& value) const
    {
        return gateway.dpctl({"tec", "set", name, value});
    }

    Gateway gateway;
};

TEST_F(FunctionBlock, FollowsTheBusWithItsNetworkState)
{
    EXPECT_TRUE(becomes(gateway, kNetwork, kBaudSearch)) << "nothing was heard yet";
    Master master{gateway, for_box({"--tags", "55,56w"})};
    // Each FDL status is a sign of life for 2 s; to look takes longer than that on a loaded machine.
    const auto becomes_while_asked = [&](int state) {
        return eventually(
            [&] { return master.does("send 10 05 01 49 4F 16") && gateway.tec(kNetwork) == state; });
    };
    EXPECT_TRUE(becomes_while_asked(kWaitParam));
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(becomes(gateway, kNetwork, kDataExchange));
    EXPECT_EQ(gateway.tec(kFault), 0);
    EXPECT_EQ(gateway.tec("VERSION"), 0x0300);

    gateway.drive().send_line("nak 05C8");
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(becomes(gateway, kNetwork, kDataExError)) << "a write fails, data exchange goes on";
    EXPECT_TRUE(master.does("expect state data-exchange"));
    gateway.drive().send_line("ok");
    EXPECT_TRUE(becomes(gateway, kNetwork, kDataExchange));
    EXPECT_TRUE(gateway.daemon().says("NETWORK STATE is DATA EX ERROR"));
    EXPECT_TRUE(master.does("unlock"));
    EXPECT_TRUE(becomes_while_asked(kWaitParam));
    EXPECT_TRUE(becomes(gateway, kNetwork, kBaudSearch)) << "no station sends any more";
}

TEST_F(FunctionBlock, ShowsWithIntDiagSelectWhatTheMasterHasConfigured)
{
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 0x1234"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    for (const auto& [select, shown] : {std::pair{"100", 55},
                                        {"101", 56},
                                        {"102", 0},
                                        {"200", 1},
                                        {"201", 2},
                                        {"300", 0},
                                        {"400", 1250},
                                        {"501", 0x1234},
                                        {"29999", 0}}) {
        EXPECT_EQ(set("INT_DIAG_SELECT", select).status, 0);
        EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", shown)) << select;
    }
}

/// B-053: the drive says "read only" or "out of range" for everything; the column `when` of its table says
/// why.
TEST(FunctionBlockOfADriveThatRuns, ShowsAccessErrors3And4)
{
    Wiring wiring = box();
    wiring.table = "tag,name,type,decimals,min,max,access,when\n"
                   "4,Trip code,WORD,,0000,FFFF,ro,\n"
                   "55,Speed feedback,INT,2,-300.00,300.00,ro,\n"
                   "56,Speed setpoint,INT,2,-105.00,105.00,rw,\n"
                   "60,Base speed,INT,0,0,3000,rw,stopped\n"
                   "61,Control mode,INT,0,0,3,rw,configuration\n";
    Gateway gateway{wiring};
    Master master{gateway, for_box({"--tags", "55,56w,60w,61w"})};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("nak 05C8"); // it runs
    EXPECT_TRUE(master.does("out 1 = 100"));
    EXPECT_TRUE(master.does("out 2 = 1500"));
    EXPECT_TRUE(master.does("out 3 = 1"));
    for (const auto& [select, shown] : {std::pair{"300", 0}, {"301", 2}, {"302", 3}, {"303", 4}}) {
        EXPECT_EQ(gateway.dpctl({"tec", "set", "INT_DIAG_SELECT", select}).status, 0);
        EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", shown)) << select;
    }
    gateway.drive().send_line("nak 08C8");
    EXPECT_EQ(gateway.dpctl({"tec", "set", "INT_DIAG_SELECT", "302"}).status, 0);
    EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", 3));
    EXPECT_TRUE(master.does("out 2 = 4000"));
    EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", 1)) << "beyond the limits of the table it is what it says";
    gateway.drive().send_line("ok");
    EXPECT_TRUE(master.does("out 2 = 1500"));
    EXPECT_TRUE(gateway.drive().says("tag 60 written 1500"));
    EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", 0));
}

TEST_F(FunctionBlock, KeepsWhyTheLastStartUpWasRefusedUntilOneIsAccepted)
{
    {
        Master master{gateway, for_box({"--prm", "000000", "--cfg", "11"})};
        EXPECT_TRUE(master.does("try start 2s"));
        EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", 0x0023)) << "an identifier that is none";
    }
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(becomes(gateway, "INT DIAGNOSTIC", 0));
}

TEST_F(FunctionBlock, WithAnotherTypeIsSilentOnTheBusAndSaysSo)
{
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));

    EXPECT_EQ(set("TYPE", "3").status, 5) << "the station is in data exchange";
    const Outcome off = gateway.dpctl({"tec", "set", "TYPE", "3", "--yes"});
    EXPECT_EQ(off.status, 0);
    EXPECT_THAT(off.out, AllOf(HasSubstr("TYPE MISMATCH"), HasSubstr("set TYPE to 2")));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00")) << "the connection to the master is lost";
    EXPECT_TRUE(master.does("wait 60s for state not data-exchange"));
    EXPECT_EQ(gateway.tec(kFault), 2);
    EXPECT_EQ(gateway.tec(kNetwork), kDisabled);
    const std::string before = gateway.spoken_on_the_bus();
    EXPECT_TRUE(master.does("try start 1s"));
    EXPECT_EQ(gateway.spoken_on_the_bus(), before) << "not one octet";

    EXPECT_EQ(set("TYPE", "PROFIBUS DP").status, 0);
    EXPECT_TRUE(master.does("start 60s"));
    EXPECT_EQ(gateway.tec(kFault), 0);
}

TEST_F(FunctionBlock, TakesAValueThatNoOperatorStationWouldAndIsFaultyUntilItIsMended)
{
    EXPECT_THAT(set("RIDE THROUGH", "61").out,
                AllOf(HasSubstr("PARAMETER"), HasSubstr("RIDE THROUGH is out of range")));
    EXPECT_EQ(gateway.tec(kFault), 1);
    EXPECT_EQ(gateway.tec(kNetwork), kDisabled);
    EXPECT_THAT(set("RIDE THROUGH", "60").out, HasSubstr("could compromise safety"));
    EXPECT_TRUE(
        gateway.daemon().says("RIDE THROUGH is 60. Setting the RIDE THROUGH parameter to anything other"));
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("could compromise safety"));
    EXPECT_EQ(gateway.tec(kFault), 0);
    EXPECT_THAT(set("ride-through", "0").out, Not(HasSubstr("safety")));
    EXPECT_THAT(gateway.dpctl({"show"}).out, Not(HasSubstr("safety")));

    EXPECT_EQ(set("RIDE THROUGH", "70000").status, 5) << "no 16 bits";
    EXPECT_EQ(set("FAULT", "0").status, 5) << "an output";
    EXPECT_EQ(set("NO SUCH", "0").status, 5);
}

TEST_F(FunctionBlock, ChangesTheAddressWhileTheProgramRuns)
{
    {
        Master master{gateway, for_box({"--tags", "55,56w"})};
        ASSERT_TRUE(master.does("start 60s"));
        EXPECT_THAT(set("ADDRESS", "2").out, HasSubstr("usually reserved for PROFIBUS masters"));
        EXPECT_EQ(gateway.station().at("address"), 2) << "at once";
        EXPECT_TRUE(master.does("wait 60s for state not data-exchange"));
    }
    EXPECT_EQ(set("ADDRESS", "9").status, 0);
    Master master{gateway, for_box({"--tags", "55,56w"}), 9};
    EXPECT_TRUE(master.does("start 60s"));
    const Json info = gateway.json({"show"}).at("stations").at(0).at("info");
    EXPECT_EQ(info.at("address_active"), 9);
    EXPECT_EQ(info.at("address_pending"), 5) << "what the file brings with the next start";
    EXPECT_TRUE(gateway.exchange_ends_with(0, "9")) << "a station goes by the address that it has";
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("until the next start"));
}

TEST(FunctionBlocks, OfTwoStationsNeverHaveOneAddress)
{
    Wiring wiring = box();
    wiring.units = {"00", "01"};
    Gateway gateway{wiring};
    const Outcome taken = gateway.dpctl({"tec", "set", "ADDRESS", "6", "--station", "unwinder"});
    EXPECT_EQ(taken.status, 5);
    EXPECT_THAT(taken.err, HasSubstr("address 6 is that of station rewinder"));
    EXPECT_EQ(gateway.station(0).at("address"), 5);

    // They change places by way of a third address.
    for (const auto& [station, address] : {std::pair{"unwinder", "7"}, {"rewinder", "5"}, {"unwinder", "6"}})
        EXPECT_EQ(gateway.dpctl({"tec", "set", "ADDRESS", address, "--station", station}).status, 0);
    Master first{gateway, for_box({"--tags", "55,56w"}), 6};
    ASSERT_TRUE(first.does("start 60s"));
    EXPECT_TRUE(first.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("unit 00: tag 56 written 5.00"));
}

TEST(FunctionBlocks, AreNoneOfAnOptionBoard)
{
    Gateway gateway;
    EXPECT_EQ(gateway.dpctl({"show", "unwinder"}).status, 0);
    EXPECT_TRUE(gateway.json({"show", "unwinder"}).at("stations").at(0).at("tec").is_null());
    EXPECT_EQ(gateway.dpctl({"tec", "set", "TYPE", "2"}).status, 5);
}

/// What becomes of the outputs when the master is killed: the watchdog of the slave is 500 ms.
class RideThrough : public ::testing::Test {
protected:
    void lose_master_with(const std::string& seconds)
    {
        gateway.emplace(box("ride_through = " + seconds + "\n"));
        Master master{*gateway, for_box({"--tags", "55,56w,57w", "--watchdog", "500ms"})};
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(master.does("out 1 = 500"));
        ASSERT_TRUE(gateway->drive().says("tag 56 written 5.00"));
        ASSERT_TRUE(master.does("out 2 = 700"));
        ASSERT_TRUE(gateway->drive().says("tag 57 written 7.00"));
        gateway->drive().skip();
        master.end(SIGKILL);
        ASSERT_TRUE(gateway->daemon().says("the watchdog expired"));
        lost_at = std::chrono::steady_clock::now();
    }
    std::optional<Gateway> gateway;
    std::chrono::steady_clock::time_point lost_at;
};

TEST_F(RideThrough, Of1SecondZeroesTheOutputsThenAndNotBefore)
{
    lose_master_with("1");
    ASSERT_TRUE(gateway->drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(gateway->drive().says("tag 57 written 0.00"));
    // The two lines come by two pipes: a hundredth more or less is theirs.
    EXPECT_GE(std::chrono::steady_clock::now() - lost_at, std::chrono::milliseconds{900});
    EXPECT_TRUE(gateway->daemon().ever_said("could compromise safety"));
}

TEST_F(RideThrough, OfMinus1NeverZeroesTheOutputsNotEvenWhenTheProgramEnds)
{
    lose_master_with("-1");
    EXPECT_FALSE(gateway->drive().says("written", std::chrono::seconds{2}));
    EXPECT_EQ(gateway->daemon().end(), 0);
    EXPECT_EQ(gateway->drive().how_often("written"), 0U);
}

TEST_F(RideThrough, IsCutShortByTheEndOfTheProgram)
{
    lose_master_with("60");
    EXPECT_EQ(gateway->daemon().end(), 0);
    EXPECT_TRUE(gateway->drive().says("tag 56 written 0.00")) << "the daemon has ended";
    EXPECT_TRUE(gateway->drive().says("tag 57 written 0.00"));
}

TEST_F(RideThrough, IsChangedWhileTheProgramRuns)
{
    lose_master_with("-1");
    EXPECT_EQ(gateway->dpctl({"tec", "set", "RIDE_THROUGH", "0"}).status, 0);
    EXPECT_TRUE(gateway->drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(gateway->drive().says("tag 57 written 0.00"));
}

class BoxLamps : public ::testing::Test {
protected:
    BoxLamps()
        : gateway{[] {
              Wiring wiring = box("health = \"272.3\"\nrun = \"!272.4\"\n",
                                  "[station.leds]\nnetwork = \"led:network\"\nmodule = \"led:module\"\n"
                                  "health = \"led:health\"\nrun = \"led:run\"\n");
              wiring.started = false;
              return wiring;
          }()}
    {
        network = gateway.make_led("network");
        module = gateway.make_led("module");
        health = gateway.make_led("health");
        run = gateway.make_led("run");
        gateway.start_daemon();
    }
    static bool shows(const std::filesystem::path& lamp, const std::string& value)
    {
        return eventually([&] { return content(lamp) == value; });
    }
    std::string pattern(const char* lamp) const
    {
        const Json all = gateway.json({"show"});
        for (const Json& one : all.at("stations").at(0).at("leds").at("leds"))
            if (one.at("name") == lamp) return one.at("pattern");
        return "";
    }

    Gateway gateway;
    std::filesystem::path network, module, health, run;
};

TEST_F(BoxLamps, SayOnIsGoodAndOffIsBad)
{
    EXPECT_TRUE(shows(module, "1"));
    EXPECT_TRUE(shows(health, "1"));
    EXPECT_TRUE(shows(run, "1"));
    EXPECT_TRUE(eventually([&] { return pattern("network") == "off"; })) << "nothing was heard yet";
    Master master{gateway, for_box({"--tags", "55,56w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(eventually([&] { return pattern("network") == "on"; }));
    EXPECT_TRUE(shows(network, "1"));

    gateway.drive().send_line("set 272 0010");
    EXPECT_TRUE(shows(health, "0"));
    EXPECT_TRUE(shows(run, "0"));

    EXPECT_EQ(gateway.dpctl({"tec", "set", "TYPE", "1", "--yes"}).status, 0);
    EXPECT_TRUE(gateway.flashes(module)) << "wrong type";
    EXPECT_TRUE(eventually([&] { return pattern("network") == "off"; })) << "forced off by MODULE";
}

} // namespace
} // namespace dpslave::test
