// SPDX-License-Identifier: Apache-2.0
// Tests what the gateway is for: a master reads and writes parameters of a drive by their tags.
// Only here: all libraries and threads of the daemon between a tty and a tty.
#include "gateway.hpp"

namespace dpslave::test {
namespace {

/// What dpsim master says when the slave does what a slave must not do.
constexpr const char* kViolation = "not as the standard has it";

TEST(Exchange, ValuesGoFromTheDriveToTheMasterAndFromTheMasterToTheDrive)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w,288"}};

    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    gateway.drive().send_line("set 55 -0.01");
    EXPECT_TRUE(master.does("wait 60s for in 1 = -1"));
    EXPECT_TRUE(master.does("expect in 2 = 0x1C00"));

    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(master.does("out 1 = -10500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written -105.00"));

    EXPECT_TRUE(eventually([&] { return gateway.word(56).at("raw") == 0x10000 - 10500; }));
    const Json input = gateway.word(55), output = gateway.word(56);
    EXPECT_EQ(input.at("direction"), "in");
    EXPECT_EQ(input.at("octet"), 8) << "behind the eight octets of Demand Data";
    EXPECT_EQ(input.at("raw"), 0xFFFF);
    EXPECT_EQ(input.at("value"), "-0.01");
    EXPECT_EQ(input.at("state"), "good");
    EXPECT_EQ(output.at("direction"), "out");
    EXPECT_EQ(output.at("octet"), 8);
    EXPECT_EQ(output.at("raw"), 0x10000 - 10500);
    EXPECT_EQ(output.at("value"), "-105.00");
    EXPECT_TRUE(master.leaves());
    EXPECT_FALSE(master.ever_said(kViolation));
}

TEST(Exchange, TwelveParametersWithoutDemandDataStartAtTheFirstOctet)
{
    Gateway gateway;
    Master master{gateway,
                  {"--tags", "90,56w,57,62w,61,70w,91,71w,288,80w,140,81w", "--cfg",
                   "50 60 50 60 50 60 50 60 50 60 50 60"}};

    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 90 1480");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1480"));
    EXPECT_TRUE(master.does("wait 60s for in 4 = 40000"));
    EXPECT_TRUE(master.does("wait 60s for in 6 = 850"));
    EXPECT_TRUE(master.does("out 6 = 1234"));
    EXPECT_TRUE(gateway.drive().says("tag 81 written 1.234"));
    EXPECT_TRUE(eventually([&] { return gateway.word(81).is_object(); }));
    EXPECT_EQ(gateway.word(90).at("octet"), 0);
    EXPECT_EQ(gateway.word(81).at("octet"), 10);
    EXPECT_TRUE(master.does("get-cfg"));
    EXPECT_TRUE(
        master.does("expect reply 68 11 11 68 82 85 08 3E 3B 50 60 50 60 50 60 50 60 50 60 50 60 A8 16"));
}

TEST(Exchange, WaitsForADriveThatIsSlow)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    gateway.drive().send_line("slow 50ms");
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_EQ(gateway.station().at("drive").at("losses"), 0);
}

TEST(Exchange, WritesATagWhoseWritesCountOnceForEachChange)
{
    const std::string table = "tag,name,type,decimals,once,start\n55,Speed,INT,2,,0\n"
                              "56,Setpoint,INT,2,,0\n62,Save,WORD,,yes,0000\n";
    Gateway gateway{{.output_refresh_s = "0", .table = table}};
    Master master{gateway, {"--tags", "55,56w,62w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 2 = 1"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written >0001"));
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(gateway.drive().says("tag 56 written")) << "in each round";
    EXPECT_TRUE(master.does("out 2 = 2"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written >0002"));
    EXPECT_EQ(gateway.drive().how_often("tag 62 written >0001"), 0U);
}

class EachProfile : public ::testing::TestWithParam<const char*> {};

TEST_P(EachProfile, ExchangesWithItsDrive)
{
    Gateway gateway{{.profile = GetParam()}};
    Master master{gateway, {"--tags", "55,56w"}};

    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 100.00");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 10000"));
    EXPECT_TRUE(master.does("out 1 = 2500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 25.00"));
    EXPECT_TRUE(master.does("demand read 62"));
    EXPECT_TRUE(master.does("expect demand = 1100"));
}
INSTANTIATE_TEST_SUITE_P(OfTheOptionBoard, EachProfile, ::testing::Values("584s", "620"),
                         [](const auto& one) { return "Profile" + std::string{one.param}; });

class EachRate : public ::testing::TestWithParam<unsigned> {};

TEST_P(EachRate, ExchangesWithinTheTimesOfTheGsdSd3TelegramsIncluded)
{
    // A master on a loaded machine: it repeats what came too late, and the slave must never speak late.
    Gateway gateway{{.bus_baud = GetParam(), .max_tsdr = 0}};
    const Arguments patience{"--retries", "15", "--slot", "100ms"};
    const auto with = [&](Arguments more) {
        more.insert(more.end(), patience.begin(), patience.end());
        return more;
    };
    Master variable{gateway, with({"--tags", "55,56w"})};
    ASSERT_TRUE(variable.does("start 60s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(variable.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(variable.does("out 1 = -300"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written -3.00"));
    EXPECT_TRUE(variable.does("unlock"));
    EXPECT_TRUE(variable.leaves());
    EXPECT_FALSE(variable.ever_said(kViolation));

    Master fixed{gateway, with({"--cfg", "73", "--sd3"})};
    ASSERT_TRUE(fixed.does("start 60s"));
    EXPECT_TRUE(fixed.does("demand read 55"));
    EXPECT_TRUE(fixed.does("expect demand = 1250"));
    EXPECT_TRUE(fixed.leaves());
    EXPECT_FALSE(fixed.ever_said(kViolation));
}
INSTANTIATE_TEST_SUITE_P(OfTheGsd, EachRate,
                         ::testing::Values(9600U, 19'200U, 93'750U, 187'500U, 500'000U, 1'500'000U),
                         [](const auto& one) { return "At" + std::to_string(one.param); });

TEST(MinTsdr, AsLongAsItCanBeDoesNotSilenceTheSlave)
{
    Gateway gateway{{.max_tsdr = 0}};
    Master master{gateway, {"--tags", "55,56w", "--min-tsdr", "255", "--retries", "15"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("min_tsdr") == 255; }));
}

TEST(DemandData, ReadsWritesAndSaysWithZeroOneAndTwoWhyNot)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));

    EXPECT_TRUE(master.does("demand read 62"));
    EXPECT_TRUE(master.does("expect demand = 1100"));
    EXPECT_TRUE(master.does("demand write 62 955"));
    EXPECT_TRUE(master.does("expect demand = 955"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written 95.5"));

    EXPECT_TRUE(master.does("demand read 1999"));
    EXPECT_TRUE(master.does("expect demand reject 0")) << "no such tag";
    EXPECT_TRUE(master.does("demand write 55 100"));
    EXPECT_TRUE(master.does("expect demand reject 1")) << "read only";
    EXPECT_TRUE(master.does("demand write 62 2001"));
    EXPECT_TRUE(master.does("expect demand reject 2")) << "out of range";
    EXPECT_TRUE(master.does("demand none"));
    EXPECT_TRUE(master.does("expect demand none"));

    gateway.drive().send_line("get 62");
    EXPECT_TRUE(gateway.drive().says("tag 62 = 95.5"));
}

TEST(DemandData, AStandingReadIsRefreshedAndAStandingWriteIsMadeOnce)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));

    EXPECT_TRUE(master.does("demand read 61"));
    gateway.drive().send_line("set 61 77.7");
    EXPECT_TRUE(master.does("wait 60s for demand = 777"));

    EXPECT_TRUE(master.does("demand write 62 955"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written 95.5"));
    const auto then = gateway.cycles();
    EXPECT_TRUE(eventually([&] { return gateway.cycles() > then + 50; }));
    EXPECT_EQ(gateway.drive().how_often("tag 62 written"), 0U) << "though the order stood for 50 cycles";
}

TEST(GlobalControl, SyncHoldsTheOutputsUntilTheNextSyncOrUnsync)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    const auto cycles_pass = [&] {
        const auto then = gateway.cycles();
        return eventually([&] { return gateway.cycles() > then + 3; });
    };

    EXPECT_TRUE(master.does("sync 0x02"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag not sync")) << "that was another group";
    EXPECT_TRUE(master.does("sync 0x01"));
    EXPECT_TRUE(gateway.daemon().says("unwinder: Sync"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag sync"));
    EXPECT_TRUE(master.does("out 1 = 600"));
    EXPECT_TRUE(cycles_pass());
    EXPECT_TRUE(eventually([&] { // a drive that has no time answers too late
        return gateway.dpctl({"read", "56"}).out.find("is 5.00") != std::string::npos;
    })) << "what the drive has";
    EXPECT_EQ(gateway.word(56).at("raw"), 500);

    EXPECT_TRUE(master.does("sync"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 6.00"));
    EXPECT_TRUE(master.does("out 1 = 700"));
    EXPECT_TRUE(cycles_pass());
    EXPECT_EQ(gateway.word(56).at("raw"), 600);
    EXPECT_TRUE(master.does("unsync"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 7.00"));
    EXPECT_TRUE(master.does("out 1 = 800"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 8.00"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag not sync"));
}

TEST(GlobalControl, FreezeHoldsTheInputsUntilTheNextFreezeOrUnfreeze)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("set 55 10.00");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1000"));
    // Read by hand again and again: after each of them comes a cyclic transaction, and there are two in a
    // round.
    const auto gateway_knows = [&](const std::string& value) {
        for (int i = 0; i < 4; ++i)
            if (gateway.dpctl({"read", "55"}).out.find("is " + value) == std::string::npos) return false;
        return true;
    };

    EXPECT_TRUE(master.does("freeze 0x02"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag not freeze")) << "that was another group";
    EXPECT_TRUE(master.does("freeze"));
    EXPECT_TRUE(master.does("diag"));
    EXPECT_TRUE(master.does("expect diag freeze"));
    gateway.drive().send_line("set 55 20.00");
    EXPECT_TRUE(eventually([&] { return gateway_knows("20.00"); }));
    EXPECT_TRUE(master.does("expect in 1 = 1000"));

    EXPECT_TRUE(master.does("freeze"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 2000"));
    gateway.drive().send_line("set 55 30.00");
    EXPECT_TRUE(eventually([&] { return gateway_knows("30.00"); }));
    EXPECT_TRUE(master.does("expect in 1 = 2000"));
    EXPECT_TRUE(master.does("unfreeze"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 3000"));
    gateway.drive().send_line("set 55 40.00");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 4000"));
}

TEST(GlobalControl, ClearPutsZeroIntoTheDriveAndOperateTheOutputsAgain)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));

    EXPECT_TRUE(master.does("clear"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00"));
    EXPECT_TRUE(gateway.daemon().says("unwinder: Clear_Data, outputs are zero"));
    EXPECT_TRUE(master.does("expect state data-exchange"));
    EXPECT_TRUE(master.does("operate"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
}

} // namespace
} // namespace dpslave::test
