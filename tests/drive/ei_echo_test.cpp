// SPDX-License-Identifier: Apache-2.0
/// The echo of an EI-ASCII line: what is taken away where one is expected, and what is noticed where none is.
#include "drive/ei/ei_exchange.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace dpslave::drive::ei {
namespace {

/// What the filter leaves of `octets`.
std::string left_of(EchoFilter& filter, const std::string& octets)
{
    std::string out;
    for (const char c : octets) filter.feed(static_cast<std::uint8_t>(c), out);
    return out;
}

TEST(EiEchoFilter, TakesTheFirstCopyOfTheRequestAwayAndHoldsNothingBackBehindIt)
{
    EchoFilter filter{EchoMode::on};
    filter.sent(bytes_of("abc"));
    EXPECT_EQ(left_of(filter, "abc"), "");
    EXPECT_FALSE(filter.withholds());
    EXPECT_EQ(left_of(filter, "abc"), "abc") << "the second one is none";
}

TEST(EiEchoFilter, GivesBackWhatBeganLikeTheEchoAndTakesNoCopyBehindIt)
{
    EchoFilter filter{EchoMode::on};
    filter.sent(bytes_of("abc"));
    EXPECT_EQ(left_of(filter, "abxabc"), "abxabc");
    filter.sent(bytes_of("abc"));
    EXPECT_EQ(left_of(filter, "ab"), "");
    EXPECT_TRUE(filter.withholds());
    std::string out;
    filter.silence(out);
    EXPECT_EQ(out, "ab");
    EXPECT_FALSE(filter.withholds());
    EXPECT_EQ(left_of(filter, "abc"), "abc");
}

TEST(EiEchoFilter, BeginsAnewWithEachRequest)
{
    EchoFilter filter{EchoMode::on};
    filter.sent(bytes_of("abc"));
    left_of(filter, "ab");
    filter.sent(bytes_of("abd"));
    EXPECT_EQ(left_of(filter, "abd!"), "!");
}

TEST(EiEchoFilter, TakesNothingAwayOnALineWithoutEcho)
{
    EchoFilter filter{EchoMode::off};
    filter.sent(bytes_of("abc"));
    EXPECT_EQ(left_of(filter, "abc"), "abc");
}

/// How many requests have come back in `octets`.
int came_back(EchoWatch& watch, const std::string& octets)
{
    int count = 0;
    for (const char c : octets)
        if (watch.feed(static_cast<std::uint8_t>(c))) ++count;
    return count;
}

TEST(EiEchoWatch, NoticesTheRequestThatCameBackOnceForEachCopy)
{
    EchoWatch watch;
    EXPECT_EQ(came_back(watch, "abc"), 0) << "nothing was sent yet";
    watch.sent(bytes_of("abc"));
    EXPECT_EQ(came_back(watch, "noise before it: abcabc"), 2);
    EXPECT_EQ(came_back(watch, "ab, and no more of it"), 0);
}

TEST(EiEchoWatch, NoticesTheRequestBeforeTheLastOneHoweverLongTheyAre)
{
    for (const auto& [before, last] : {std::pair{"abc", "defgh"}, std::pair{"abcdef", "gh"}}) {
        EchoWatch watch;
        watch.sent(bytes_of("older"));
        watch.sent(bytes_of(before));
        came_back(watch, std::string{before}.substr(0, 1));
        watch.sent(bytes_of(last));
        EXPECT_EQ(came_back(watch, std::string{before}.substr(1)), 1) << "its begin came before";
        EXPECT_EQ(came_back(watch, last), 1);
        EXPECT_EQ(came_back(watch, "older"), 0) << "that one is long over";
    }
}

} // namespace
} // namespace dpslave::drive::ei
