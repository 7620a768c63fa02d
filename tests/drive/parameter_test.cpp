// SPDX-License-Identifier: Apache-2.0
/// Tests what is known of the word that a drive holds in a parameter: the table of transitions, row by row,
/// and what an access makes of the record (drive-answers.md, "What is shown while an answer is missing").
#include "drive/parameter.hpp"

#include <gtest/gtest.h>

#include <array>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using enum Knowledge;

constexpr std::array kBefore{unknown, acknowledged, assumed, unproven, held, differs};

/// `after`: what is known after the event, in the order of kBefore.
void expect_row(KnowledgeEvent event, const std::array<Knowledge, 6>& after)
{
    for (std::size_t i = 0; i < kBefore.size(); ++i) {
        Writing writing;
        writing.knowledge = kBefore[i];
        writing.on(event);
        EXPECT_EQ(writing.knowledge, after[i]) << "before: " << static_cast<int>(kBefore[i]);
    }
}

TEST(Knowledge, TheFirstWordOfALayoutIsAssumedOnlyWhereNothingIsKnown)
{
    expect_row(KnowledgeEvent::layout_begins, {assumed, acknowledged, assumed, unproven, held, differs});
}

TEST(Knowledge, WhileAWriteIsUnderWayNothingIsKnown)
{
    expect_row(KnowledgeEvent::sent, {unknown, unknown, unknown, unknown, unknown, unknown});
}

TEST(Knowledge, TheAnswerToASingleWriteAcknowledgesItsWordWhateverWasKnown)
{
    expect_row(KnowledgeEvent::acknowledged,
               {acknowledged, acknowledged, acknowledged, acknowledged, acknowledged, acknowledged});
}

TEST(Knowledge, TheAnswerToABlockProvesNoneOfItsWords)
{
    expect_row(KnowledgeEvent::block_acknowledged,
               {unproven, unproven, unproven, unproven, unproven, unproven});
}

TEST(Knowledge, AReadThatShowsTheWordProvesIt)
{
    expect_row(KnowledgeEvent::seen, {held, held, held, held, held, held});
}

TEST(Knowledge, AReadThatShowsAnotherWordSaysThatItDiffersUnlessAWriteIsOwedAnyway)
{
    expect_row(KnowledgeEvent::another_seen, {unknown, differs, differs, differs, differs, differs});
}

TEST(Knowledge, WhereTheDriveNoLongerGivesTheWordOnlyAnAnswerToASingleWriteIsLeft)
{
    expect_row(KnowledgeEvent::not_given,
               {unknown, acknowledged, unknown, unknown, acknowledged, acknowledged});
}

TEST(Knowledge, OfADriveThatIsBackAndIsReadTheWordIsAssumedUntilTheReadShowsIt)
{
    expect_row(KnowledgeEvent::back_and_read, {unknown, assumed, assumed, assumed, assumed, assumed});
}

TEST(Knowledge, OfADriveThatIsBackAndIsNotReadNothingIsKnown)
{
    expect_row(KnowledgeEvent::back, {unknown, unknown, unknown, unknown, unknown, unknown});
}

// ---- a write

Writing output(std::uint16_t wanted, bool readable)
{
    Writing writing;
    writing.is_output = true;
    writing.readable = readable;
    writing.wanted = wanted;
    return writing;
}

constexpr Instant kNow{10s};

TEST(Writing, IsNotSettledBeforeAnyAnswer)
{
    EXPECT_FALSE(output(5, false).is_settled());
}

TEST(Writing, IsSettledByAnAnswerUntilAnotherWordIsWanted)
{
    Writing writing = output(5, false);
    writing.write_answered(5, AccessError::none, false, kNow);
    EXPECT_TRUE(writing.is_settled());
    EXPECT_EQ(writing.word, 5);
    EXPECT_EQ(writing.updated_at, kNow);
    writing.wanted = 6;
    EXPECT_FALSE(writing.is_settled());
}

TEST(Writing, ThatIsRefusedIsSettledAndKeepsTheWordThatWasTakenLast)
{
    Writing writing = output(5, false);
    writing.write_answered(5, AccessError::none, false, kNow);
    writing.wanted = 99;
    writing.write_answered(99, AccessError::out_of_range, false, kNow + 1s);
    EXPECT_TRUE(writing.is_refused());
    EXPECT_TRUE(writing.is_settled()) << "it is not written over and over";
    EXPECT_EQ(writing.state, WordState::out_of_range);
    EXPECT_EQ(writing.word, 5);
    EXPECT_EQ(writing.updated_at, kNow);
}

TEST(Writing, ThatIsReadBackIsAcceptedThoughItWasRefused)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::out_of_range, false, kNow);
    writing.wanted_seen(kNow + 1s);
    EXPECT_FALSE(writing.is_refused());
    EXPECT_EQ(writing.state, WordState::good);
    EXPECT_EQ(writing.knowledge, held);
}

TEST(Writing, OfATagThatCannotBeWrittenStaysRefusedThoughTheDriveHoldsTheWord)
{
    for (const auto error : {AccessError::read_only, AccessError::invalid_tag, AccessError::unsupported_type,
                             AccessError::contradicted}) {
        Writing writing = output(5, true);
        writing.write_answered(5, error, false, kNow);
        writing.hold(AccessError::no_answer);
        writing.wanted_seen(kNow + 1s);
        EXPECT_TRUE(writing.is_refused()) << static_cast<int>(error);
        EXPECT_EQ(writing.state, state_of(error));
        EXPECT_EQ(writing.failures, 0) << "the read was an answer";
    }
}

TEST(Writing, ThatIsReadBackKeepsTheTimeOfItsAnswer)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::none, false, kNow);
    writing.wanted_seen(kNow + 1s);
    EXPECT_EQ(writing.answered_at, kNow);
    EXPECT_EQ(writing.updated_at, kNow);
    EXPECT_EQ(writing.knowledge, held);
}

TEST(Writing, ThatWasOnlyAssumedHasTheTimeOfTheReadThatShowsIt)
{
    Writing writing = output(5, true);
    writing.layout_begins();
    writing.wanted_seen(kNow);
    EXPECT_EQ(writing.word, 5);
    EXPECT_EQ(writing.answered_at, kNow);
    EXPECT_EQ(writing.updated_at, kNow);
}

TEST(Writing, InABlockIsUnprovenAndAloneItIsAcknowledged)
{
    Writing writing = output(5, false);
    writing.write_answered(5, AccessError::none, true, kNow);
    EXPECT_EQ(writing.knowledge, unproven);
    writing.write_answered(5, AccessError::none, false, kNow);
    EXPECT_EQ(writing.knowledge, acknowledged);
}

TEST(Writing, ThatLostItsAnswerIsProvenByAReadThatShowsTheWord)
{
    Writing writing = output(5, true);
    writing.on(KnowledgeEvent::sent);
    writing.wanted_seen(kNow);
    EXPECT_TRUE(writing.is_settled());
    EXPECT_EQ(writing.word, 5);
    EXPECT_EQ(writing.updated_at, kNow);
}

TEST(Writing, OfTheFirstWordOfALayoutIsAssumedOnlyWhereAReadIsToShowIt)
{
    Writing read = output(5, true);
    read.layout_begins();
    EXPECT_TRUE(read.is_settled());
    Writing not_read = output(5, false);
    not_read.layout_begins();
    EXPECT_FALSE(not_read.is_settled());
}

TEST(Writing, OfTheFirstWordOfALayoutIsMadeWhereTheDriveIsKnownToHoldAnotherOne)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::none, false, kNow);
    writing.wanted = 6;
    writing.layout_begins();
    EXPECT_FALSE(writing.is_settled());
}

TEST(Writing, ToADriveThatIsBackIsMadeAgainUnlessAReadIsToShowTheWord)
{
    Writing not_read = output(5, false);
    not_read.write_answered(5, AccessError::none, false, kNow);
    not_read.drive_returned();
    EXPECT_FALSE(not_read.is_settled());
    Writing read = output(5, true);
    read.write_answered(5, AccessError::none, false, kNow);
    read.drive_returned();
    EXPECT_EQ(read.knowledge, assumed);
}

TEST(Writing, ThatWasRefusedIsMadeAgainToADriveThatIsBack)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::out_of_range, false, kNow);
    writing.drive_returned();
    EXPECT_FALSE(writing.is_refused());
    EXPECT_FALSE(writing.is_settled());
}

TEST(Writing, ThatWasRefusedAsReadOnlyIsAcceptedIfTheDriveThatIsBackHoldsTheWord)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::read_only, false, kNow);
    writing.drive_returned();
    writing.wanted_seen(kNow + 1s);
    EXPECT_FALSE(writing.is_refused());
    EXPECT_EQ(writing.state, WordState::good);
}

TEST(Writing, IsHeldByADriveThatIsBackOnlyWhereTheTagWasDropped)
{
    struct Before {
        AccessError error;
        WordState state;
    };
    for (const Before& one : {Before{AccessError::none, WordState::good},
                              Before{AccessError::out_of_range, WordState::out_of_range},
                              Before{AccessError::invalid_tag, WordState::stale},
                              Before{AccessError::no_scale, WordState::stale}}) {
        Writing writing = output(5, true);
        writing.write_answered(5, one.error, false, kNow);
        writing.drive_returned();
        EXPECT_EQ(writing.state, one.state) << static_cast<int>(one.error);
    }
}

TEST(Writing, AtAnotherPortIsMadeAgainEvenWhereReadsShowTheWord)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::none, false, kNow);
    writing.port_changed();
    EXPECT_FALSE(writing.is_settled());
}

TEST(Writing, ThatWasRefusedIsNotRefusedByTheDriveAtAnotherPort)
{
    Writing writing = output(5, true);
    writing.write_answered(5, AccessError::out_of_range, false, kNow);
    writing.port_changed();
    EXPECT_FALSE(writing.is_refused());
    EXPECT_EQ(writing.state, WordState::stale);
}

// ---- what an error means

TEST(AccessState, IsThatOfItsError)
{
    struct Meaning {
        AccessError error;
        WordState state;
    };
    for (const Meaning& one :
         {Meaning{AccessError::none, WordState::good}, Meaning{AccessError::no_answer, WordState::stale},
          Meaning{AccessError::deferred, WordState::stale},
          Meaning{AccessError::not_understood, WordState::refused},
          Meaning{AccessError::invalid_tag, WordState::invalid_tag},
          Meaning{AccessError::read_only, WordState::read_only},
          Meaning{AccessError::out_of_range, WordState::out_of_range},
          Meaning{AccessError::does_not_fit, WordState::out_of_range},
          Meaning{AccessError::not_stopped, WordState::refused},
          Meaning{AccessError::not_config_mode, WordState::refused},
          Meaning{AccessError::unsupported_type, WordState::refused},
          Meaning{AccessError::value_not_encoded, WordState::out_of_range},
          Meaning{AccessError::no_scale, WordState::unscaled},
          Meaning{AccessError::contradicted, WordState::unscaled},
          Meaning{AccessError::not_kept, WordState::refused}}) {
        AccessState access;
        access.answered(one.error);
        EXPECT_EQ(access.state, one.state) << static_cast<int>(one.error);
        EXPECT_EQ(access.error, one.error);
    }
}

TEST(Reading, IsLeftOutOfTheRoundsWhereTheDriveGivesNoValue)
{
    using enum WordState;
    for (const WordState state : {invalid_tag, read_only, unscaled, refused}) {
        Reading reading;
        reading.state = state;
        EXPECT_TRUE(reading.is_excluded()) << static_cast<int>(state);
    }
    for (const WordState state : {untried, good, stale, out_of_range}) {
        Reading reading;
        reading.state = state;
        EXPECT_FALSE(reading.is_excluded()) << static_cast<int>(state);
    }
}

TEST(Writing, IsDroppedWhereTheDriveHasNoSuchTagOrItsScaleIsNotKnown)
{
    using enum WordState;
    for (const WordState state :
         {untried, good, stale, invalid_tag, read_only, out_of_range, unscaled, refused}) {
        Writing writing;
        writing.state = state;
        EXPECT_EQ(writing.is_dropped(), state == invalid_tag || state == unscaled) << static_cast<int>(state);
    }
}

TEST(DriveParameter, BeginsWithoutAnyUseAndWithoutAnyKnowledge)
{
    const DriveParameter one;
    EXPECT_EQ(one.reading.uses, 0);
    EXPECT_FALSE(one.reading.unscaled);
    EXPECT_FALSE(one.reading.tried);
    EXPECT_EQ(one.reading.failures, 0);
    EXPECT_FALSE(one.writing.is_output);
    EXPECT_FALSE(one.writing.readable);
    EXPECT_EQ(one.writing.parameter, 0U);
    EXPECT_EQ(one.writing.wanted, 0);
    EXPECT_EQ(one.writing.known, 0);
}

// ---- an access without a good answer

TEST(AccessState, IsHeldFromTheFirstAccessOnThatBringsNoAnswer)
{
    AccessState access;
    access.answered(AccessError::none);
    access.hold(AccessError::no_answer);
    EXPECT_EQ(access.state, WordState::stale);
    EXPECT_EQ(access.error, AccessError::no_answer);
    EXPECT_EQ(access.failures, 1);
    access.answered(AccessError::none);
    EXPECT_EQ(access.state, WordState::good);
    EXPECT_EQ(access.failures, 0);
}

TEST(AccessState, ThatIsHeldSaysWhyItWasNotRefreshedLast)
{
    AccessState access;
    access.answered(AccessError::none);
    access.hold(AccessError::no_answer);
    access.hold(AccessError::deferred);
    EXPECT_EQ(access.state, WordState::stale);
    EXPECT_EQ(access.error, AccessError::deferred);
    EXPECT_EQ(access.failures, 2);
}

TEST(AccessState, OfARefusedTagStaysRefusedWhileNoAnswerComes)
{
    AccessState access;
    access.answered(AccessError::invalid_tag);
    access.hold(AccessError::no_answer);
    EXPECT_EQ(access.state, WordState::invalid_tag);
    EXPECT_EQ(access.error, AccessError::invalid_tag);
}

TEST(Reading, OfALostDriveIsHeldUnlessTheTagIsExcluded)
{
    Reading good;
    good.answered(AccessError::none);
    good.drive_lost(true);
    EXPECT_EQ(good.state, WordState::stale);
    EXPECT_TRUE(good.tried);
    Reading excluded;
    excluded.answered(AccessError::invalid_tag);
    excluded.drive_lost(true);
    EXPECT_EQ(excluded.state, WordState::invalid_tag);
}

TEST(Reading, WithoutAScaleIsHeldByALossOnlyWhenTheTableHasTheScaleByNow)
{
    Reading unscaled;
    unscaled.unscaled = true;
    unscaled.answered(AccessError::no_scale);
    unscaled.drive_lost(true);
    EXPECT_EQ(unscaled.state, WordState::unscaled);
    unscaled.unscaled = false;
    unscaled.drive_lost(true);
    EXPECT_EQ(unscaled.state, WordState::stale);
}

} // namespace
} // namespace dpslave::drive
