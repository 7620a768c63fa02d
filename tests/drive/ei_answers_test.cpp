// SPDX-License-Identifier: Apache-2.0
/// Tests which answer belongs to which question, on a line with two drives that have the same mnemonics.
#include "fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;
using test::Fault;
using testing::HasSubstr;

constexpr UnitAddress kFirst{0, 0}, kSecond{0, 1}, kMissing{0, 2};

Tag word_tag(std::uint16_t number)
{
    Tag tag;
    tag.number = number;
    tag.type = TagType::word;
    return tag;
}

class EiAnswers : public testing::Test {
protected:
    explicit EiAnswers(EchoMode echo = EchoMode::off)
        : client(line,
                 {.baud = 9600, .timeout = 200ms, .rules = {.settle = {}, .hold_back = {}, .echo = echo}},
                 {{kFirst, MnemonicRule::dc_590plus},
                  {kSecond, MnemonicRule::dc_590plus},
                  {kMissing, MnemonicRule::dc_590plus}})
    {
        line.drives = {&a, &b};
        a.parameters["ow"].text = ">000A";
        b.parameters["ow"].text = ">000B";
        a.parameters["ox"].text = ">00AA";
        b.parameters["ox"].text = ">00BB";
    }
    AccessError read(UnitAddress unit, const Tag& tag)
    {
        word = 0xDEAD;
        return client.read(unit, tag, {&word, 1});
    }
    AccessError write(UnitAddress unit, const Tag& tag, std::uint16_t value)
    {
        return client.write(unit, tag, {&value, 1});
    }
    static std::string stray(char octet) { return std::string(1, octet); }

    FakeDrive a{'0', '0'}, b{'0', '1'};
    test::SimulatedLine line;
    EiAsciiClient client;
    std::uint16_t word = 0;
    const Tag output = word_tag(536), input = word_tag(537);
};
class EiEchoOn : public EiAnswers {
protected:
    EiEchoOn() : EiAnswers(EchoMode::on) { line.echoes = true; }
};
class EiEchoAuto : public EiAnswers {
protected:
    EiEchoAuto() : EiAnswers(EchoMode::automatic) {}
};

// ---- the silence before a question

/// What the port still holds back of the last answer has to come before the next question.
TEST(EiHoldBack, IsHowLongTheLineWasSilentBeforeEachQuestion)
{
    for (const std::chrono::milliseconds holds : {0ms, 1ms, 16ms}) {
        FakeDrive drive{'0', '0'};
        drive.parameters["ow"].text = ">000A";
        test::SimulatedLine line;
        line.drives = {&drive};
        EiAsciiClient client{
            line,
            {.baud = 9600, .timeout = 200ms, .rules = {.settle = {}, .hold_back = holds, .echo = {}}},
            {{kFirst, MnemonicRule::dc_590plus}}};
        std::uint16_t word = 0;
        for (int i = 0; i < 3; ++i) {
            const Instant answered = line.time;
            ASSERT_EQ(client.read(kFirst, word_tag(536), {&word, 1}), AccessError::none);
            if (i == 0) continue;
            EXPECT_GE(line.asked_at - answered, holds);
            EXPECT_LE(line.asked_at - answered, holds + 1ms) << "no longer than that";
        }
    }
}

// ---- values

TEST_F(EiAnswers, ADriveThatIsAlwaysLateByALittleGivesNoValueToTheOther)
{
    for (int i = 0; line.time < Instant{} + 30s; ++i) {
        b.turnaround = 210ms + std::chrono::milliseconds{i % 21};
        for (const Tag& tag : {output, input}) {
            if (read(kFirst, tag) == AccessError::none) {
                EXPECT_EQ(word, tag.number == 536 ? 0x000A : 0x00AA);
            }
            if (read(kSecond, tag) == AccessError::none) {
                EXPECT_EQ(word, tag.number == 536 ? 0x000B : 0x00BB);
            }
        }
    }
    EXPECT_GE(client.counts(kSecond).late_in_a_row, kAlwaysLate);
    EXPECT_GT(needed_timeout(client.counts(kSecond)), 210ms);
    EXPECT_EQ(needed_timeout(client.counts(kFirst)), 0ms);
}

TEST_F(EiAnswers, OneAnswerInTwentyThatIs900MsLateGivesNoWrongValue)
{
    int good = 0;
    for (int i = 0; line.time < Instant{} + 40s; ++i) {
        b.turnaround = i % 20 == 0 ? 900ms : 5ms;
        b.parameters["ow"].text = i % 40 < 20 ? ">000B" : ">0B0B";
        if (read(kSecond, output) == AccessError::none) {
            EXPECT_EQ(word, std::stoi(b.parameters["ow"].text.substr(1), nullptr, 16));
            ++good;
        }
        b.turnaround = 5ms;
        if (read(kFirst, output) == AccessError::none) {
            EXPECT_EQ(word, 0x000A);
            ++good;
        }
        line.time += 10ms;
    }
    EXPECT_GT(good, 300) << "and the line goes on";
}

TEST_F(EiAnswers, WhatOneDriveOwesIsNotAskedOfAnother)
{
    b.faults = {Fault::silent};
    ASSERT_EQ(read(kSecond, output), AccessError::no_answer);
    line.sent.clear();

    EXPECT_EQ(read(kFirst, output), AccessError::deferred);
    EXPECT_EQ(line.sent, "");
    EXPECT_EQ(read(kFirst, input), AccessError::none);
}

TEST_F(EiAnswers, TheAnswerToAQuestionThatLeftInACallThatStalledIsNotTakenForThatOfAnotherDrive)
{
    a.turnaround = 40ms;
    line.stalls = true;
    EXPECT_EQ(read(kFirst, input), AccessError::no_answer);
    line.stalls = false;

    EXPECT_NE(read(kSecond, input), AccessError::none) << "the other answer is still owed";
    EXPECT_EQ(word, 0xDEAD);

    line.time += 100ms;
    client.listen();
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(read(kSecond, input), AccessError::none);
}

TEST_F(EiAnswers, AValueOfAnotherMnemonicClearsTheDebt)
{
    b.faults = {Fault::silent};
    ASSERT_EQ(read(kSecond, output), AccessError::no_answer);
    ASSERT_EQ(read(kSecond, input), AccessError::none);

    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(word, 0x000A);
}

TEST_F(EiAnswers, ADriveThatOwesThisVeryTagIsAskedForSomethingElseFirst)
{
    b.faults = {Fault::silent};
    ASSERT_EQ(read(kSecond, output), AccessError::no_answer);
    line.sent.clear();

    EXPECT_EQ(read(kSecond, output), AccessError::none);
    EXPECT_EQ(line.sent, "\x04"
                         "0011II\x05"
                         "\x04"
                         "0011ow\x05");
    EXPECT_EQ(read(kFirst, output), AccessError::none) << "nothing is owed any more";
}

TEST_F(EiAnswers, AValueIsSaidToBeMaybeOlderWhereNothingElseCouldBeAskedBetween)
{
    for (int i = 0; i < 3; ++i) ASSERT_EQ(client.probe(kMissing), AccessError::no_answer); // II, V0, EE
    b.faults = {Fault::silent};
    ASSERT_EQ(read(kSecond, output), AccessError::no_answer);

    EXPECT_EQ(read(kSecond, output), AccessError::none);
    EXPECT_TRUE(client.may_be_older());

    EXPECT_EQ(read(kSecond, input), AccessError::none);
    EXPECT_FALSE(client.may_be_older());
}

TEST_F(EiAnswers, ADebtOfADeadDriveSettlesTenTimeOutsAfterItsQuestion)
{
    b.alive = false;
    ASSERT_EQ(read(kSecond, output), AccessError::no_answer);
    line.time = Instant{} + 2s;
    EXPECT_EQ(read(kFirst, output), AccessError::deferred);
    line.time = Instant{} + 2100ms;
    EXPECT_EQ(read(kFirst, output), AccessError::none);
}

// ---- EOT, NAK and EE

TEST_F(EiAnswers, OneStrayEotIsNoVerdictOnTheTag)
{
    line.comes_by_itself(stray('\x04'), 12ms);
    EXPECT_EQ(read(kFirst, output), AccessError::not_understood);
    EXPECT_EQ(read(kFirst, output), AccessError::none);
}

TEST_F(EiAnswers, AStrayEotAndAnOldEeAreNoVerdictEither)
{
    a.ee = ">01C7";
    line.comes_by_itself(stray('\x04'), 12ms);
    EXPECT_EQ(read(kFirst, output), AccessError::none) << "asked again with EE at 0";
    EXPECT_EQ(word, 0x000A);
}

TEST_F(EiAnswers, ATagIsInvalidWhenTheDriveHasSaidSoTwiceWithEeAt0Before)
{
    a.parameters.erase("ow");
    EXPECT_EQ(read(kFirst, output), AccessError::invalid_tag);
    const std::string ask = "\x04"
                            "0000ow\x05",
                      ee = "\x04"
                           "0000EE\x05",
                      clear = "\x04"
                              "0000\x02"
                              "EE>0000\x03\x3D";
    EXPECT_EQ(line.sent, ask + ee + clear + ee + ask + ee + clear + ee + ask + ee);
    line.sent.clear();
    EXPECT_EQ(read(kFirst, output), AccessError::invalid_tag);
    EXPECT_EQ(line.sent, ask + ee) << "known by now";
}

TEST_F(EiAnswers, AStrayNakIsNoRefusal)
{
    line.comes_by_itself(stray('\x15'), 16ms);
    EXPECT_EQ(write(kFirst, output, 1), AccessError::not_understood) << "EE says 00C0: the frame was spoilt";
}

TEST_F(EiAnswers, AStrayNakAndAnOldEeAreNoRefusalEither)
{
    a.ee = ">05C8";
    line.comes_by_itself(stray('\x15'), 16ms);
    EXPECT_EQ(write(kFirst, output, 1), AccessError::none);
    EXPECT_EQ(a.parameters["ow"].text, ">0001");
}

TEST_F(EiAnswers, ARefusalIsAcceptedAtOnceOnceEeIsKnownToBe0)
{
    a.parameters["ow"].read_only = true;
    ASSERT_EQ(write(kFirst, output, 1), AccessError::read_only);
    const unsigned before = a.requests;
    EXPECT_EQ(write(kFirst, output, 1), AccessError::read_only);
    EXPECT_EQ(a.requests - before, 4u) << "the write, EE, and EE to 0 for the next time";
}

// ---- ACK

TEST_F(EiAnswers, ALateAckOfOneDriveIsNoAckOfAnother)
{
    a.turnaround = 250ms;
    ASSERT_EQ(write(kFirst, output, 1), AccessError::no_answer);

    EXPECT_EQ(write(kMissing, output, 0), AccessError::no_answer) << "no such drive";
}

TEST_F(EiAnswers, ADoubtfulAckIsProvenByReadingBack)
{
    a.faults = {Fault::lost_answer};
    ASSERT_EQ(write(kFirst, output, 1), AccessError::no_answer);
    line.sent.clear();

    EXPECT_EQ(write(kSecond, output, 2), AccessError::none);
    EXPECT_EQ(b.parameters["ow"].text, ">0002");
    EXPECT_THAT(line.sent, HasSubstr("\x04"
                                     "0011II\x05"
                                     "\x04"
                                     "0011ow\x05"))
        << "what it does not owe, then what it holds";
}

TEST_F(EiAnswers, ADoubtfulAckWithoutProofIsNone)
{
    a.faults = {Fault::lost_answer};
    ASSERT_EQ(write(kFirst, output, 1), AccessError::no_answer);
    b.faults = {Fault::none, Fault::none, Fault::silent};

    EXPECT_EQ(write(kSecond, output, 2), AccessError::no_answer);
}

// ---- a drive is back only on a value

TEST_F(EiAnswers, AStrayEotDoesNotBringADriveBack)
{
    line.comes_by_itself(stray('\x04'), 12ms);
    EXPECT_NE(client.probe(kMissing), AccessError::none);
}

/// Its EOT names nothing, and EE could be the answer of the other drive.
TEST_F(EiAnswers, ADriveWithoutSpareMnemonicsIsProvenByATagWhileAnotherOneOwesEe)
{
    a.parameters.erase("II");
    ASSERT_EQ(read(kFirst, input), AccessError::none);
    b.faults = {Fault::none, Fault::silent};
    ASSERT_EQ(read(kSecond, word_tag(5)), AccessError::no_answer) << "an EOT, and no EE behind it";
    b.alive = false;

    EXPECT_EQ(client.probe(kFirst), AccessError::none);
    EXPECT_EQ(client.counts(kFirst).valid_at, line.time);

    a.alive = false;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(client.probe(kFirst), AccessError::no_answer);
    line.comes_by_itself(stray('\x04'), 12ms);
    EXPECT_EQ(client.probe(kFirst), AccessError::no_answer) << "a stray EOT";
}

TEST_F(EiAnswers, AWriteToADriveWithoutSpareMnemonicsIsProvenWhileAnotherOneOwesEe)
{
    a.parameters.erase("II");
    ASSERT_EQ(read(kFirst, input), AccessError::none);
    b.faults = {Fault::silent, Fault::silent};
    ASSERT_EQ(write(kSecond, output, 1), AccessError::no_answer);
    b.faults = {Fault::none, Fault::silent};
    ASSERT_EQ(read(kSecond, word_tag(5)), AccessError::no_answer);
    b.alive = false;

    ASSERT_EQ(write(kFirst, output, 0x1234), AccessError::none) << client.last_trouble();
    EXPECT_EQ(a.parameters["ow"].text, ">1234");
}

TEST_F(EiAnswers, AnEchoBringsNoDriveBackHoweverTheLineIsSet)
{
    line.echoes = true;
    EXPECT_NE(client.probe(kMissing), AccessError::none);
    EXPECT_NE(read(kMissing, output), AccessError::none);
    EXPECT_NE(write(kMissing, output, 1), AccessError::none);
}

TEST_F(EiAnswers, ARequestThatComesBackThoughThereIsNoEchoIsCounted)
{
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(client.counts(kFirst).came_back, 0U);
    line.echoes = true;
    for (int i = 0; i < 4; ++i) read(kMissing, output);
    read(kFirst, input);
    EXPECT_GE(client.counts(kMissing).came_back, 3U);
}

TEST_F(EiEchoOn, AnEchoThatIsExpectedIsNotCounted)
{
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(client.counts(kFirst).came_back, 0U);
}

TEST_F(EiEchoOn, IsTakenAwayAndTheAnswerBehindItIsTaken)
{
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(word, 0x000A);
    EXPECT_EQ(write(kFirst, output, 5), AccessError::none);
    a.parameters.erase("ox");
    EXPECT_EQ(read(kFirst, input), AccessError::invalid_tag) << "an EOT behind the echo";
    EXPECT_NE(client.probe(kMissing), AccessError::none);
}

TEST_F(EiEchoAuto, IsTakenAwayWhereThereIsOneAndNotMissedWhereThereIsNone)
{
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    line.echoes = true;
    EXPECT_EQ(read(kFirst, output), AccessError::none);
    EXPECT_EQ(write(kFirst, output, 5), AccessError::none);
}

} // namespace
} // namespace dpslave::drive
