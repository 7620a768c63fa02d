// SPDX-License-Identifier: Apache-2.0
/// The judgement alone: questions and answers with their times, no line.
#include "dpslave/drive/owed_answers.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using Verdict = OwedAnswers::Verdict;
using Names = OwedAnswers::Names;

constexpr DriveNumber kA = 1, kB = 2;
constexpr Form kM = 0x4D4D, kN = 0x4E4E, kRefusal = 0x8083;
constexpr Instant after(std::chrono::nanoseconds when)
{
    return Instant{} + when;
}

Bytes text(std::string_view what)
{
    return {reinterpret_cast<const std::uint8_t*>(what.data()), what.size()};
}

Question read(DriveNumber drive, Form form)
{
    Question question;
    question.drive = drive;
    question.answer = form;
    return question;
}

Question write(DriveNumber drive, Form written)
{
    Question question;
    question.drive = drive;
    question.is_write = true;
    question.written = written;
    return question;
}

class Owed : public testing::Test {
protected:
    /// Asked, and its wait is over without an answer.
    void loses(const Question& question, std::chrono::nanoseconds when)
    {
        owed.asked(question, after(when));
        owed.wait_is_over();
    }
    OwedAnswers owed{Names::tag, 2s};
};

TEST_F(Owed, AnAnswerToTheQuestionAskedLastIsTaken)
{
    owed.asked(read(kA, kM), after(0s));
    EXPECT_EQ(owed.heard(kM, text("1"), after(20ms)), Verdict::answer);
    EXPECT_TRUE(owed.empty());
}

TEST_F(Owed, AnotherDriveIsNotAskedForWhatOneOwes)
{
    loses(read(kA, kM), 0s);
    EXPECT_FALSE(owed.may_ask(read(kB, kM), after(1s)));
    EXPECT_TRUE(owed.may_ask(read(kB, kN), after(1s)));
    EXPECT_TRUE(owed.may_ask(read(kA, kM), after(1s)))
        << "this drive and this tag: whichever answer comes, it is right";
}

TEST_F(Owed, WhereAnswersDoNotNameTheTagTheSameDriveIsNotAskedEither)
{
    OwedAnswers modbus{Names::drive, 2s};
    modbus.asked(read(kA, kM), after(0s));
    modbus.wait_is_over();
    EXPECT_FALSE(modbus.may_ask(read(kA, kM), after(1s)));
}

TEST_F(Owed, ADebtSettlesAfterItsOwnQuestionAndTheWireTimeOfAll)
{
    Question slow = read(kA, kM);
    slow.wire_time = 100ms;
    loses(slow, 0s);
    slow.answer = kN;
    loses(slow, 1s);
    EXPECT_FALSE(owed.may_ask(read(kB, kM), after(2s + 199ms)));
    EXPECT_TRUE(owed.may_ask(read(kB, kM), after(2s + 200ms)));
    owed.settle(after(2s + 200ms));
    EXPECT_FALSE(owed.may_ask(read(kB, kN), after(3s + 99ms))) << "each has its own time";
    EXPECT_TRUE(owed.may_ask(read(kB, kN), after(3s + 100ms)));
}

TEST_F(Owed, ALateAnswerEndsTheOldestDebtThatItFits)
{
    loses(read(kA, kM), 0s);
    loses(read(kA, kM), 1s);
    owed.asked(read(kB, kN), after(1200ms));
    EXPECT_EQ(owed.heard(kM, text("1"), after(1300ms)), Verdict::owed);
    EXPECT_TRUE(owed.owes(kA, kM)) << "one of the two";
    EXPECT_EQ(owed.counts(kA).late, 1u);
    EXPECT_EQ(owed.counts(kA).delay, 1300ms);
}

TEST_F(Owed, OfEqualAnswersWithoutAQuestionBetweenOnlyTheFirstCounts)
{
    loses(read(kA, kM), 0s);
    loses(read(kA, kM), 1s);
    EXPECT_EQ(owed.heard(kM, text("1"), after(1100ms)), Verdict::owed);
    EXPECT_EQ(owed.heard(kM, text("1"), after(1110ms)), Verdict::duplicate);
    EXPECT_TRUE(owed.owes(kA, kM));
    owed.asked(read(kB, kN), after(1200ms));
    EXPECT_EQ(owed.heard(kM, text("1"), after(1300ms)), Verdict::owed) << "a question lies between";
    EXPECT_FALSE(owed.owes(kA, kM));
}

TEST_F(Owed, AnAnswerThatNothingOwedLooksLikeEndsEveryDebtOfItsDrive)
{
    loses(read(kA, kM), 0s);
    loses(write(kA, kM), 1s);
    loses(read(kB, 0x4242), 1s);
    owed.asked(read(kA, kN), after(1200ms));
    EXPECT_EQ(owed.heard(kN, text("1"), after(1300ms)), Verdict::answer);
    EXPECT_FALSE(owed.owes(kA));
    EXPECT_TRUE(owed.owes(kB)) << "the drives of a line are independent of each other";
}

TEST_F(Owed, WhereTheDriveOwesTheSameTagTheValueIsRightAndOneAnswerStaysOwed)
{
    loses(read(kA, kM), 0s);
    owed.asked(read(kA, kM), after(300ms));
    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::answer_or_older);
    EXPECT_TRUE(owed.owes(kA, kM));
    EXPECT_EQ(owed.heard(kM, text("2"), after(340ms)), Verdict::owed) << "nothing is waited for any more";
}

TEST_F(Owed, AValueThatMayBeOlderThanAWriteOfItsTagIsSaidToBe)
{
    loses(read(kA, kM), 0s);
    owed.asked(write(kA, kM), after(250ms));
    ASSERT_TRUE(owed.take_ack());
    owed.asked(read(kA, kM), after(300ms));
    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::before_write);
}

TEST_F(Owed, AnAckIsTakenWhereNoOtherWriteOfTheLineIsOwed)
{
    owed.asked(write(kA, kM), after(0s));
    EXPECT_TRUE(owed.take_ack());
    loses(write(kA, kM), 1s);
    owed.asked(write(kB, kM), after(1300ms));
    EXPECT_FALSE(owed.take_ack()) << "it may be the late one of A";
    EXPECT_TRUE(owed.owes_write(kA));
    EXPECT_TRUE(owed.owes_write(kB)) << "a doubtful one ends nothing";
}

TEST_F(Owed, WhatWasNotRequestedIsForeign)
{
    owed.asked(read(kA, kM), after(0s));
    EXPECT_EQ(owed.heard(kN, text("1"), after(10ms)), Verdict::foreign);
    EXPECT_TRUE(owed.owes(kA, kM));
}

TEST_F(Owed, AnExceptionIsNotTakenWhereTheDriveOwesAnotherAnswerOfTheFunction)
{
    OwedAnswers modbus{Names::drive, 2s};
    Question first = read(kA, kM), second = read(kA, kN);
    first.refusal = second.refusal = kRefusal;
    modbus.asked(first, after(0s));
    modbus.wait_is_over();
    modbus.asked(second, after(1s));
    EXPECT_EQ(modbus.heard(kRefusal, text("2"), after(1100ms)), Verdict::owed);
    EXPECT_FALSE(modbus.owes(kA, kM)) << "an ambiguous one ends the oldest";
    EXPECT_EQ(modbus.heard(kRefusal, text("3"), after(1200ms)), Verdict::answer);
}

TEST_F(Owed, ADriveThatIsAlwaysLateIsNamedWithTheTimeOutThatItNeeds)
{
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(needed_timeout(owed.counts(kA)), 0ms);
        loses(read(kA, kM), i * 1s);
        EXPECT_EQ(owed.heard(kM, text("1"), after(i * 1s + 400ms)), Verdict::owed);
        owed.asked(read(kB, kN), after(i * 1s + 500ms));
        owed.wait_is_over();
    }
    EXPECT_EQ(needed_timeout(owed.counts(kA)), 500ms);
    owed.asked(read(kA, kM), after(9s));
    EXPECT_EQ(owed.heard(kM, text("1"), after(9100ms)), Verdict::answer);
    EXPECT_EQ(needed_timeout(owed.counts(kA)), 0ms) << "not always";
}

TEST_F(Owed, AWriteOfAnotherDriveOrAnotherTagMakesNoValueOlder)
{
    for (const Question& other : {write(kB, kM), write(kA, kN)}) {
        loses(read(kA, kM), 0s);
        owed.asked(other, after(250ms));
        ASSERT_TRUE(owed.take_ack());
        owed.asked(read(kA, kM), after(300ms));
        EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::answer_or_older);
        owed.clear();
    }
}

TEST_F(Owed, AWriteThatIsAnsweredByALoneOctetOwesNoFrame)
{
    loses(write(kA, kM), 0s);
    EXPECT_TRUE(owed.may_ask(write(kB, kM), after(1s)));
    EXPECT_EQ(owed.heard(kNoForm, text("1"), after(1s)), Verdict::foreign);
    EXPECT_TRUE(owed.owes_write(kA));
}

TEST_F(Owed, TheDelayIsTheLongestOfTheLateAnswersInARow)
{
    const auto is_late_by = [this](std::chrono::milliseconds delay, std::chrono::seconds when) {
        loses(read(kA, kM), when);
        EXPECT_EQ(owed.heard(kM, text("1"), after(when + delay)), Verdict::owed);
    };
    is_late_by(400ms, 1s);
    is_late_by(300ms, 2s);
    EXPECT_EQ(owed.counts(kA).delay, 400ms);

    owed.asked(read(kA, kM), after(3s));
    EXPECT_EQ(owed.heard(kM, text("1"), after(3s + 20ms)), Verdict::answer);
    is_late_by(200ms, 4s);
    EXPECT_EQ(owed.counts(kA).delay, 200ms) << "the row was broken";
}

TEST_F(Owed, BehindTheAnswerThatWasWaitedForAnotherOneIsLate)
{
    loses(read(kB, kN), 0s);
    owed.asked(read(kA, kM), after(1s));
    ASSERT_EQ(owed.heard(kM, text("1"), after(1020ms)), Verdict::answer);

    EXPECT_EQ(owed.heard(kN, text("2"), after(1040ms)), Verdict::owed);
}

TEST_F(Owed, AnAnswerThatMayBeAnotherDrivesIsNotTaken)
{
    loses(read(kA, kM), 0s);
    loses(read(kB, kM), 100ms);
    owed.asked(read(kA, kM), after(300ms));

    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::owed);
    EXPECT_EQ(owed.counts(kA).late, 1u);
}

TEST_F(Owed, WhatAnotherDriveOwesOfAnotherTagDoesNotMatter)
{
    loses(read(kA, kM), 0s);
    loses(read(kB, kN), 100ms);
    owed.asked(read(kA, kM), after(300ms));

    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::answer_or_older);
}

TEST_F(Owed, AnAckIsDoubtfulWhereNoWriteIsWaitedFor)
{
    loses(write(kA, kM), 0s);
    EXPECT_FALSE(owed.take_ack()) << "its wait is over";
    owed.asked(read(kA, kN), after(1s));
    EXPECT_FALSE(owed.take_ack()) << "a read is waited for";

    EXPECT_TRUE(owed.owes_write(kA));
}

TEST_F(Owed, BehindAnAckAnotherAnswerIsLateAndTheDriveIsNot)
{
    loses(read(kA, kM), 0s);
    ASSERT_EQ(owed.heard(kM, text("1"), after(400ms)), Verdict::owed);
    ASSERT_EQ(owed.counts(kA).late_in_a_row, 1u);
    loses(read(kB, kN), 1s);
    owed.asked(write(kA, kM), after(2s));
    ASSERT_TRUE(owed.take_ack());

    EXPECT_EQ(owed.counts(kA).late_in_a_row, 0u);
    EXPECT_EQ(owed.heard(kN, text("2"), after(2100ms)), Verdict::owed);
}

TEST_F(Owed, OfADriveThatWasNeverHeardNothingIsCounted)
{
    EXPECT_EQ(owed.counts(kA), AnswerCounts{});
    owed.foreign(kA);
    EXPECT_EQ(owed.counts(kB), AnswerCounts{});
}

TEST_F(Owed, AValueIsOlderThanAWriteIfAnyOfItsQuestionsIs)
{
    loses(read(kA, kM), 0s);
    owed.asked(write(kA, kM), after(100ms));
    ASSERT_TRUE(owed.take_ack());
    loses(read(kA, kM), 200ms);
    owed.asked(read(kA, kM), after(300ms));

    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::before_write);
}

TEST_F(Owed, AnotherTagThatWasWrittenMeanwhileMakesNoValueOlder)
{
    loses(read(kA, kM), 0s);
    loses(read(kA, kN), 100ms);
    owed.asked(write(kA, kN), after(200ms));
    ASSERT_TRUE(owed.take_ack());
    owed.asked(read(kA, kM), after(300ms));

    EXPECT_EQ(owed.heard(kM, text("1"), after(320ms)), Verdict::answer_or_older);
}

TEST_F(Owed, NothingIsOwedOrWaitedForAfterAllIsForgotten)
{
    owed.asked(write(kA, kM), after(0s));
    owed.heard(kN, text("1"), after(10ms));

    owed.clear();

    EXPECT_TRUE(owed.empty());
    EXPECT_FALSE(owed.owes_write(kA));
    EXPECT_EQ(owed.heard(kN, text("1"), after(20ms)), Verdict::foreign) << "no duplicate";
}

TEST_F(Owed, WhatIsOwedIsAskedByDriveFormAndKind)
{
    Question one = read(kA, kM);
    one.refusal = kRefusal;
    loses(one, 0s);
    loses(write(kB, kN), 0s);

    EXPECT_TRUE(owed.owes(kA));
    EXPECT_TRUE(owed.owes(kA, kM));
    EXPECT_TRUE(owed.owes(kA, kRefusal));
    EXPECT_FALSE(owed.owes(kA, kN));
    EXPECT_FALSE(owed.owes(kB, kM));
    EXPECT_FALSE(owed.owes_write(kA));
    EXPECT_TRUE(owed.owes_write(kB));
    EXPECT_TRUE(owed.is_owed(kM));
    EXPECT_TRUE(owed.is_owed(kRefusal));
    EXPECT_FALSE(owed.is_owed(kN)) << "the write is answered by a lone octet";
    EXPECT_FALSE(owed.owes(3));
}

TEST_F(Owed, SixteenFramesSinceTheLastQuestionAreComparedAndNoMore)
{
    owed.asked(read(kA, kM), after(0s));
    const std::string_view frames = "abcdefghijklmnopq";
    for (std::size_t i = 0; i < frames.size(); ++i)
        EXPECT_EQ(owed.heard(kN, text(frames.substr(i, 1)), after(10ms)), Verdict::foreign);

    EXPECT_EQ(owed.heard(kN, text("p"), after(20ms)), Verdict::duplicate) << "the sixteenth";
    EXPECT_EQ(owed.heard(kN, text("q"), after(20ms)), Verdict::foreign);
}

} // namespace
} // namespace dpslave::drive
