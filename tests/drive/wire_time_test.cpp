// SPDX-License-Identifier: Apache-2.0
/// The rule of time: what began before the question had left answers nothing.
#include "drive/ei/ei_exchange.hpp"
#include "written_line.hpp"

#include "dpslave/drive/wire_time.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using ei::Exchange;
using End = ei::Exchange::End;

constexpr auto kCharacter = 1ms;
constexpr Instant kAsked{1h};
constexpr UnitAddress kFirst{0, 0}, kSecond{0, 1};
constexpr ei::Mnemonic kOw{'o', 'w'};

TEST(WireTime, AnAnswerBeginsWhenTheQuestionHasLeftOneCharacterAllowedFor)
{
    EXPECT_EQ(answers_from(kAsked, 8, kCharacter), kAsked + 7ms);
}

TEST(WireTime, AFrameHasBegunItsCharactersBeforeItWasReadOrEarlier)
{
    FrameBegin begin{kCharacter};
    EXPECT_EQ(begin.latest(), kNever);
    for (std::size_t behind = 5; behind-- > 0;) begin.octet(kAsked + 20ms, behind);
    EXPECT_EQ(begin.latest(), kAsked + 15ms);
}

TEST(WireTime, OneOctetThatWasReadInTimeShowsTheBeginOfAFrameWhoseRestWasReadLate)
{
    FrameBegin begin{kCharacter};
    begin.octet(kAsked + 5ms, 0);
    begin.octet(kAsked + 500ms, 0);
    EXPECT_EQ(begin.latest(), kAsked + 4ms);
}

TEST(WireTime, IsTakenOnEveryPortButAPtyUnlessTheLineSaysOtherwise)
{
    EXPECT_TRUE(takes_wire_time(WireTime::automatic, false));
    EXPECT_FALSE(takes_wire_time(WireTime::automatic, true));
    EXPECT_TRUE(takes_wire_time(WireTime::yes, true));
    EXPECT_FALSE(takes_wire_time(WireTime::no, false));
}

// ---- on an EI-ASCII line with 1 ms for each character: a poll takes 8 ms, the answers here 10 ms

class LineWithTime final : public test::WrittenLine {
public:
    bool wire_time = true;
    std::chrono::nanoseconds write_waits{}; ///< as where the port switches a driver

    /// All octets come in one read, so long after the next question was written.
    void answers(const std::string& octets, std::chrono::nanoseconds after) { told_.emplace(after, octets); }
    bool write(Bytes octets) override
    {
        EXPECT_FALSE(octets.empty());
        for (const auto& [after, answer] : told_) comes(answer, after);
        told_.clear();
        time += write_waits;
        return true;
    }
    bool takes_wire_time() const override { return wire_time; }

private:
    std::multimap<std::chrono::nanoseconds, std::string> told_;
};

/// STX C1 C2 text ETX BCC: 10 characters.
std::string answer(const std::string& word)
{
    const std::string covered = "ow>" + word + '\x03';
    char sum = 0;
    for (const char c : covered) sum = static_cast<char>(sum ^ c);
    return '\x02' + covered + sum;
}

class RuleOfTime : public testing::Test {
protected:
    explicit RuleOfTime(EchoMode echo = EchoMode::off)
        : exchange(line, EiTiming{.baud = 10'000, .timeout = 200ms, .rules = {.echo = echo}})
    {}
    LineWithTime line;
    Exchange exchange;
};
class RuleOfTimeWithEcho : public RuleOfTime {
protected:
    RuleOfTimeWithEcho() : RuleOfTime(EchoMode::on) {}
};

TEST_F(RuleOfTime, AValueThatBeganBeforeTheQuestionHadLeftIsNotTakenAndTheOneBehindItIs)
{
    line.answers(answer("00BB"), 16ms);
    line.answers(answer("00AA"), 40ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange.answer(), ">00AA");
    EXPECT_EQ(exchange.counts(kFirst).early, 1U);
    EXPECT_EQ(exchange.counts(kFirst).foreign, 0U);
}

TEST_F(RuleOfTime, AValueThatBeganOneCharacterBeforeTheEndIsTaken)
{
    line.answers(answer("00AA"), 17ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange.counts(kFirst).early, 0U);
}

TEST_F(RuleOfTime, AnEarlyValueEndsNoDebt)
{
    ASSERT_EQ(exchange.poll(kSecond, kOw), End::silence);
    line.answers(answer("00BB"), 16ms);
    EXPECT_EQ(exchange.poll(kFirst, {'o', 'x'}), End::silence);
    EXPECT_TRUE(exchange.owes(kSecond, kOw));
}

TEST_F(RuleOfTime, AnEarlyValueMakesNoDuplicateOfTheAnswerThatEqualsIt)
{
    line.answers(answer("00AA"), 16ms);
    line.answers(answer("00AA"), 40ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
}

TEST_F(RuleOfTime, AnEarlyEotOrAckIsNoAnswer)
{
    line.answers("\x04", 6ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::silence);
    line.time += 1h;
    line.answers("\x06", 12ms); // the write takes 14 ms
    EXPECT_EQ(exchange.select(kFirst, kOw, ">00AA"), End::silence);
    EXPECT_EQ(exchange.counts(kFirst).early, 2U);
    line.time += 1h;
    line.answers("\x06", 15ms);
    EXPECT_EQ(exchange.select(kFirst, kOw, ">00AA"), End::ack);
}

TEST_F(RuleOfTime, AnAnswerIsWaitedForAsLongWhereTheWriteItselfWaitsForTheWire)
{
    line.write_waits = 9ms; // the 8 ms of the poll and the release of the driver
    const Instant begun = line.time;
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::silence);
    EXPECT_EQ(line.time, begun + 9ms + 200ms);
}

TEST_F(RuleOfTime, WithoutWireTimeAnAnswerMayComeAtOnce)
{
    line.wire_time = false;
    line.answers(answer("00AA"), 1ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
}

TEST_F(RuleOfTime, APortThatIsOpenedAgainAsAnotherOneHasItsOwnRule)
{
    line.wire_time = false;
    line.answers(answer("00AA"), 1ms);
    ASSERT_EQ(exchange.poll(kFirst, kOw), End::value);
    line.wire_time = true;
    line.time += 1h;
    line.answers(answer("00AA"), 1ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::silence);
}

TEST_F(RuleOfTimeWithEcho, TheEchoBeginsWithTheQuestionAndIsStillTheEcho)
{
    line.answers("\x04"
                 "0000ow\x05",
                 9ms);
    line.answers(answer("00AA"), 40ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange.counts(kFirst).early, 0U);
}

TEST_F(RuleOfTime, CountsNoiseBeforeAnAnswerOnce)
{
    line.answers(std::string(1, '\0') + "\xFF" + answer("00AA"), 40ms);
    EXPECT_EQ(exchange.poll(kFirst, kOw), End::value);
    EXPECT_EQ(exchange.counts(kFirst).noise, 1U);
}

} // namespace
} // namespace dpslave::drive
