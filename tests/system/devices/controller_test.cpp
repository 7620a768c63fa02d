// SPDX-License-Identifier: Apache-2.0
// The controllers 2408f and 2404f on Modbus RTU: both worked examples of the handbook's chapter 7, the status
// word in the diagnosis, the front panel, and the two resolutions.
// Only here: the shipped profile and table in a running daemon.
#include "system/gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

Wiring instrument(const std::string& keys = "")
{
    Wiring wiring;
    wiring.profile = "2408f";
    wiring.protocol = "modbus-rtu";
    wiring.units = {"1"};
    wiring.keys = "ident = 0x0A0B\n" + keys; // no source states the true one; any will do here
    return wiring;
}

Arguments for_controller(Arguments more)
{
    more.insert(more.begin(), {"--family", "controller", "--ident", "0x0A0B", "--master", "36"});
    return more;
}

/// The standard mapping of table 4-1.
const Arguments kStandard{"--tags", "1,5,3,75,24w,25w,15w,274w"};

TEST(Controller, ExchangesTheStandardMappingInScaledIntegers)
{
    Gateway gateway{instrument("display_decimals = 1\n")};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 1 999.9");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 9999"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5"));
    EXPECT_TRUE(master.does("wait 60s for in 2 = 605")) << "the working setpoint follows";
    EXPECT_TRUE(master.does("out 2 = 401"));
    EXPECT_TRUE(gateway.drive().says("tag 25 written 40.1"));
    EXPECT_TRUE(master.does("out 3 = 1"));
    EXPECT_TRUE(master.does("wait 60s for in 2 = 401")) << "setpoint 2 is selected";

    EXPECT_TRUE(gateway.word_becomes(15, "value", "1 (SP2)"));
    EXPECT_EQ(gateway.word(1).at("value"), "999.9");
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("run"));
    EXPECT_EQ(gateway.json({"show"}).at("stations").at(0).at("info").at("comms_status"), "run");
    EXPECT_TRUE(master.leaves());
}

///
TEST(Controller, IsHeldAtTheStartWhileItsResolutionIsAnother)
{
    Gateway gateway{instrument()};
    gateway.drive().send_line("set 12550 1");
    Master master{gateway, for_controller(kStandard)};
    EXPECT_TRUE(master.does("try start 3s"));
    EXPECT_TRUE(master.does("expect diag stat-diag"));
    EXPECT_THAT(
        gateway.dpctl({"diag"}).out,
        HasSubstr(
            "Data exchange does not start: the drive says 1 (Integer) in tag 12550 (Comms resolution), and "
            "the station says 0 (Full)"));
    EXPECT_THAT(gateway.dpctl({"doctor"}).out, HasSubstr("tag 12550"));
    EXPECT_EQ(gateway.word(1).at("raw"), 0);

    gateway.drive().send_line("set 12550 0");
    EXPECT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 1 12.3");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 123"));
}

TEST(Controller, InIntegerResolutionRoundsToWholeNumbersAndWritesThem)
{
    Gateway gateway{instrument("resolution = \"integer\"\n")};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 1 999.9");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1000"));
    gateway.drive().send_line("set 1 12.3");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 12"));
    EXPECT_TRUE(master.does("out 1 = 60"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.0"));
    EXPECT_TRUE(master.does("wait 60s for in 2 = 60"));
    EXPECT_EQ(gateway.json({"show"}).at("stations").at(0).at("info").at("resolution"), "integer");
    EXPECT_TRUE(master.does("demand read 24"));
    EXPECT_TRUE(master.does("expect demand = 60")) << "Demand Data has the same resolution";
}

/// what is no floating value - counts, times, what is now the one and now the other - is whole already.
TEST(Controller, InIntegerResolutionHasWholeNumbersAndTimesAsTheyAre)
{
    Gateway gateway{instrument("resolution = \"integer\"\n")};
    Master master{gateway, for_controller({"--tags", "1,3,8,22,24,36,8202,24w,8w"})};
    ASSERT_TRUE(master.does("start 60s"));
    for (const char* set : {"set 1 999.9", "set 3 62", "set 22 3", "set 36 90", "set 8202 55"})
        gateway.drive().send_line(set);
    EXPECT_TRUE(master.does("out 1 = 60"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.0"));
    EXPECT_TRUE(master.does("out 2 = 360"));
    EXPECT_TRUE(gateway.drive().says("tag 8 written 360"));
    for (const char* in : {"1 = 1000", "2 = 62", "3 = 360", "4 = 3", "5 = 60", "6 = 90", "7 = 55"})
        EXPECT_TRUE(master.does(std::string{"wait 60s for in "} + in));

    gateway.drive().send_line("set 273 1"); // the output power is written in manual, program 0 in hold
    gateway.drive().send_line("set 23 4");
    for (const char* one : {"3 50", "22 1", "36 120"}) {
        EXPECT_TRUE(master.does(std::string{"demand write "} + one));
        std::string said{one};
        EXPECT_TRUE(gateway.drive().says("tag " + said.replace(said.find(' '), 1, " written ")));
    }
    EXPECT_TRUE(master.does("demand write-ext 8202 7"));
    EXPECT_TRUE(gateway.drive().says("tag 8202 written 7"));
}

/// An output is read too, to be compared: a read that works does not end the report of a refused write.
TEST(Controller, ThatRefusesAWriteSaysSoOnceThoughTheReadsWork)
{
    Gateway gateway{instrument("display_decimals = 1\n")};
    Master master{gateway, for_controller({"--tags", "1,24w"})};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("refuse 3");
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(gateway.daemon().says("write of tag 24: exception 3"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("drive").at("refusals") >= 3; }));
    EXPECT_THAT(gateway.dpctl({"diag"}).out, HasSubstr("write of tag 24: exception 3"));
    EXPECT_EQ(gateway.daemon().how_often("write of tag 24: exception 3"), 0U) << "not a second time";
    gateway.drive().send_line("ok");
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5"));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("trouble").empty(); }));
}

/// Worked example 1, "Starting an Autotune", register by register.
class WorkedExample1 : public ::testing::Test {
protected:
    WorkedExample1() : gateway{instrument()}, master{gateway, for_controller(kStandard)} {}

    void start_tune()
    {
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(master.does("demand raw 0 0 0 0"));
        ASSERT_TRUE(master.does("wait 60s for demand reg 1 = 0"));
        ASSERT_TRUE(master.does("demand raw 8462 0 0 1")) << "write 1 to tag 270";
    }

    Gateway gateway;
    Master master;
};

TEST_F(WorkedExample1, PollsTheControlStatusWordUntilTheAutotuneIsComplete)
{
    gateway.drive().send_line("tune 3s");
    start_tune();
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 4366"));
    EXPECT_TRUE(gateway.drive().says("tag 270 written 1"));
    EXPECT_TRUE(master.does("demand raw 4172 0 0 0")) << "read tag 76";
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 4172"));
    EXPECT_TRUE(master.does("expect demand reg 4 & 0x1000 = 0x1000")) << "under way";
    EXPECT_TRUE(master.does("wait 60s for diag ext 030100")) << "tune active, in the diagnosis too";

    EXPECT_TRUE(master.does("wait 60s for demand reg 4 & 0x1000 = 0")) << "without another order";
    EXPECT_TRUE(master.does("expect demand reg 1 = 4172"));
    EXPECT_TRUE(master.does("expect demand reg 4 & 0x0008 = 0"));
    EXPECT_TRUE(master.does("wait 60s for diag ext 030000"));
    EXPECT_TRUE(master.leaves());
}

TEST_F(WorkedExample1, SeesBit3WhenTheSelfTuneHasFailed)
{
    gateway.drive().send_line("tune 1s fails");
    start_tune();
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 4366"));
    EXPECT_TRUE(master.does("demand raw 4172 0 0 0"));
    EXPECT_TRUE(master.does("wait 60s for demand reg 4 & 0x0008 = 0x0008"));
}

TEST_F(WorkedExample1, IsAnswered28942WithTheErrorCodeWhenTheWriteIsRefused)
{
    gateway.drive().send_line("refuse 3");
    start_tune();
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 28942"));
    EXPECT_TRUE(master.does("expect demand reg 4 = 2")) << "value out of range";
}

/// Worked example 2, "Uploading Program Data": tags 8328 to 8463, and back.
class WorkedExample2 : public ::testing::TestWithParam<const char*> {
protected:
    WorkedExample2()
        : gateway{instrument(fmt::format("[station.demand]\nextended_reply = \"{}\"\n", GetParam()))},
          master{gateway, for_controller(kStandard)}
    {}
    bool is_example() const { return std::string{GetParam()} == "example"; }

    Gateway gateway;
    Master master;
};

TEST_P(WorkedExample2, IsAnsweredAsTheSiteHasChosen)
{
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.does("demand raw 0 0 0 0"));
    ASSERT_TRUE(master.does("wait 60s for demand reg 1 = 0"));
    ASSERT_TRUE(master.does("demand raw 12288 8328 0 0"));
    EXPECT_TRUE(master.does(fmt::format("wait 60s for demand reg 1 = {}", is_example() ? 12288 : 4096)));
    EXPECT_TRUE(master.does("expect demand reg 2 = 8328"));
    EXPECT_TRUE(master.does("expect demand reg 4 = 3")) << "the holdback type of program 1: band";

    gateway.drive().send_line("exception 2");
    EXPECT_TRUE(master.does(fmt::format("wait 60s for demand reg 1 = {}", is_example() ? 37000 : 28672)));
    EXPECT_TRUE(master.does("expect demand reg 4 = 0"));
}

TEST_P(WorkedExample2, UploadsProgram1AndDownloadsItAgain)
{
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(master.does("demand upload 8328 136"));
    gateway.drive().send_line("set 8329 7");
    gateway.drive().send_line("set 8337 55");
    ASSERT_TRUE(master.does("demand read-ext 8337"));
    EXPECT_TRUE(master.does("expect demand = 55"));

    ASSERT_TRUE(master.does("demand download 8328"));
    gateway.drive().send_line("get 8329");
    EXPECT_TRUE(gateway.drive().says("tag 8329 = 5")) << "as it was before";
    gateway.drive().send_line("get 8337");
    EXPECT_TRUE(gateway.drive().says("tag 8337 = 100"));
    EXPECT_TRUE(master.leaves());
}
INSTANTIATE_TEST_SUITE_P(WithReplies, WorkedExample2, ::testing::Values("table", "example"),
                         [](const auto& one) { return "OfThe_" + std::string{one.param}; });

TEST(ExtendedDemandData, RefusesProgram2OfAnInstrumentWithOneAndATagThatIsNone)
{
    Gateway gateway{instrument()};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("demand read-ext 8464")) << "program 2";
    EXPECT_TRUE(master.does("expect demand reject 0"));
    EXPECT_TRUE(master.does("demand raw 0"));
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 0"));
    EXPECT_TRUE(master.does("demand raw 12288 16384 0 0"));
    EXPECT_TRUE(master.does("wait 60s for demand reg 1 = 28672"));
    EXPECT_TRUE(master.does("expect demand reg 4 = 0"));
}

TEST(ExtendedDemandData, WritesProgram0InHoldOnlyAndReadsItAlways)
{
    Gateway gateway{instrument()};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("demand write-ext 8196 7"));
    EXPECT_TRUE(master.does("expect demand reject 2")) << "the instrument's refusal is reported";
    EXPECT_TRUE(master.does("demand read-ext 8196"));
    gateway.drive().send_line("set 23 4");
    EXPECT_TRUE(master.does("demand write-ext 8196 7"));
    EXPECT_TRUE(master.does("expect demand = 7"));
    EXPECT_TRUE(gateway.drive().says("tag 8196 written 7"));
}

TEST(StatusWord, IsTheDiagnosisOfTheHandbooksExampleAndEachChangeAnEvent)
{
    Gateway gateway{instrument()};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for diag 000C00240A0B030000")) << "always sent";
    gateway.drive().send_line("set 75 4030");
    EXPECT_TRUE(master.does("wait 60s for diag 000C00240A0B034030"));
    EXPECT_TRUE(eventually([&] { return gateway.diagnosis().at("hex") == "00 0C 00 24 0A 0B 03 40 30"; }));
    EXPECT_THAT(gateway.dpctl({"diag"}).out, HasSubstr("Sensor break"));
    EXPECT_TRUE(gateway.daemon().says("the instrument reports >4030"));
    gateway.drive().send_line("set 75 0000");
    EXPECT_TRUE(master.does("wait 60s for diag ext 030000"));
    EXPECT_TRUE(master.does("expect state data-exchange"));
}

TEST(StatusWord, OfAFaultSetsExtDiagWhereConfigured)
{
    Gateway gateway{instrument("ext_diag_bit = true\n")};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 75 0020");
    EXPECT_TRUE(master.does("wait 60s for diag 080C00240A0B030020"));
    gateway.drive().send_line("set 75 0010");
    EXPECT_TRUE(master.does("wait 60s for diag 000C00240A0B030010")) << "manual operation is no fault";
}

TEST(FrontPanel, IsOverriddenWhileDataIsExchanged)
{
    Gateway gateway{instrument("display_decimals = 1\n")};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5"));
    EXPECT_TRUE(master.does("wait 60s for in 2 = 605"));

    gateway.drive().skip();
    gateway.drive().send_line("panel 24 70.0");
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5")) << "the output of the master stands";
    EXPECT_TRUE(master.does("wait 60s for in 2 = 605"));
    EXPECT_FALSE(gateway.drive().says("tag 24 written", std::chrono::seconds{1}))
        << "what stands is not written again and again";
}

TEST(FrontPanel, RegainsControlWhenTheNetworkFails)
{
    Gateway gateway{instrument("display_decimals = 1\n")};
    Master master{gateway, for_controller({"--tags", "5,24w", "--watchdog", "500ms"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 605"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 60.5"));
    master.end(SIGKILL);
    EXPECT_TRUE(gateway.daemon().says("the watchdog expired"));

    gateway.drive().skip();
    gateway.drive().send_line("panel 24 70.0");
    EXPECT_FALSE(gateway.drive().says("tag 24 written 60.5", std::chrono::seconds{1}));
    gateway.drive().send_line("get 24");
    EXPECT_TRUE(gateway.drive().says("tag 24 = 70.0"));
    EXPECT_EQ(gateway.drive().how_often("tag 24 written 0"), 0U) << "nothing is zeroed";
}

TEST(FrontPanel, IsNotAskedForTheInstrumentMode)
{
    Gateway gateway{instrument()};
    Master master{gateway, for_controller({"--tags", "1,199w"})};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 2"));
    EXPECT_TRUE(gateway.word_becomes(199, "state", "read_only"));
    EXPECT_TRUE(master.does("demand write 199 2"));
    EXPECT_TRUE(master.does("expect demand reject 1"));
    EXPECT_EQ(gateway.dpctl({"write", "199", "2"}).status, 5);
    EXPECT_FALSE(gateway.drive().ever_said("tag 199 written"));
}

TEST(Rem, FlashesWhileDataIsExchanged)
{
    Wiring wiring = instrument("[station.leds]\nrem = \"led:rem\"\n");
    wiring.started = false;
    Gateway gateway{wiring};
    const auto rem = gateway.make_led("rem");
    gateway.start_daemon();
    EXPECT_EQ(gateway.json({"show"}).at("stations").at(0).at("info").at("comms_status"), "rdY");
    EXPECT_EQ(content(rem), "0");
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(gateway.flashes(rem));
    EXPECT_TRUE(master.does("unlock"));
    EXPECT_TRUE(eventually(
        [&] { return gateway.json({"show"}).at("stations").at(0).at("info").at("comms_status") == "rdY"; }));
}

TEST(Controller, RefusesSyncAndFreeze)
{
    Gateway gateway{instrument()};
    Master master{gateway, for_controller(kStandard)};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("sync"));
    EXPECT_TRUE(master.does("freeze"));
    EXPECT_TRUE(master.does("out 1 = 505"));
    EXPECT_TRUE(gateway.drive().says("tag 24 written 50.5")) << "no Sync holds it back";
    const Json station = gateway.station();
    EXPECT_EQ(station.at("sync"), false);
    EXPECT_EQ(station.at("freeze"), false);
}

} // namespace
} // namespace dpslave::test
