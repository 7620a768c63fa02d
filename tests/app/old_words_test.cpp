// SPDX-License-Identifier: Apache-2.0
/// What is shown of a drive while its line stalls.
#include "app/state/old_words.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

using drive::DrivePresence;
using drive::WhenLost;

drive::DriveSnapshot answering()
{
    drive::DriveSnapshot drive;
    drive.known = drive.answers = true;
    drive.presence = DrivePresence::here;
    drive.words[0] = 777;
    drive.states[0] = WordState::good;
    drive.states[1] = WordState::invalid_tag;
    drive.errors[1] = AccessError::invalid_tag;
    drive.watched[0] = {.tag = 9, .word = 5, .state = WordState::good, .repeated = false};
    return drive;
}

TEST(OldWords, AreThoseOfADriveThatDoesNotAnswer)
{
    for (const WhenLost when : {WhenLost::silent, WhenLost::diagnosis, WhenLost::hold}) {
        drive::DriveSnapshot drive = answering();
        make_old(drive, when);
        EXPECT_FALSE(drive.answers);
        EXPECT_EQ(drive.states[0], WordState::stale);
        EXPECT_EQ(drive.errors[0], AccessError::no_answer);
        EXPECT_EQ(drive.words[0], 777) << "what it was is kept";
        EXPECT_EQ(drive.watched[0].state, WordState::stale);
        EXPECT_EQ(drive.states[1], WordState::invalid_tag) << "what was refused was refused";
        EXPECT_EQ(drive.errors[1], AccessError::invalid_tag);
    }
}

TEST(OldWords, AreOfADriveThatIsGoneWhereTheMasterSeesIt)
{
    drive::DriveSnapshot drive = answering();
    make_old(drive, WhenLost::silent);
    EXPECT_EQ(drive.presence, DrivePresence::gone);
    EXPECT_TRUE(drive.away);
    drive = answering();
    make_old(drive, WhenLost::diagnosis);
    EXPECT_EQ(drive.presence, DrivePresence::gone);
    EXPECT_FALSE(drive.away);
    drive = answering();
    make_old(drive, WhenLost::hold);
    EXPECT_EQ(drive.presence, DrivePresence::here);
    EXPECT_FALSE(drive.away);
}

TEST(OldWords, OfADriveThatWasNeverHeardAreKnownToBeNone)
{
    drive::DriveSnapshot drive;
    make_old(drive, WhenLost::hold);
    EXPECT_TRUE(drive.known);
    EXPECT_FALSE(drive.answers);
}

} // namespace
} // namespace dpslave::app
