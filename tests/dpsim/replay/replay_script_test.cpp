// SPDX-License-Identifier: Apache-2.0
#include "capture.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

std::string why(const pcapng::Capture& capture)
{
    const auto made = script_of(capture);
    return made ? std::string{} : made.error();
}

TEST(ReplayScript, ATelegramHasTheAnswerBehindItAndItsPacketNumbers)
{
    const auto made = script({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(2, kOperate),
                              bus_in(3, kDiagRequest), bus_out(4, kDiagReady)});

    ASSERT_EQ(made.steps.size(), 3U);
    EXPECT_EQ(made.steps[0].answer, wire(kFdlStatusOk));
    EXPECT_EQ(made.steps[0].packet, 1U);
    EXPECT_EQ(made.steps[0].answer_packet, 2U);
    EXPECT_EQ(made.steps[1].octets, wire(kOperate));
    EXPECT_FALSE(made.steps[1].answer);
    EXPECT_EQ(made.steps[2].answer_packet, 5U);
}

TEST(ReplayScript, APauseRunsFromThePacketOfTheBusBefore)
{
    const auto made = script({drive_out(0, "04"), bus_in(10, kFdlStatus), bus_out(14, kFdlStatusOk),
                              drive_in(15, "06"), bus_in(20, kDiagRequest), bus_out(21, kDiagReady)});

    ASSERT_EQ(made.steps.size(), 2U);
    EXPECT_EQ(made.steps[0].at, 10ms);
    EXPECT_EQ(made.steps[0].pause, 0ms);
    EXPECT_EQ(made.steps[1].at, 20ms);
    EXPECT_EQ(made.steps[1].pause, 6ms);
}

/// A capture of a gateway with two drive lines, "drive p3" and "drive p4".
pcapng::Capture of_two_lines()
{
    auto packets =
        std::vector{bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), drive_out(2, "04"), drive_out(3, "15")};
    packets[3].interface = 2;
    auto capture = capture_of(std::move(packets), 148);
    capture.interfaces.at(1).name = "drive p3";
    capture.interfaces.push_back({.link_type = 149, .name = "drive p4", .description = {}});
    return capture;
}

TEST(ReplayScript, HasTheFramesOfTheDriveLineThatIsNamed)
{
    for (const char* name : {"p4", "drive p4"}) {
        const auto made = script_of(of_two_lines(), name);
        ASSERT_TRUE(made);
        ASSERT_EQ(made->drive.size(), 1U);
        EXPECT_EQ(made->drive[0].octets, wire("15"));
        EXPECT_TRUE(made->is_modbus);
    }
    EXPECT_TRUE(script_of(of_two_lines(), "p5")->drive.empty());
}

TEST(ReplayScript, OfSeveralDriveLinesTakesTheFirstAndNamesAll)
{
    const auto made = script_of(of_two_lines());

    ASSERT_TRUE(made);
    ASSERT_EQ(made->drive.size(), 1U);
    EXPECT_EQ(made->drive[0].octets, wire("04"));
    EXPECT_FALSE(made->is_modbus);
    EXPECT_THAT(made->drive_lines, testing::ElementsAre("drive p3", "drive p4"));
}

TEST(ReplayScript, OddTimesMakeNoLongPauses)
{
    auto packets = std::vector{bus_in(100, kFdlStatus), bus_out(50, kFdlStatusOk), bus_in(60, kDiagRequest),
                               bus_in(0, kOperate)};
    packets[3].unix_ns = std::numeric_limits<std::int64_t>::max();
    packets.push_back(bus_in(0, kOperate));
    packets[4].unix_ns = std::numeric_limits<std::int64_t>::min();

    const auto made = script(packets);

    ASSERT_EQ(made.steps.size(), 4U);
    EXPECT_EQ(made.steps[1].pause, 10ms) << "the packet before went back";
    EXPECT_EQ(made.steps[2].pause, 1h);
    EXPECT_EQ(made.steps[3].pause, 0ms);
}

TEST(ReplayScript, TheTimesOfACaptureEndAfterAYear)
{
    constexpr std::int64_t kHourMs = 3'600'000, kHours = 24 * 365 + 2;
    std::vector<pcapng::Packet> packets{bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk)};
    for (std::int64_t hour = 1; hour <= kHours; ++hour) packets.push_back(bus_in(hour * kHourMs, kOperate));

    const auto made = script(std::move(packets));

    EXPECT_EQ(made.steps.back().at, std::chrono::hours{24 * 365});
    EXPECT_EQ(made.steps.back().pause, 0ms);
}

TEST(ReplayScript, AnAnswerWithoutItsRequestAndAPacketWithoutOctetsAreLeftOut)
{
    const auto made =
        script({bus_out(0, kFdlStatusOk), bus_in(1, kFdlStatus), bus_out(2, kFdlStatusOk), bus_in(3, "")});

    ASSERT_EQ(made.steps.size(), 1U);
    EXPECT_EQ(made.steps[0].packet, 2U);
}

TEST(ReplayScript, OfATelegramThatTheCaptureBeginsInTheMiddleOfNothingIsSentOrExpected)
{
    const auto made = script({bus_in(0, "05 02 49 50 16"), bus_out(1, kFdlStatusOk), bus_in(2, kDiagRequest),
                              bus_out(3, kDiagReady)});

    ASSERT_EQ(made.steps.size(), 1U);
    EXPECT_EQ(made.steps[0].packet, 3U);
    EXPECT_EQ(made.steps[0].answer, wire(kDiagReady));
}

TEST(ReplayScript, WhatDpctlCallsCutIsNotSent)
{
    auto cut = bus_in(2, "3C 3E EE 16");
    cut.comments = {"cut: the rest of this telegram was not recorded"};

    const auto made = script({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), cut, bus_out(3, kDiagReady)});

    ASSERT_EQ(made.steps.size(), 1U);
    EXPECT_EQ(made.steps[0].answer, wire(kFdlStatusOk));
}

TEST(ReplayScript, OfARequestThatIsNotWholeNoAnswerIsExpected)
{
    const auto made = script(
        {bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(2, "3C 3E EE 16"), bus_out(3, kDiagReady)});

    ASSERT_EQ(made.steps.size(), 2U);
    EXPECT_FALSE(made.steps[1].answer);
}

TEST(ReplayScript, KnowsTheFramesOfTheDriveLineByTheirLinkType)
{
    for (const std::uint16_t link : {kEiAsciiLink, kModbusLink}) {
        const auto made = script(
            {bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), drive_out(2, "04 30"), drive_in(3, "06")},
            link);

        ASSERT_EQ(made.drive.size(), 2U);
        EXPECT_TRUE(made.drive[0].to_drive);
        EXPECT_FALSE(made.drive[1].to_drive);
        EXPECT_EQ(made.drive[1].at, 3ms);
        EXPECT_EQ(made.is_modbus, link == 149);
    }
}

TEST(ReplayScript, SaysWhatACaptureLacks)
{
    EXPECT_THAT(why(capture_of({drive_out(0, "04")})), HasSubstr("no packets of PROFIBUS"));
    EXPECT_THAT(why(capture_of({bus_in(0, kFdlStatus)})),
                HasSubstr("no packet of the bus is marked as sent"));
    EXPECT_THAT(why(capture_of({bus_out(0, kFdlStatusOk)})), HasSubstr("no telegram that the gateway heard"));
    auto two = capture_of({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), drive_out(2, "04")}, kBusLink);
    EXPECT_THAT(why(two), HasSubstr("two buses"));
}

} // namespace
} // namespace dpslave::sim
