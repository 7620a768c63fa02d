// SPDX-License-Identifier: Apache-2.0
/// One request on a Modbus line and what is heard until its wait is over, to the nanosecond and frame by
/// frame. Which answer belongs to which of several requests is in answers_test.cpp.
#include "scripted_slave.hpp"

#include "dpslave/modbus/modbus_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace dpslave::modbus::test {
namespace {

using namespace std::chrono_literals;
using drive::TracedFrame;
using testing::ElementsAre;
using testing::IsEmpty;
using Heard = ModbusPort::Heard;

constexpr std::uint32_t kBaud = 10'000; ///< 1 ms for each character
constexpr auto kTimeOut = 600ms;
constexpr auto kRequest = 8ms; ///< of a read
constexpr auto kAnswer = 7ms;  ///< of one word
constexpr auto kSilence = 3500us;

/// On it comes what the test has written down.
class ExchangeLine final : public ModbusPort {
public:
    Instant time{1h};
    Instant asked_at{};
    std::vector<std::string> asked; ///< unit and request
    bool is_gone = false;
    std::chrono::nanoseconds send_waits{}; ///< as where the port switches a driver

    /// `frame`: without checksum, unit first.
    void comes(const std::string& frame, std::chrono::nanoseconds after)
    {
        coming_.push_back({Heard::frame, octets(frame), time + after});
    }
    void comes(Heard what, const std::string& raw, std::chrono::nanoseconds after)
    {
        coming_.push_back({what, octets(raw), time + after});
    }
    bool send(std::uint8_t unit, Bytes pdu) override
    {
        if (is_gone) return false;
        asked_at = time;
        asked.push_back(hex(Bytes{&unit, 1}) + " " + hex(pdu));
        time += send_waits;
        return true;
    }
    Heard receive(Instant until) override
    {
        if (is_gone) return Heard::gone;
        if (coming_.empty() || coming_.front().at > until) {
            time = std::max(time, until);
            return Heard::silence;
        }
        last_ = std::move(coming_.front());
        coming_.pop_front();
        time = std::max(time, last_.at);
        if (last_.what == Heard::gone) is_gone = true;
        return last_.what;
    }
    Bytes frame() const override { return last_.octets; }
    Piece piece() const override
    {
        return {.octets = last_.octets, .flaw = drive::Judgement::truncated, .read_at = time};
    }
    Instant now() const override { return time; }

private:
    struct Coming {
        Heard what = Heard::frame;
        Octets octets;
        Instant at{};
    };
    std::deque<Coming> coming_;
    Coming last_;
};

class FrameNames final : public drive::FrameListener {
public:
    void on_frame(const TracedFrame& frame) override
    {
        EXPECT_EQ(frame.protocol, drive::LineProtocol::modbus_rtu);
        begun = frame.begun;
        at = frame.at;
        switch (frame.what) {
            case TracedFrame::What::sent: lines.emplace_back("sent"); break;
            case TracedFrame::What::heard: lines.emplace_back(drive::name(frame.judgement)); break;
            case TracedFrame::What::silence: lines.emplace_back("silence"); break;
        }
    }
    std::vector<std::string> lines;
    Instant begun{}, at{}; ///< of the newest frame
};

class ModbusExchange : public testing::Test {
protected:
    explicit ModbusExchange(EchoMode echo = EchoMode::off) { open(kBaud, {.echo = echo}); }
    void open(std::uint32_t baud, const drive::LineTiming& rules)
    {
        ClientSettings settings;
        settings.baud = baud;
        settings.rules = rules;
        settings.timeout = kTimeOut;
        settings.rules.frames = &recorder;
        settings.units.push_back({.unit = 1, .has_loopback = has_loopback});
        client.emplace(line, settings);
    }
    AccessError read(std::uint16_t tag, std::uint8_t unit = 1)
    {
        return client->read({.unit = unit}, number(tag), {&word, 1});
    }
    AccessError write(std::uint16_t tag, std::uint16_t value)
    {
        return client->write({.unit = 1}, number(tag), {&value, 1});
    }
    drive::AnswerCounts counts() const { return client->counts({.unit = 1}); }

    bool has_loopback = false;
    ExchangeLine line;
    FrameNames recorder;
    std::optional<ModbusClient> client;
    std::uint16_t word = 0;
};
class ModbusExchangeWithEcho : public ModbusExchange {
protected:
    ModbusExchangeWithEcho() : ModbusExchange(EchoMode::on) {}
};

// ---- how long is waited

TEST_F(ModbusExchange, WaitsOneTimeOutAndTheTimeOfTheAnswerFromTheEndOfTheRequest)
{
    const Instant begun = line.time;
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(line.time, begun + kRequest + kTimeOut + kAnswer);
    EXPECT_EQ(client->last_trouble(), "no answer");
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "silence"));
}

TEST_F(ModbusExchange, WaitsAsLongWhereTheSendItselfWaitsForTheWire)
{
    line.send_waits = 9ms; // the request and the release of the driver
    const Instant begun = line.time;
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(line.time, begun + 9ms + kTimeOut + kAnswer);
}

TEST_F(ModbusExchange, AnAnswerBehindAForeignOneThatEndsWithTheWaitIsLate)
{
    const auto wait = kRequest + kTimeOut + kAnswer;
    line.comes("02 03 02 00 00", wait);
    line.comes("01 03 02 00 05", wait);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "foreign", "silence", "late"));
    EXPECT_EQ(counts().late, 1U);
}

TEST_F(ModbusExchange, ADebtSettlesAfterItsTimeTheAnswerOnTheWireAndWhatThePortHoldsBack)
{
    struct Settle {
        std::chrono::nanoseconds settle, hold_back, takes;
    };
    for (const Settle& one :
         {Settle{0ms, 0ms, 10 * kTimeOut}, Settle{900ms, 0ms, 900ms}, Settle{900ms, 16ms, 916ms}}) {
        open(kBaud, {.settle = one.settle, .hold_back = one.hold_back});
        ASSERT_EQ(read(1), AccessError::no_answer);
        const Instant settles = line.asked_at + kRequest + one.takes + kAnswer;
        line.time = settles - 1ns;
        EXPECT_EQ(read(2), AccessError::deferred);
        line.time = settles;
        EXPECT_EQ(read(2), AccessError::no_answer) << "it is asked";
        line.time += 1h;
    }
}

// ---- the silence before a request

TEST_F(ModbusExchange, AsksAfterThreeCharactersAndAHalfBeyond19200AFixedTimeAndWhatThePortHoldsBack)
{
    struct Pause {
        std::uint32_t baud;
        std::chrono::nanoseconds hold_back, pause;
    };
    for (const Pause& one :
         {Pause{300, 0ns, 116'666'666ns}, Pause{9600, 0ns, 3'645'833ns}, Pause{19'200, 0ns, 1'822'916ns},
          Pause{19'201, 0ns, 1750us}, Pause{115'200, 0ns, 1750us}, Pause{115'200, 16ms, 16ms}}) {
        open(one.baud, {.settle = {}, .hold_back = one.hold_back});
        line.comes("01 03 02 00 05", 100ms);
        ASSERT_EQ(read(1), AccessError::none);
        const Instant heard = line.time;
        read(2);
        EXPECT_EQ(line.asked_at, heard + one.pause) << one.baud;
        line.time += 1h;
    }
}

TEST_F(ModbusExchange, AsksAfterAPauseBehindWhatCameWithoutARequest)
{
    line.comes("01 03 02 00 05", 0ms);
    const Instant heard = line.time;
    read(1);
    EXPECT_EQ(line.asked_at, heard + kSilence);
}

TEST_F(ModbusExchange, AsksAfterAPauseBehindABrokenAnswer)
{
    line.comes(Heard::broken, "01 03", 50ms);
    ASSERT_EQ(read(1), AccessError::no_answer);
    const Instant heard = line.time;
    read(1, 2);
    EXPECT_EQ(line.asked_at, heard + kSilence);
}

TEST_F(ModbusExchange, JudgesAllThatCameBeforeItAsks)
{
    line.comes(Heard::broken, "01 03", 0ms);
    line.comes(Heard::rest, "02 00", 1ms);
    line.comes("02 03 02 00 05", 2ms);
    const Instant begun = line.time;
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(line.asked_at, begun + 2ms + kSilence);
    EXPECT_THAT(recorder.lines, ElementsAre("truncated", "no_frame", "foreign", "sent", "silence"));
}

TEST_F(ModbusExchange, CountsABrokenFrameForTheUnitThatWasAskedLast)
{
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.comes(Heard::broken, "01 03", 0ms);
    client->listen();
    EXPECT_EQ(counts().damaged, 1U);
}

TEST_F(ModbusExchange, AsksNothingOnALineThatDoesNotFallSilentForTheTimeOfTwoFrames)
{
    const Instant begun = line.time;
    for (auto after = 0ms; after < 1s; after += 1ms) line.comes(Heard::rest, "55", after);
    for (auto after = 0ms; after < 1s; after += 1ms) line.comes(Heard::broken, "55", 1s + after);

    line.time += 1s; // from here on it is broken
    EXPECT_EQ(read(1), AccessError::no_answer);

    EXPECT_THAT(line.asked, IsEmpty());
    EXPECT_EQ(client->last_trouble(), "noise and no answer: the line is never silent");
    EXPECT_EQ(line.time, begun + 1s + 2 * 256ms + 2 * kSilence + 1ms) << "the first one behind it";
}

// ---- a port that goes

TEST_F(ModbusExchange, APortThatIsMissingTakesNoRequest)
{
    line.is_gone = true;
    client->listen();
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(client->last_trouble(), "the line does not accept the request");
}

TEST_F(ModbusExchange, APortThatGoesEndsTheWait)
{
    const Instant begun = line.time;
    line.comes(Heard::gone, "", 50ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(line.time, begun + 50ms);
    EXPECT_EQ(client->last_trouble(), "the port has gone");
}

// ---- what is said of what came

TEST_F(ModbusExchange, SaysWhichAnswerWasForeignFirst)
{
    line.comes("01 03 04 00 B7 00 D8", 50ms);
    line.comes("02 03 02 00 00", 60ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(client->last_trouble(), "an answer that does not fit the request: 03 04 00 B7 00");
    EXPECT_EQ(counts().foreign, 2U);
    line.time += 1h;
    line.comes("02 03 02 00 00", 50ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(client->last_trouble(), "an answer of unit 2");
}

TEST_F(ModbusExchange, SaysOfALateAnswerOnlyThatTheRightOneIsMissing)
{
    ASSERT_EQ(read(1), AccessError::no_answer);
    line.comes("01 03 02 00 05", 50ms);
    EXPECT_EQ(read(1, 2), AccessError::no_answer);
    EXPECT_EQ(client->last_trouble(), "no answer");
    EXPECT_EQ(counts().late, 1U);
    EXPECT_EQ(client->counts({.unit = 2}).foreign, 0U) << "of the unit that was asked meanwhile";
}

TEST_F(ModbusExchange, UnitsThatDifferInOneBitOnlyAreTwo)
{
    for (const int other : {0x01 ^ 0x80, 0x01 ^ 0x40, 0x01 ^ 0x02}) {
        ASSERT_EQ(read(1), AccessError::no_answer);
        EXPECT_EQ(read(2), AccessError::deferred);
        EXPECT_EQ(read(2, static_cast<std::uint8_t>(other)), AccessError::no_answer) << "it is asked";
        line.time += 1h;
    }
}

TEST_F(ModbusExchange, AnAnswerToFunction8WithoutItsTokenIsForeign)
{
    line.comes("01 08 00 00", 50ms);
    line.comes("01 83", 60ms);
    line.comes("01 03 02 00 05", 70ms);
    EXPECT_EQ(read(1), AccessError::none);
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "foreign", "foreign", "taken"));
}

TEST_F(ModbusExchange, AnAnswerHasTheTimesOfItsFirstAndItsLastCharacter)
{
    const Instant begun = line.time;
    line.comes("01 03 02 00 05", 50ms); // its checksum is not shown
    ASSERT_EQ(read(1), AccessError::none);
    EXPECT_EQ(recorder.begun, begun + 50ms - 5ms);
    EXPECT_EQ(recorder.at, begun + 50ms);
}

// ---- whether a unit is there

TEST_F(ModbusExchange, AFrameOfAnotherUnitOrOneThatAnswersNothingBringsNoUnitBack)
{
    for (const char* frame : {"02 03 02 00 05", "01 04 02 00 05", "01 83 0A", "01 83 0B"}) {
        line.comes(frame, 50ms);
        EXPECT_NE(client->probe({.unit = 1}), AccessError::none) << frame;
        line.time += 1h;
    }
    for (const char* frame : {"01 03 02 00 05", "01 83 02", "01 83 04"}) {
        line.comes(frame, 50ms);
        EXPECT_EQ(client->probe({.unit = 1}), AccessError::none) << frame;
        line.time += 1h;
    }
}

TEST_F(ModbusExchange, ALateFrameOfAnotherUnitBringsNoUnitBack)
{
    ASSERT_EQ(read(1, 2), AccessError::no_answer);
    line.comes("02 03 02 00 05", 50ms);
    EXPECT_NE(client->probe({.unit = 1}), AccessError::none);
}

// ---- the echo

TEST_F(ModbusExchange, SaysThatTheLineHearsItsOwnRequest)
{
    line.comes("01 03 00 01 00 01", 10ms);
    line.comes("02 03 02 00 05", 20ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(client->last_trouble(), "the line hears its own request: set echo = \"on\" for it");
    EXPECT_EQ(counts().came_back, 1U);
}

TEST_F(ModbusExchange, TheOwnRequestIsNoSignOfLifeOfTheUnit)
{
    line.comes("01 03 00 01 00 01", 10ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(counts().valid_at, Instant{});
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "echo", "silence"));
}

TEST_F(ModbusExchange, WhatAGatewaySaysForTheUnitIsNoSignOfLifeOfIt)
{
    line.comes("01 83 0B", 10ms);
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(counts().valid_at, Instant{});
    line.time += 1h;
    line.comes("01 83 02", 10ms);
    EXPECT_EQ(read(1), AccessError::invalid_tag);
    EXPECT_NE(counts().valid_at, Instant{});
}

TEST_F(ModbusExchange, TheAnswerToAWriteIsNoRequestThatCameBack)
{
    line.comes("01 06 00 01 00 05", 10ms);
    EXPECT_EQ(write(1, 5), AccessError::none);
    EXPECT_EQ(client->last_trouble(), "");
    EXPECT_EQ(counts().came_back, 0U);
}

TEST_F(ModbusExchangeWithEcho, WaitsForTheAnswerWhenTheEchoIsBroken)
{
    line.comes(Heard::broken, "01 03", 5ms);
    line.comes(Heard::rest, "00 01", 8ms);
    line.comes("01 03 00 01 00 01", 10ms);
    line.comes("01 03 02 00 05", 20ms);
    EXPECT_EQ(read(1), AccessError::none);
    EXPECT_EQ(client->last_trouble(), "");
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "truncated", "no_frame", "echo", "taken"));
}

TEST_F(ModbusExchangeWithEcho, WhatIsBrokenBehindTheEchoEndsTheWait)
{
    line.comes("01 03 00 01 00 01", 10ms);
    line.comes(Heard::broken, "01 03", 20ms);
    const Instant begun = line.time;
    EXPECT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(line.time, begun + 20ms);
    EXPECT_EQ(counts().came_back, 0U) << "it was expected";
}

TEST_F(ModbusExchangeWithEcho, ARequestToAnotherUnitOrForAnotherRegisterIsNoEcho)
{
    line.comes("02 03 00 01 00 01", 5ms);
    line.comes("01 03 00 02 00 01", 6ms);
    line.comes("01 03 00 01 00 01", 10ms);
    line.comes("01 03 02 00 05", 20ms);
    EXPECT_EQ(read(1), AccessError::none);
    EXPECT_THAT(recorder.lines, ElementsAre("sent", "foreign", "foreign", "echo", "taken"));
}

TEST_F(ModbusExchange, UntilTheEchoIsKnownFunction8IsNotAsked)
{
    has_loopback = true;
    open(kBaud, {.echo = EchoMode::automatic});
    ASSERT_EQ(read(1), AccessError::no_answer);
    EXPECT_EQ(read(2), AccessError::deferred);
    EXPECT_THAT(line.asked, ElementsAre("01 03 00 01 00 01"));
}

} // namespace
} // namespace dpslave::modbus::test
