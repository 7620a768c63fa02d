// SPDX-License-Identifier: Apache-2.0
/// One question on an EI-ASCII line and what is heard until its wait is over, to the nanosecond and read by
/// read. What the answers then mean for two drives is in ei_answers_test.cpp.
#include "drive/ei/ei_exchange.hpp"
#include "written_line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace dpslave::drive::ei {
namespace {

using namespace std::chrono_literals;
using End = Exchange::End;

constexpr UnitAddress kFirst{0, 0}, kSecond{0, 1};
constexpr Mnemonic kOw{'o', 'w'}, kOx{'o', 'x'};
constexpr auto kRequest = 8ms; ///< a poll at the rate of the line
constexpr auto kTimeout = 200ms;

/// What is asked is written down.
class AskedLine final : public test::WrittenLine {
public:
    Instant asked_at{};
    std::string sent;
    bool is_unplugged = false;
    std::chrono::nanoseconds no_processor_for{}; ///< behind the next octets

    std::size_t read(std::span<std::uint8_t> into, std::chrono::nanoseconds timeout) override
    {
        const std::size_t got = WrittenLine::read(into, timeout);
        if (got != 0) time += std::exchange(no_processor_for, {});
        return got;
    }
    bool write(Bytes octets) override
    {
        if (is_unplugged) return false;
        asked_at = time;
        sent.append(octets.begin(), octets.end());
        return true;
    }
};

/// STX C1 C2 text ETX BCC.
std::string value(const std::string& mnemonic, const std::string& text)
{
    const std::string covered = mnemonic + text + '\x03';
    char sum = 0;
    for (const char c : covered) sum = static_cast<char>(sum ^ c);
    return '\x02' + covered + sum;
}

class EiExchange : public testing::Test {
protected:
    explicit EiExchange(EchoMode echo = EchoMode::off) { open(AskedLine::kBaud, {.echo = echo}); }
    void open(std::uint32_t baud, const LineTiming& rules)
    {
        exchange.emplace(line, EiTiming{.baud = baud, .timeout = kTimeout, .rules = rules});
    }
    /// A question that stays without answer.
    void leave_owed(UnitAddress unit, Mnemonic mnemonic)
    {
        ASSERT_EQ(exchange->poll(unit, mnemonic), End::silence);
    }
    AskedLine line;
    std::optional<Exchange> exchange;
};
class EiExchangeWithEcho : public EiExchange {
protected:
    EiExchangeWithEcho() : EiExchange(EchoMode::on) {}
};

// ---- how long is waited

TEST_F(EiExchange, WaitsOneTimeOutFromTheEndOfTheRequest)
{
    const Instant begun = line.time;
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);
    EXPECT_EQ(line.time, begun + kRequest + kTimeout);
    EXPECT_EQ(exchange->trouble(), "no answer");
}

TEST_F(EiExchange, GivesUpAnAnswerThatBreaksOffAfterTwentyCharactersButNotBefore20Ms)
{
    struct Gap {
        std::uint32_t baud;
        std::chrono::nanoseconds hold_back, gap;
    };
    for (const Gap& one : {Gap{300, 0ns, 666'666'666ns}, Gap{9600, 0ns, 20'833'333ns}, Gap{19'200, 0ns, 20ms},
                           Gap{19'200, 16ms, 36ms}}) {
        open(one.baud, {.hold_back = one.hold_back});
        line.time += 1h;
        const Instant begun = line.time;
        line.comes("\x02ow>0", 100ms);
        EXPECT_EQ(exchange->poll(kFirst, kOw), End::damaged);
        EXPECT_EQ(line.time, begun + 100ms + one.gap) << one.baud;
        EXPECT_EQ(exchange->trouble(), "the answer broke off");
    }
}

TEST_F(EiExchange, GivesAnAnswerThatHasBegunTheTimeOfTheLongestOne)
{
    open(300, {});
    const Instant begun = line.time;
    line.comes("\x02ow", 400ms);
    for (auto after = 900ms; after < 10s; after += 500ms) line.comes("0", after);

    EXPECT_EQ(exchange->poll(kFirst, kOw), End::damaged);

    constexpr auto kRequestAt300 = 266'666'666ns, k85CharactersAt300 = 2'833'333'333ns,
                   kGapAt300 = 666'666'666ns;
    EXPECT_EQ(line.time, begun + kRequestAt300 + kTimeout + k85CharactersAt300 + kGapAt300);
    EXPECT_EQ(exchange->trouble(), "an answer that does not end");
}

/// The thread had no processor meanwhile: the drive was there.
TEST_F(EiExchange, JudgesOctetsThatWaitInThePortWhenItComesTooLateToItsOwnWait)
{
    leave_owed(kFirst, kOx);
    line.comes("\x02", 150ms);
    line.comes(value("ox", ">0001").substr(1) + value("ow", ">0002"), 160ms);
    line.no_processor_for = 1s;

    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence) << "it may be a second old";

    EXPECT_EQ(exchange->counts(kFirst).valid_at, line.time);
    EXPECT_EQ(exchange->counts(kFirst).late, 2U);
    leave_owed(kFirst, kOx);
}

TEST_F(EiExchange, ReadsNoMoreThanAPortHoldsWhenItComesTooLateToItsOwnWait)
{
    for (int i = 0; i < 100; ++i) line.comes(std::string(60, '\xFF'), 50ms);
    line.no_processor_for = 1s;

    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);

    std::array<std::uint8_t, 64> buffer{};
    EXPECT_NE(line.read(buffer, 0ns), 0U) << "a line that never stops sending would keep the thread";
}

TEST_F(EiExchange, AsksNothingOnALineThatDoesNotFallSilentForTheTimeOfTwoAnswers)
{
    const Instant begun = line.time;
    for (auto after = 0ms; after < 1s; after += 1ms) line.comes("U", after);

    EXPECT_EQ(exchange->poll(kFirst, kOw), End::damaged);

    EXPECT_EQ(line.time, begun + 2 * 85ms + 20ms + 1ms) << "the first octet behind it";
    EXPECT_EQ(line.sent, "");
    EXPECT_EQ(exchange->trouble(), "noise and no answer: the line is never silent");
}

TEST_F(EiExchange, EndsTheWaitWithTheForeignAnswerThatIsUnderWayAtTheTimeOut)
{
    const Instant begun = line.time;
    line.comes("\x02zz>0", 200ms);
    line.comes(value("zz", ">0000").substr(5), 215ms);

    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);

    EXPECT_EQ(line.time, begun + 215ms);
    EXPECT_EQ(exchange->trouble(), "asked for 'ow', answered for 'zz'");
    EXPECT_EQ(exchange->counts(kFirst).foreign, 1U);
}

TEST_F(EiExchange, WaitsForTheAnswerBehindTheNoiseOfATransceiver)
{
    for (const char noise : {'\0', '\x7F', '\xFF'}) {
        line.comes(std::string(1, noise), 50ms);
        line.comes(value("ow", ">000A"), 180ms);
        EXPECT_EQ(exchange->poll(kFirst, kOw), End::value) << int{noise};
        EXPECT_EQ(exchange->trouble(), "");
        line.time += 1s;
    }
}

TEST_F(EiExchange, SaysThatThereWasOnlyNoise)
{
    const Instant begun = line.time;
    line.comes("\xFF", 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);
    EXPECT_EQ(line.time, begun + kRequest + kTimeout);
    EXPECT_EQ(exchange->trouble(), "noise and no answer");
}

TEST_F(EiExchange, CallsALineThatTakesNoRequestSilent)
{
    line.is_unplugged = true;
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);
    EXPECT_EQ(exchange->trouble(), "the line does not accept the request");
}

// ---- the silence before a question

TEST_F(EiExchange, AsksWhenTheLineHasBeenSilentForAsLongAsThePortHoldsBack)
{
    open(AskedLine::kBaud, {.hold_back = 16ms});
    line.comes("\xFF", 0ms);
    const Instant heard = line.time;
    exchange->poll(kFirst, kOw);
    EXPECT_EQ(line.asked_at, heard + 16ms);
}

TEST_F(EiExchange, AsksAtOnceAfterAQuestionThatStayedWithoutAnswer)
{
    open(AskedLine::kBaud, {.hold_back = 16ms});
    leave_owed(kFirst, kOw);
    const Instant over = line.time;
    exchange->poll(kFirst, kOx);
    EXPECT_EQ(line.asked_at, over);
}

TEST_F(EiExchange, JoinsNothingToWhatBrokeOffBeforeTheQuestion)
{
    line.comes("\x02ox", 0ms);
    line.comes(value("ow", ">000A"), 100ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::value);
}

TEST_F(EiExchange, JoinsNothingToAnAnswerThatBrokeOff)
{
    line.comes("\x02ow>0", 50ms);
    ASSERT_EQ(exchange->poll(kFirst, kOw), End::damaged);
    line.comes(value("ow", ">000A").substr(5), 0ms);
    exchange->listen();
    EXPECT_TRUE(exchange->owes(kFirst, kOw));
}

// ---- what is owed

TEST_F(EiExchange, ADebtSettlesAfterItsTimeTheAnswerOnTheWireAndWhatThePortHoldsBack)
{
    struct Settle {
        std::chrono::nanoseconds settle, hold_back, takes;
    };
    constexpr auto kAnswer = 13ms; // STX C1 C2, 8 of text, ETX BCC
    for (const Settle& one :
         {Settle{0ms, 0ms, 10 * kTimeout}, Settle{500ms, 0ms, 500ms}, Settle{500ms, 16ms, 516ms}}) {
        open(AskedLine::kBaud, {.settle = one.settle, .hold_back = one.hold_back});
        leave_owed(kSecond, kOw);
        line.time = line.asked_at + kRequest + one.takes + kAnswer - 1ns;
        EXPECT_FALSE(exchange->may_poll(kFirst, kOw));
        line.time += 1ns;
        EXPECT_TRUE(exchange->may_poll(kFirst, kOw));
    }
}

TEST_F(EiExchange, TheAnswerToAnOwedWriteTakesOneCharacter)
{
    leave_owed(kSecond, kOw);
    const Instant settles = line.asked_at + kRequest + 10 * kTimeout + 13ms + 1ms;
    ASSERT_EQ(exchange->select(kSecond, kOx, ">0001"), End::silence);
    line.time = settles - 1ns;
    EXPECT_FALSE(exchange->may_poll(kFirst, kOw));
    line.time = settles;
    EXPECT_TRUE(exchange->may_poll(kFirst, kOw));
}

TEST_F(EiExchange, MnemonicsThatShareALetterAreDifferentQuestions)
{
    leave_owed(kSecond, kOw);
    EXPECT_FALSE(exchange->may_poll(kFirst, kOw));
    for (const Mnemonic other : {Mnemonic{'x', 'w'}, Mnemonic{'w', 'w'}, Mnemonic{'o', 'o'}, kOx})
        EXPECT_TRUE(exchange->may_poll(kFirst, other)) << other[0] << other[1];
}

TEST_F(EiExchange, WhatAnotherDriveOwesIsNotAsked)
{
    leave_owed(kSecond, kOw);
    line.sent.clear();
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::not_asked);
    EXPECT_EQ(line.sent, "");
    EXPECT_EQ(exchange->trouble(), "another drive of the line still owes an answer with 'ow'");
}

TEST_F(EiExchange, WhatIsOwedAndWaitsInThePortIsHeardBeforeTheQuestion)
{
    leave_owed(kSecond, kOw);
    line.comes(value("ow", ">000B"), 0ms);
    line.comes(value("ow", ">000A"), 100ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange->answer(), ">000A");
}

TEST_F(EiExchange, AValueThatAnOwedQuestionMayHaveHadIsOlderAndBehindAWriteFromBeforeIt)
{
    leave_owed(kFirst, kOw);
    line.comes(value("ow", ">000A"), 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::older);
    EXPECT_EQ(exchange->answer(), ">000A");
    line.comes("\x06", 50ms);
    ASSERT_EQ(exchange->select(kFirst, kOw, ">000B"), End::ack);
    line.comes(value("ow", ">000C"), 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::before);
    EXPECT_EQ(exchange->answer(), ">000C");
}

// ---- what is said of it

TEST_F(EiExchange, NamesTheMnemonicsWhenALateAnswerCameInsteadOfAValue)
{
    leave_owed(kFirst, kOx);
    line.comes(value("ox", ">00AA"), 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);
    EXPECT_EQ(exchange->trouble(), "asked for 'ow', answered for 'ox'");
    EXPECT_EQ(exchange->counts(kFirst).foreign, 0U) << "it was asked for";
}

TEST_F(EiExchange, NamesNoMnemonicWhenALateAnswerCameInsteadOfAnAck)
{
    leave_owed(kFirst, kOx);
    line.comes(value("ox", ">00AA"), 50ms);
    EXPECT_EQ(exchange->select(kFirst, kOw, ">0001"), End::silence);
    EXPECT_EQ(exchange->trouble(), "noise and no answer");
}

TEST_F(EiExchange, SaysNothingMoreOfATroubleOnceTheAnswerIsThere)
{
    line.comes(value("zz", ">0000"), 50ms);
    line.comes(value("ow", ">000A"), 100ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange->trouble(), "") << "of the foreign answer before it";
    leave_owed(kFirst, kOx);
    line.comes("\x06", 50ms);
    EXPECT_EQ(exchange->select(kFirst, kOw, ">0001"), End::ack);
    EXPECT_EQ(exchange->trouble(), "") << "of the question before it";
}

TEST_F(EiExchange, SaysNothingOfWhatWasDamagedBeforeTheQuestion)
{
    line.comes("\x02ow>000A\x03U", 0ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::silence);
    EXPECT_EQ(exchange->trouble(), "no answer");
}

TEST_F(EiExchange, CountsDamagedAnswersAndThoseOfThemWithAWrongCheckSum)
{
    line.comes("\x02ow>0", 50ms);
    exchange->poll(kFirst, kOw);
    EXPECT_EQ(exchange->counts(kFirst).damaged, 1U);
    EXPECT_EQ(exchange->counts(kFirst).bad_checksum, 0U);
    line.comes("\x02ow>000A\x03U", 50ms);
    exchange->poll(kFirst, kOw);
    EXPECT_EQ(exchange->counts(kFirst).damaged, 2U);
    EXPECT_EQ(exchange->counts(kFirst).bad_checksum, 1U);
}

// ---- several things in one read

TEST_F(EiExchange, AnEotWithSomethingRightBehindItIsARefusalOnlyIfThatIsNoise)
{
    line.comes("\x04\x7F", 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::refused);
    line.comes("\x04U", 50ms);
    EXPECT_EQ(exchange->poll(kFirst, kOw), End::damaged);
    EXPECT_EQ(exchange->trouble(), "characters directly after an EOT, ACK or NAK");
}

TEST_F(EiExchange, WhatComesInOneReadWithTheAnswerIsJudgedAsIfItCameLater)
{
    for (const std::size_t in_one_read : {std::size_t{10}, std::size_t{4}}) {
        leave_owed(kSecond, kOx);
        const std::string late = value("ox", ">00BB");
        line.comes(value("ow", ">000A") + late.substr(0, in_one_read), 50ms);
        EXPECT_EQ(exchange->poll(kFirst, kOw), End::value);
        EXPECT_EQ(exchange->trouble(), "") << "the answer is there";
        if (in_one_read < late.size()) line.comes(late.substr(in_one_read), 1ms);
        line.time += 1ms;
        exchange->listen();
        EXPECT_FALSE(exchange->is_owed(kOx)) << in_one_read;
    }
}

// ---- the echo

TEST_F(EiExchangeWithEcho, ThatComesAfterTheTimeOutIsNoDamage)
{
    line.comes("\x04"
               "0000ow\x05",
               300ms);
    ASSERT_EQ(exchange->poll(kFirst, kOw), End::silence);
    line.time += 1s;
    exchange->listen();
    EXPECT_EQ(exchange->counts(kFirst).damaged, 0U);
}

TEST_F(EiExchangeWithEcho, ALoneEotIsNoneAndTheAckBehindItIsWaitedFor)
{
    line.comes("\x04", 50ms);
    line.comes("\x06", 150ms);
    EXPECT_EQ(exchange->select(kFirst, kOw, ">0001"), End::ack);
    EXPECT_EQ(exchange->counts(kFirst).foreign, 1U) << "an EOT answers no write";
}

} // namespace
} // namespace dpslave::drive::ei
