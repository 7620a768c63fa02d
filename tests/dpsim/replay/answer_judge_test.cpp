// SPDX-License-Identifier: Apache-2.0
#include "capture.hpp"
#include "dpsim/replay/answer_judge.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::HasSubstr;

/// The verdict on `is` as the answer to the last telegram of a capture, whose answer there is `was`.
AnswerJudge::Verdict judge(const std::string& request, const std::string& was, const std::string& is,
                           DriveSide drive)
{
    const auto made = script({bus_in(0, request), bus_out(1, was)});
    return AnswerJudge{made, drive}.judge(0, wire(is));
}

TEST(AnswerJudge, EqualOctetsAreTheSame)
{
    for (const auto drive : {DriveSide::unknown, DriveSide::capture}) {
        const auto verdict = judge(kFdlStatus, kFdlStatusOk, kFdlStatusOk, drive);
        EXPECT_TRUE(verdict.is_same);
        EXPECT_FALSE(verdict.is_masked);
    }
}

TEST(AnswerJudge, NamesTheFirstOctetThatDiffers)
{
    // Octet 13 is Master_Add.
    const auto verdict = judge(kDiagRequest, kDiagReady, "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 FF 47 11 EC 16",
                               DriveSide::unknown);

    EXPECT_FALSE(verdict.is_same);
    EXPECT_EQ(verdict.why, "octet 13 is FF, there 02");
}

TEST(AnswerJudge, WhetherADiagnosisWaitsAndStatDiagFollowFromTheDrive)
{
    for (const auto drive : {DriveSide::unknown, DriveSide::capture}) {
        EXPECT_TRUE(judge(kExchange, kInputs1234Dh, kInputs1234, drive).is_masked);
        EXPECT_TRUE(judge(kDiagRequest, kDiagNotReady, kDiagReady, drive).is_masked);
    }
}

TEST(AnswerJudge, WithoutInputsADiagnosisThatWaitsIsATelegramInPlaceOfTheShortAcknowledge)
{
    const std::string waits = "10 02 05 0A 11 16";

    EXPECT_TRUE(judge(kExchange, "E5", waits, DriveSide::capture).is_masked);
    EXPECT_TRUE(judge(kExchange, waits, "E5", DriveSide::capture).is_masked);
    EXPECT_FALSE(judge(kChkCfg, "E5", waits, DriveSide::capture).is_same) << "of another service";
    EXPECT_FALSE(judge(kExchange, "E5", "10 02 06 0A 12 16", DriveSide::capture).is_same)
        << "of another station";
}

TEST(AnswerJudge, InputsOfAnUnknownDriveAreNotCompared)
{
    const std::string other = "68 05 05 68 02 05 08 99 99 41 16";

    EXPECT_TRUE(judge(kExchange, kInputs1234, other, DriveSide::unknown).is_masked);
    const auto verdict = judge(kExchange, kInputs1234, other, DriveSide::capture);
    EXPECT_FALSE(verdict.is_same);
    EXPECT_THAT(verdict.why, HasSubstr("input word 1 is 9999"));
}

TEST(AnswerJudge, AnInputWordMayBeOneThatTheCaptureHasInThisPlaceUnderThisConfiguration)
{
    // Two words: 1111 2222, later 3333 4444. After another Chk_Cfg: 5555 6666.
    const std::string first = "68 07 07 68 02 05 08 11 11 22 22 75 16",
                      second = "68 07 07 68 02 05 08 33 33 44 44 FD 16";
    const auto made = script({bus_in(0, kChkCfg), bus_out(1, "E5"), bus_in(2, kExchange), bus_out(3, first),
                              bus_in(4, kExchange), bus_out(5, second), bus_in(6, kChkCfg), bus_out(7, "E5"),
                              bus_in(8, kExchange), bus_out(9, "68 07 07 68 02 05 08 55 55 66 66 85 16")});
    const AnswerJudge judge{made, DriveSide::capture};

    EXPECT_TRUE(judge.judge(1, wire(second)).is_masked);
    EXPECT_TRUE(judge.judge(1, wire("68 07 07 68 02 05 08 11 11 44 44 B9 16")).is_same)
        << "the words change one by one";
    EXPECT_FALSE(judge.judge(1, wire("68 07 07 68 02 05 08 22 22 11 11 75 16")).is_same)
        << "in the other place";
    EXPECT_FALSE(judge.judge(1, wire("68 07 07 68 02 05 08 55 55 66 66 85 16")).is_same)
        << "of another configuration";
    EXPECT_FALSE(judge.judge(4, wire(second)).is_same);
}

TEST(AnswerJudge, LengthsServicesAndRefusalsAreAlwaysCompared)
{
    const std::string rs = "10 02 05 03 0A 16";

    EXPECT_FALSE(judge(kExchange, kInputs1234, rs, DriveSide::unknown).is_same);
    EXPECT_FALSE(judge(kChkCfg, "E5", rs, DriveSide::unknown).is_same);
    EXPECT_FALSE(
        judge(kExchange, kInputs1234, "68 06 06 68 02 05 08 12 34 00 55 16", DriveSide::unknown).is_same);
    EXPECT_FALSE(
        judge(kExchange, kInputs1234, "68 05 05 68 02 06 08 12 34 56 16", DriveSide::unknown).is_same)
        << "from another station";
    EXPECT_FALSE(
        judge(kExchange, kInputs1234, "68 05 05 68 02 05 08 12 34 56 16", DriveSide::unknown).is_same)
        << "a wrong FCS";
}

TEST(AnswerJudge, TheExtendedDiagnosisFollowsFromTheDrive)
{
    const std::string well = "68 0F 0F 68 82 85 08 3E 3C 00 0C 00 02 47 11 04 00 00 00 F3 16";
    const std::string tripped = "68 0F 0F 68 82 85 08 3E 3C 08 0C 00 02 47 11 04 01 02 00 FE 16";

    EXPECT_TRUE(judge(kDiagRequest, well, tripped, DriveSide::unknown).is_masked);
    EXPECT_FALSE(judge(kDiagRequest, well, tripped, DriveSide::capture).is_same);
    EXPECT_FALSE(judge(kDiagRequest, well, kDiagReady, DriveSide::unknown).is_same) << "its length does not";
}

} // namespace
} // namespace dpslave::sim
