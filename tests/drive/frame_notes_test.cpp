// SPDX-License-Identifier: Apache-2.0
/// Each frame of an EI-ASCII line is noted once, with its judgement, as it was on the wire.
#include "drive/ei/ei_exchange.hpp"
#include "fake_drive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;
using test::Fault;
using testing::Contains;
using testing::ElementsAre;

constexpr UnitAddress kUnitA{0, 0}, kUnitB{0, 1};
constexpr ei::Mnemonic kOutput{'o', 'w'}, kUnknown{'q', 'q'};

/// Keeps "sent 00: 04 30 ..", "taken 00: 02 ..", "silence 00".
class Recorder final : public FrameListener {
public:
    void on_frame(const TracedFrame& frame) override
    {
        const std::string drive = hex(Bytes{&frame.drive, 1});
        switch (frame.what) {
            case TracedFrame::What::sent: lines.push_back("sent " + drive + ": " + hex(frame.octets)); break;
            case TracedFrame::What::heard:
                lines.push_back(std::string{name(frame.judgement)} + " " + drive + ": " + hex(frame.octets));
                break;
            case TracedFrame::What::silence: lines.push_back("silence " + drive); break;
        }
        first = frame.begun;
        last = frame.at;
        EXPECT_EQ(frame.protocol, LineProtocol::ei_ascii);
    }
    std::vector<std::string> lines;
    Instant first{}, last{}; ///< of the newest frame
};

constexpr const char* kAskOutput = "sent 00: 04 30 30 30 30 6F 77 05";
constexpr const char* kOutputIsA = "02 6F 77 3E 30 30 30 41 03 54"; // ow >000A

class EiLineFrames : public testing::Test {
protected:
    explicit EiLineFrames(EchoMode echo = EchoMode::off)
        : exchange(line, {.baud = 9600,
                          .timeout = 200ms,
                          .rules = {.settle = {}, .hold_back = {}, .echo = echo, .frames = &recorder}})
    {
        line.drives = {&a, &b};
        a.parameters["ow"].text = ">000A";
        a.parameters["ox"].text = ">00AA";
        b.parameters["ow"].text = ">000B";
        b.parameters["ox"].text = ">00BB";
    }
    /// All that was noted since the last call.
    std::vector<std::string> noted() { return std::exchange(recorder.lines, {}); }
    std::vector<std::string> noted_of_a_read(Fault fault = Fault::none)
    {
        a.faults = {fault};
        exchange.poll(kUnitA, kOutput);
        exchange.listen();
        return noted();
    }

    FakeDrive a{'0', '0'}, b{'0', '1'};
    test::SimulatedLine line;
    Recorder recorder;
    ei::Exchange exchange;
};
class EiLineFramesWithEcho : public EiLineFrames {
protected:
    EiLineFramesWithEcho() : EiLineFrames(EchoMode::on) { line.echoes = true; }
};

TEST_F(EiLineFrames, AQuestionAndItsAnswerAreAsOnTheWire)
{
    EXPECT_THAT(noted_of_a_read(), ElementsAre(kAskOutput, std::string{"taken 00: "} + kOutputIsA));
}

TEST_F(EiLineFrames, ADriveIsNotedByGroupAndUnit)
{
    exchange.poll({.group = 1, .unit = 15}, kOutput);
    EXPECT_THAT(noted(), ElementsAre("sent 1F: 04 31 31 46 46 6F 77 05", "silence 1F"));
}

TEST_F(EiLineFrames, AnAnswerHasTheTimesOfItsFirstAndItsLastCharacter)
{
    a.turnaround = 7ms;
    noted_of_a_read();

    const Instant first = line.asked_at + line.character() * 8 + 7ms;
    EXPECT_EQ(recorder.first, first);
    EXPECT_EQ(recorder.last, first + line.character() * 10);
}

TEST_F(EiLineFrames, AnEotAndANakAreRefusals)
{
    exchange.poll(kUnitA, kUnknown);
    EXPECT_THAT(noted(), Contains("refused 00: 04"));
    a.refuse_next = {">08C8"};
    exchange.select(kUnitA, kOutput, ">0001");
    EXPECT_THAT(noted(),
                ElementsAre("sent 00: 04 30 30 30 30 02 6F 77 3E 30 30 30 31 03 24", "refused 00: 15"));
}

TEST_F(EiLineFrames, AnAckIsTakenWhereNoOtherWriteIsOwedElseItIsDoubtful)
{
    exchange.select(kUnitA, kOutput, ">0001");
    EXPECT_THAT(noted(), Contains("taken 00: 06"));
    b.faults = {Fault::silent};
    exchange.select(kUnitB, kOutput, ">0001");
    exchange.select(kUnitA, kOutput, ">0002");
    EXPECT_THAT(noted(), Contains("doubtful 00: 06"));
}

TEST_F(EiLineFrames, AWrongCheckSumIsNamed)
{
    EXPECT_THAT(noted_of_a_read(Fault::bad_bcc),
                ElementsAre(kAskOutput, "bad_checksum 00: 02 6F 77 3E 30 30 30 41 03 55"));
}

TEST_F(EiLineFrames, AnAnswerThatBreaksOffIsTruncated)
{
    EXPECT_THAT(noted_of_a_read(Fault::half_answer), ElementsAre(kAskOutput, "truncated 00: 02 6F 77 3E 30"));
}

TEST_F(EiLineFrames, AnAnswerThatBreaksOffIsNotedWhenItIsGivenUp)
{
    a.faults = {Fault::half_answer};
    exchange.poll(kUnitA, kOutput);
    EXPECT_THAT(noted(), Contains("truncated 00: 02 6F 77 3E 30"));
}

TEST_F(EiLineFrames, WhatBeginsAsNoFrameIsNoneUntilTheLineIsSilent)
{
    EXPECT_THAT(noted_of_a_read(Fault::stray_octet),
                ElementsAre(kAskOutput, std::string{"no_frame 00: 78 "} + kOutputIsA));
}

TEST_F(EiLineFrames, TheNoiseOfATransceiverIsNoPartOfTheAnswerBehindIt)
{
    EXPECT_THAT(noted_of_a_read(Fault::glitch),
                ElementsAre(kAskOutput, "noise_before 00: FF", std::string{"taken 00: "} + kOutputIsA));
}

TEST_F(EiLineFrames, ACharacterWithAParityFaultIsABadOne)
{
    a.alive = false;
    line.comes_by_itself({"\x02ow>0\0\x30", 7}, 20ms);
    exchange.poll(kUnitA, kOutput);
    exchange.listen();

    EXPECT_THAT(noted(), ElementsAre(kAskOutput, "bad_character 00: 02 6F 77 3E 30 00 30"));
}

TEST_F(EiLineFrames, AWaitWithoutAnswerIsASilenceAndItsAnswerIsLate)
{
    a.turnaround = 250ms;
    exchange.poll(kUnitA, kOutput);
    EXPECT_THAT(noted(), ElementsAre(kAskOutput, "silence 00"));
    line.time += 100ms;
    exchange.listen();
    EXPECT_THAT(noted(), ElementsAre(std::string{"late 00: "} + kOutputIsA));
}

TEST_F(EiLineFrames, AnAnswerForAnotherMnemonicThatNobodyOwesIsForeign)
{
    EXPECT_THAT(noted_of_a_read(Fault::wrong_parameter),
                Contains(testing::StartsWith("foreign 00: 02 7A 7A")));
}

TEST_F(EiLineFrames, AnEotWhereAnAckIsWaitedForIsForeign)
{
    line.comes_by_itself("\x04", 17ms);
    exchange.select(kUnitA, kOutput, ">0001");
    EXPECT_THAT(noted(), testing::IsSupersetOf({"foreign 00: 04", "taken 00: 06"}));
    EXPECT_EQ(exchange.counts(kUnitA).foreign, 1U);
}

TEST_F(EiLineFrames, ASecondCopyIsADuplicate)
{
    line.comes_by_itself("\x02ow>000A\x03T", 60ms);
    exchange.poll(kUnitA, kOutput);
    line.time += 100ms;
    exchange.listen();

    EXPECT_THAT(noted(), ElementsAre(kAskOutput, std::string{"taken 00: "} + kOutputIsA,
                                     std::string{"duplicate 00: "} + kOutputIsA));
}

TEST_F(EiLineFrames, AnEotThatNothingWaitsForIsUnclear)
{
    exchange.poll(kUnitA, kOutput);
    line.comes_by_itself("\x04");
    line.time += 10ms;
    exchange.listen();

    EXPECT_THAT(noted(), Contains("unclear 00: 04"));
}

TEST_F(EiLineFrames, AValueThatMayBeOlderIsNamedSoAndMoreSoBehindAWrite)
{
    a.faults = {Fault::lost_answer};
    exchange.poll(kUnitA, kOutput);
    exchange.poll(kUnitA, kOutput);
    EXPECT_THAT(noted(), Contains(std::string{"older 00: "} + kOutputIsA));
    exchange.select(kUnitA, kOutput, ">000A");
    exchange.poll(kUnitA, kOutput);
    EXPECT_THAT(noted(), Contains(std::string{"before_write 00: "} + kOutputIsA));
}

TEST_F(EiLineFramesWithEcho, TheEchoIsNotedBeforeTheAnswer)
{
    EXPECT_THAT(noted_of_a_read(), ElementsAre(kAskOutput, "echo 00: 04 30 30 30 30 6F 77 05",
                                               std::string{"taken 00: "} + kOutputIsA));
}

TEST_F(EiLineFramesWithEcho, AnEotThatBeganLikeAnEchoIsNotedThoughNothingFollows)
{
    a.alive = line.echoes = false;
    exchange.poll(kUnitA, kOutput);
    line.comes_by_itself("\x04");
    line.time += 10ms;
    exchange.listen();

    EXPECT_THAT(noted(), Contains("unclear 00: 04"));
}

TEST(Judgements, HaveEachANameAndWordsOfTheirOwn)
{
    std::vector<std::string_view> names, texts;
    for (std::size_t i = 0; i < kJudgements; ++i) {
        const auto judgement = static_cast<Judgement>(i);
        EXPECT_THAT(names, testing::Not(Contains(name(judgement))));
        EXPECT_THAT(texts, testing::Not(Contains(text(judgement))));
        names.push_back(name(judgement));
        texts.push_back(text(judgement));
    }
    EXPECT_EQ(name(Judgement::no_frame), "no_frame") << "the last one";
}

} // namespace
} // namespace dpslave::drive
