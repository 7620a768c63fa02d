// SPDX-License-Identifier: Apache-2.0
#include "dpctl/trace/trace_gaps.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;

TEST(LossesBefore, AreNoneWithoutALoss)
{
    EXPECT_THAT(losses_before({}, 0), ElementsAre());
    EXPECT_THAT(losses_before({7, 8, 9}, 0), ElementsAre(0, 0, 0));
}

TEST(LossesBefore, OfAReaderThatWasStoppedAreBeforeTheFirstRecord)
{
    EXPECT_THAT(losses_before({107, 108, 109}, 100), ElementsAre(100, 0, 0));
}

TEST(LossesBefore, OfAReaderThatWasOvertakenAreWhereTheNumbersGoOnHigher)
{
    EXPECT_THAT(losses_before({7, 8, 12, 13, 20}, 9), ElementsAre(0, 0, 3, 0, 6));
    EXPECT_THAT(losses_before({107, 108, 112}, 103), ElementsAre(100, 0, 3));
}

TEST(LossesBefore, AreNeverMoreThanTheDaemonCounted)
{
    EXPECT_THAT(losses_before({7, 1'000'000}, 5), ElementsAre(0, 5));
    EXPECT_THAT(losses_before({7, 7, 3}, 5), ElementsAre(5, 0, 0)) << "numbers that make no sense";
}

} // namespace
} // namespace dpslave::dpctl
