// SPDX-License-Identifier: Apache-2.0
/// Each frame of a Modbus line is noted once, with its judgement, as it was on the wire. The line has the
/// only clock; its octets go through the receiver of the real one.
#include "wire_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>

namespace dpslave::modbus::test {
namespace {

using namespace std::chrono_literals;
using drive::TracedFrame;
using testing::Contains;
using testing::ElementsAre;

class Recorder final : public drive::FrameListener {
public:
    void on_frame(const TracedFrame& frame) override
    {
        const std::string drive = std::to_string(frame.drive);
        switch (frame.what) {
            case TracedFrame::What::sent: lines.push_back("sent " + drive + ": " + hex(frame.octets)); break;
            case TracedFrame::What::heard:
                lines.push_back(std::string{drive::name(frame.judgement)} + " " + drive + ": " +
                                hex(frame.octets));
                break;
            case TracedFrame::What::silence: lines.push_back("silence " + drive); break;
        }
    }
    std::vector<std::string> lines;
};

constexpr const char* kAsk = "sent 1: 01 03 00 01 00 01 D5 CA";

class ModbusLineFrames : public testing::Test {
protected:
    explicit ModbusLineFrames(EchoMode echo = EchoMode::off)
    {
        ClientSettings settings;
        settings.timeout = 600ms;
        settings.rules.echo = echo;
        settings.rules.frames = &recorder;
        client.emplace(line, settings);
    }
    /// All that is noted of a read of register 1 that is answered so, and of what comes behind it.
    std::vector<std::string> noted(std::deque<WireLine::Chunk> answers)
    {
        line.answers = std::move(answers);
        std::uint16_t word = 0;
        drive::Tag tag;
        tag.number = 1;
        client->read({.unit = 1}, tag, {&word, 1});
        shown = word;
        line.time += 1s;
        client->listen();
        return std::exchange(recorder.lines, {});
    }
    drive::AnswerCounts counts() const { return client->counts({.unit = 1}); }
    std::uint16_t shown = 0; ///< the word that was read
    WireLine line;
    Recorder recorder;
    std::optional<ModbusClient> client;
};
class ModbusLineFramesWithEcho : public ModbusLineFrames {
protected:
    ModbusLineFramesWithEcho() : ModbusLineFrames(EchoMode::on) { line.echoes = true; }
};

TEST_F(ModbusLineFrames, ARequestAndItsAnswerHaveTheirCheckSums)
{
    EXPECT_THAT(noted({{octets("01 03 02 00 00 B8 44")}}),
                ElementsAre(kAsk, "taken 1: 01 03 02 00 00 B8 44"));
}

TEST_F(ModbusLineFrames, AnExceptionIsARefusal)
{
    EXPECT_THAT(noted({{framed("01 83 02")}}), ElementsAre(kAsk, "refused 1: 01 83 02 C0 F1"));
}

TEST_F(ModbusLineFrames, AWrongCheckSumAPieceAndABadCharacterAreNamed)
{
    EXPECT_THAT(noted({{octets("01 03 02 00 00 B8 45")}}),
                ElementsAre(kAsk, "bad_checksum 1: 01 03 02 00 00 B8 45"));
    line.time += 1h; // all is settled
    EXPECT_THAT(noted({{octets("01 03 02")}}), ElementsAre(kAsk, "truncated 1: 01 03 02"));
    line.time += 1h;
    EXPECT_THAT(noted({{octets("01 03"), 10ms, true}, {octets("00 00 B8 44"), 11ms}}),
                ElementsAre(kAsk, "bad_character 1: 01 03 00", "no_frame 1: 00 00 B8 44"));
}

TEST_F(ModbusLineFrames, AWaitWithoutAnswerIsASilenceAndItsAnswerIsLate)
{
    EXPECT_THAT(noted({{framed("01 03 02 00 00"), 1300ms}}),
                ElementsAre(kAsk, "silence 1", "late 1: 01 03 02 00 00 B8 44"));
}

TEST_F(ModbusLineFrames, AnotherUnitIsForeignAndASecondCopyADuplicate)
{
    const Octets answer = framed("01 03 02 00 00");
    EXPECT_THAT(noted({{framed("02 03 02 00 00"), 5ms}, {answer, 10ms}, {answer, 12ms}}),
                ElementsAre(kAsk, testing::StartsWith("foreign 1: 02 03 02 00 00"),
                            "taken 1: 01 03 02 00 00 B8 44", "duplicate 1: 01 03 02 00 00 B8 44"));
}

TEST_F(ModbusLineFramesWithEcho, TheEchoIsNotedBeforeTheAnswer)
{
    EXPECT_THAT(noted({{framed("01 03 02 00 00")}}),
                ElementsAre(kAsk, "echo 1: 01 03 00 01 00 01 D5 CA", "taken 1: 01 03 02 00 00 B8 44"));
}

// ---- noise before the frame

TEST_F(ModbusLineFrames, NoiseBeforeAnAnswerIsNoPartOfIt)
{
    for (const char* noise : {"00", "FF", "00 FF 00", "FE F0 80", "01", "01 03", "55 AA 12 34 56 78 9A",
                              "02 03 02", "01 03 02 00 00 00 00"}) {
        Octets all = octets(noise);
        for (const std::uint8_t octet : framed("01 03 02 12 34")) all.push_back(octet);
        EXPECT_THAT(noted({{all}}), ElementsAre(kAsk, std::string{"noise_before 1: "} + noise,
                                                "taken 1: 01 03 02 12 34 B5 33"));
        EXPECT_EQ(shown, 0x1234) << noise;
    }
    EXPECT_EQ(counts().noise, 9U);
    EXPECT_EQ(counts().damaged, 0U);
}

TEST_F(ModbusLineFrames, NoiseBeforeAnExceptionIsNoPartOfIt)
{
    EXPECT_THAT(noted({{octets("00 FF 01 83 02 C0 F1")}}),
                ElementsAre(kAsk, "noise_before 1: 00 FF", "refused 1: 01 83 02 C0 F1"));
}

TEST_F(ModbusLineFrames, ABadCharacterBeforeAnAnswerIsNoise)
{
    EXPECT_THAT(noted({{{}, 5ms, true}, {framed("01 03 02 12 34"), 10ms}}),
                ElementsAre(kAsk, "noise_before 1: 00", "taken 1: 01 03 02 12 34 B5 33"));
}

TEST_F(ModbusLineFrames, NoiseLongBeforeAnAnswerDoesNotEndTheWait)
{
    EXPECT_THAT(noted({{octets("00 80"), 5ms}, {framed("01 03 02 12 34"), 200ms}}),
                ElementsAre(kAsk, "no_frame 1: 00 80", "taken 1: 01 03 02 12 34 B5 33"));
    EXPECT_EQ(shown, 0x1234);
    EXPECT_EQ(counts().noise, 1U);
}

TEST_F(ModbusLineFrames, OnlyNoiseIsNoAnswer)
{
    EXPECT_THAT(noted({{octets("00 FF"), 5ms}}), ElementsAre(kAsk, "no_frame 1: 00 FF", "silence 1"));
    EXPECT_EQ(client->last_trouble(), "noise and no answer");
}

TEST_F(ModbusLineFrames, AUnitWithNoiseBeforeItsAnswersIsFoundByAProbe)
{
    line.answers = {{octets("00 FF 01 03 02 00 00 B8 44")}};
    EXPECT_EQ(client->probe({.unit = 1}), AccessError::none);
}

TEST_F(ModbusLineFramesWithEcho, TheEchoBehindNoiseIsTheEcho)
{
    line.noise_before_echo = octets("00");
    EXPECT_THAT(noted({{framed("01 03 02 12 34")}}),
                ElementsAre(kAsk, "noise_before 1: 00", "echo 1: 01 03 00 01 00 01 D5 CA",
                            "taken 1: 01 03 02 12 34 B5 33"));
}

/// Of an answer with a wrong checksum, or one that breaks off, no part counts, whatever it looks like.
TEST_F(ModbusLineFrames, WhatLiesInsideALongerAnswerIsNoFrame)
{
    for (const char* outer : {"01 03 0C 11 11 01 03 02 12 34 B5 33 00 00 00 00",
                              "01 03 08 11 11 01 83 02 C0 F1", "00 01 03 08 11 11 01 83 02 C0 F1 00 00 00"}) {
        EXPECT_THAT(noted({{octets(outer)}}), testing::Not(Contains(testing::HasSubstr("taken")))) << outer;
        EXPECT_THAT(client->last_trouble(), testing::HasSubstr("an answer with a wrong checksum")) << outer;
        EXPECT_EQ(shown, 0) << outer;
        line.time += 1h;
    }
}

TEST_F(ModbusLineFrames, BehindNoiseAFrameOfAnotherUnitOrFunctionDoesNotCount)
{
    for (const char* other : {"02 03 02 12 34", "01 04 02 12 34", "01 84 02"}) {
        Octets all = octets("00");
        for (const std::uint8_t octet : framed(other)) all.push_back(octet);
        EXPECT_THAT(noted({{all}}), testing::Not(Contains(testing::HasSubstr("noise_before")))) << other;
        line.time += 1h;
    }
}

// ---- the rule of time: at 9600 bit/s the request takes 8.3 ms and the answer 7.3 ms

TEST_F(ModbusLineFrames, WhatBeganBeforeTheRequestHadLeftIsNoAnswer)
{
    line.wire_time = true;
    EXPECT_THAT(noted({{framed("01 03 02 00 00"), 14ms}, {framed("01 03 02 12 34"), 30ms}}),
                ElementsAre(kAsk, "early 1: 01 03 02 00 00 B8 44", "taken 1: 01 03 02 12 34 B5 33"));
    EXPECT_EQ(shown, 0x1234);
    EXPECT_EQ(counts().early, 1U);
    EXPECT_THAT(noted({{framed("01 03 02 00 00"), 15ms}}), ElementsAre(kAsk, testing::StartsWith("taken")))
        << "one character is allowed for";
}

TEST_F(ModbusLineFrames, WhereNothingTakesWireTimeAnAnswerMayComeAtOnce)
{
    EXPECT_THAT(noted({{framed("01 03 02 00 00"), 1ms}}), ElementsAre(kAsk, testing::StartsWith("taken")));
}

/// One read gives both: the first has the characters of the second behind it.
TEST_F(ModbusLineFrames, ALateReadShowsByWhatCameBehindThatAFrameWasEarly)
{
    line.wire_time = true;
    Octets both = framed("01 03 02 00 00");
    for (const std::uint8_t octet : framed("01 03 02 12 34")) both.push_back(octet);
    EXPECT_THAT(noted({{both, 20ms}}),
                ElementsAre(kAsk, testing::StartsWith("early"), testing::StartsWith("taken")));
    EXPECT_EQ(shown, 0x1234);
}

} // namespace
} // namespace dpslave::modbus::test
