// SPDX-License-Identifier: Apache-2.0
#include "capture.hpp"
#include "dpsim/replay/drive_answers.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

// EI-ASCII reference, section 1: read and write of unit 01.
const std::string kReadPv = "04 30 30 31 31 50 56 05", kPv164 = "02 50 56 31 36 2E 34 03 18";
const std::string kPv230 = "02 50 56 32 33 2E 30 03 1A";
const std::string kWriteSl220 = "04 30 30 31 31 02 53 4C 32 32 2E 30 03 02";

ReplayScript ei_ascii()
{
    return script({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), drive_out(2, kReadPv),
                   drive_in(3, kPv164), drive_out(4, kWriteSl220), drive_in(5, "06"), drive_out(6, kReadPv),
                   drive_in(7, kPv230)});
}

TEST(DriveAnswers, AReadHasTheNewestAnswerUntilThisPlaceOfTheCapture)
{
    DriveAnswers drive{ei_ascii()};

    EXPECT_EQ(drive.on_bytes(wire(kReadPv), 0ms), wire(kPv164)) << "before the first one that";
    EXPECT_EQ(drive.on_bytes(wire(kReadPv), 6ms), wire(kPv164));
    EXPECT_EQ(drive.on_bytes(wire(kReadPv), 7ms), wire(kPv230));
    EXPECT_EQ(drive.on_bytes(wire(kReadPv), 1h), wire(kPv230));
}

TEST(DriveAnswers, AWriteIsTakenWhateverItsValue)
{
    DriveAnswers drive{ei_ascii()};

    EXPECT_EQ(drive.on_bytes(wire(kWriteSl220), 0ms), wire("06"));
    EXPECT_EQ(drive.on_bytes(wire("04 30 30 31 31 02 53 4C 32 33 2E 30 03 03"), 0ms), wire("06"));
    EXPECT_THAT(drive.take_unknown(), IsEmpty());
}

TEST(DriveAnswers, ARequestMayComeInPiecesAndAnEotBeginsANewOne)
{
    DriveAnswers drive{ei_ascii()};

    EXPECT_FALSE(drive.on_bytes(wire("04 30 30"), 0ms));
    EXPECT_FALSE(drive.on_bytes(wire("31 31 50"), 0ms));
    EXPECT_EQ(drive.on_bytes(wire("56 05"), 0ms), wire(kPv164));
    EXPECT_EQ(drive.on_bytes(wire("04 30 30 " + kReadPv), 0ms), wire(kPv164));
    EXPECT_FALSE(drive.on_bytes(wire("30 30 31 31 50"), 0ms));
    drive.forget();
    EXPECT_EQ(drive.on_bytes(wire(kReadPv), 0ms), wire(kPv164));
}

TEST(DriveAnswers, ACheckOctetMayBeAnEot)
{
    const std::string write = "04 30 30 31 31 02 53 4C 32 32 2E 36 03 04"; // SL = 22.6
    DriveAnswers drive{ei_ascii()};

    EXPECT_EQ(drive.on_bytes(wire(write), 0ms), wire("06"));
}

TEST(DriveAnswers, WhatTheCaptureDoesNotHaveIsSilentAndNamedOnce)
{
    DriveAnswers drive{ei_ascii()};
    const std::string read_ii = "04 30 30 31 31 49 49 05";

    EXPECT_FALSE(drive.on_bytes(wire(read_ii), 0ms));
    EXPECT_FALSE(drive.on_bytes(wire(read_ii), 0ms));

    EXPECT_THAT(drive.take_unknown(), ElementsAre(wire(read_ii)));
    EXPECT_THAT(drive.take_unknown(), IsEmpty());
}

TEST(DriveAnswers, OfModbusReadAsTheyWereAndWritesWhateverTheirValue)
{
    // Register 403 is read and is 0; register 5 is written with 1; registers 2 and 3 with 7 and 8.
    const std::string write_5 = "01 06 00 05 00 01 58 0B", wrote_block = "01 10 00 02 00 02 E0 08";
    DriveAnswers drive{
        script({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), drive_out(2, "01 03 01 93 00 01 75 DB"),
                drive_in(3, "01 03 02 00 00 B8 44"), drive_out(4, write_5), drive_in(5, write_5),
                drive_out(6, "01 10 00 02 00 02 04 00 07 00 08 C2 71"), drive_in(7, wrote_block)},
               149)};

    EXPECT_EQ(drive.on_bytes(wire("01 03 01 93 00 01 75 DB"), 1h), wire("01 03 02 00 00 B8 44"));
    const std::string write_2 = "01 06 00 05 00 02 18 0A";
    EXPECT_EQ(drive.on_bytes(wire(write_2), 1h), wire(write_2)) << "an echo takes it";
    EXPECT_EQ(drive.on_bytes(wire("01 10 00 02 00 02 04 00 01 00 02 A2 77"), 1h), wire(wrote_block));
    EXPECT_FALSE(drive.on_bytes(wire("01 03 01 94 00 01 C4 1A"), 1h));
}

} // namespace
} // namespace dpslave::sim
