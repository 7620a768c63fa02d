// SPDX-License-Identifier: Apache-2.0
// The line, and the pictures of doctor.
#include "control/lines.hpp"
#include "doctor_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// ---------------------------------------------------------------- the line

struct Line {
    const char* name;
    std::int64_t baud;
    int cable_a;
    std::optional<int> cable_b;
};
class DoctorLine : public testing::TestWithParam<Line> {};

TEST_P(DoctorLine, LengthIsLimitedByTheRate)
{
    const auto limit = line_limit({.baud = GetParam().baud, .baud_state = "DP_Control"});

    ASSERT_TRUE(limit);
    EXPECT_EQ(limit->cable_a, GetParam().cable_a);
    EXPECT_EQ(limit->cable_b, GetParam().cable_b);
}

INSTANTIATE_TEST_SUITE_P(B022, DoctorLine,
                         testing::Values(Line{"k9_6", 9600, 1200, 1200}, Line{"k19_2", 19200, 1200, 1200},
                                         Line{"k93_75", 93750, 1200, 1200}, Line{"k187_5", 187500, 1000, 600},
                                         Line{"k500", 500000, 400, 200},
                                         Line{"M1_5", 1500000, 200, std::nullopt}),
                         [](const auto& row) { return row.param.name; });

TEST(DoctorLines, AreNotLimitedWhileTheRateIsSearched)
{
    EXPECT_FALSE(line_limit({.baud = 9600, .baud_state = "Baud_Search"}));
}

// ---------------------------------------------------------------- pictures

TEST_F(Doctor, PrintsStationsCausesAndTheLine)
{
    station().drive.link = "silent";

    EXPECT_EQ(render_doctor(replies, diagnose(replies, ""), earlier_troubles(replies, ""), "", false),
              test::lines(R"(
/dev/ttyS1, 187.5 kbit/s (DP_Control), last telegram 2 ms ago

STATION   ADDRESS  STATE      DRIVE   LAMPS
unwinder        5  Data_Exch  silent  red off, green flashing 2 Hz: data
                                      exchange with the master

1. The drive no longer answers: power, cable, or changed settings of its port
   (dpslaved)
   unwinder: ei-ascii unit 00 on p3: /dev/ttyS2 at 9.6 kbit/s, 7E1, direction
             none; it does not answer
   - Check the power of the drive, and the cable between gateway and drive.
   - Compare the port of the drive with the configuration: protocol, rate, unit.
   - Ask the drive now: dpctl read TAG

the manual's list: Internal communications fault (HA389815 chapter 9)
   unwinder: unit 00 on p3 (/dev/ttyS2, ei-ascii) does not answer: 3 requests
             unanswered
   - Check that PROTOCOL of the drive is what the gateway's port needs (for the
     board itself: OPTION).
   - Check that the address is 0 to 125 (620: 1 to 125).
   - 620: check the connections between the PROFIBUS side and the drive. Check
     P3 MODE (or P1 MODE) and the baud rate.
   - Check port, baud, format and unit of the line in the configuration against
     the drive's settings.

line length of a segment at 187.5 kbit/s: cable A 1000 m, cable B 600 m
termination: at both ends of the segment and nowhere else, 390 ohm to +5 V, 220
ohm between B and A, 390 ohm to 0 V
)"));
}

TEST_F(Doctor, DoesNotRepeatTheFirstCauseInTheManualsList)
{
    station().state = "Wait_Prm";
    never_heard_anything();

    const std::string said =
        render_doctor(replies, diagnose(replies, ""), earlier_troubles(replies, ""), "", Look{false, 200});
    EXPECT_THAT(said, HasSubstr("\nthe manual's list: External communications fault (HA389815 chapter 9)\n"
                                "   - Check the terminal connections"));
    EXPECT_EQ(said.find("not one octet"), said.rfind("not one octet")) << said;
}

TEST_F(Doctor, SaysThatAllIsWell)
{
    EXPECT_THAT(render_doctor(replies, diagnose(replies, ""), earlier_troubles(replies, ""), "", false),
                HasSubstr("\n\nall is well\n\nline length"));
}

TEST_F(Doctor, PrintsTheWholeLineTableWhileTheRateIsSearched)
{
    bus().baud_state = "Baud_Search";

    EXPECT_THAT(render_doctor(replies, diagnose(replies, ""), earlier_troubles(replies, ""), "", false),
                HasSubstr(test::lines(R"(
line length of a segment at most:
          RATE  CABLE A           CABLE B
    9.6 kbit/s   1200 m            1200 m
   19.2 kbit/s   1200 m            1200 m
)")));
}

TEST_F(Doctor, AsksOnlyForTheStationThatIsMeant)
{
    replies.status = report::read<report::GetStatusReply>(fixture("GetStatus"));
    replies.status.stations[0].left_count = 0;
    EXPECT_THAT(diagnose(replies, "unwinder"), IsEmpty());
    EXPECT_EQ(diagnose(replies, "16").size(), 3u); // the drive, and the lists for its lamps
}

TEST_F(Doctor, GivesTheSameAsJson)
{
    station().state = "Power_On";

    EXPECT_EQ(doctor_json(replies, diagnose(replies, ""), {}),
              Json::parse(R"({"findings":[{"station":"unwinder",
        "rule":"board.dark","condition":"red off, green off","cause":"No power or major fault",
        "evidence":"the station is in Power_On: it is not served",
        "steps":["Check the power of the gateway and of its transceiver.",
                 "Run systemctl status dpslaved. Find out why the station is not served: journalctl -u dpslaved"],
        "source":"HA389815 chapter 9"}],"notes":[],"earlier":[],"line":{"baud":187500,"cable_a_m":1000,"cable_b_m":600}})"));
}

TEST(DoctorRules, AreAllPrintedWithConditionCauseAndSteps)
{
    const std::string all = render_rules(Look{false, 300});
    const Json json = rules_json();

    ASSERT_EQ(json["rules"].size(), rules().size());
    for (const Rule& rule : rules()) {
        EXPECT_THAT(all, HasSubstr(std::string{rule.condition} + "\n   " + std::string{rule.cause}));
        EXPECT_FALSE(rule.steps.empty()) << rule.name;
        for (const std::string_view step : steps_of(rule)) EXPECT_THAT(all, HasSubstr(std::string{step}));
    }
    EXPECT_THAT(all, HasSubstr("   1.5 Mbit/s    200 m  not at this rate\n"));
    EXPECT_EQ(json["lines"].size(), 7u);
}

TEST_F(Doctor, SurvivesRepliesOfAnotherVersion)
{
    const Json reply =
        Json::parse(R"({"bus":7,"stations":[null,"x",{"name":5,"drive":[],"rows":[1],"trouble":[1]}],
                        "groups":[{"name":"bus","counters":[3,{"name":1}]}],"uptime_ms":"x"})");
    Replies odd;
    const auto take = [&](auto&... each) { (report::take(reply, each), ...); };
    take(odd.status, odd.info, odd.diagnosis, odd.counters, odd.leds, odd.tec, odd.io);
    EXPECT_NO_THROW(render_doctor(odd, diagnose(odd, ""), earlier_troubles(odd, ""), "", true));
    EXPECT_NO_THROW(diagnose(Replies{}, "x"));
}

} // namespace
} // namespace dpslave::dpctl
