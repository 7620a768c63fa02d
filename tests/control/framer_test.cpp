// SPDX-License-Identifier: Apache-2.0
#include "dpslave/control/protocol.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dpslave::control {
namespace {

using namespace std::string_literals;

TEST(Framer, GivesNothingBeforeTheNul)
{
    Framer framer(100);
    framer.feed("{\"a\":");

    EXPECT_FALSE(framer.next()->has_value());
    framer.feed("1}\0"s);
    EXPECT_EQ(framer.next()->value(), "{\"a\":1}");
    EXPECT_FALSE(framer.next()->has_value());
}

TEST(Framer, CutsSeveralMessagesOutOfOneRead)
{
    Framer framer(100);
    framer.feed("one\0two\0\0thr"s);

    EXPECT_EQ(framer.next()->value(), "one");
    EXPECT_EQ(framer.next()->value(), "two");
    EXPECT_EQ(framer.next()->value(), "");
    EXPECT_FALSE(framer.next()->has_value());
    framer.feed("ee\0"s);
    EXPECT_EQ(framer.next()->value(), "three");
}

TEST(Framer, TakesAMessageOctetByOctet)
{
    Framer framer(5);
    for (const char octet : "hello"s) {
        framer.feed({&octet, 1});
        EXPECT_FALSE(framer.next()->has_value());
    }
    framer.feed("\0"s);

    EXPECT_EQ(framer.next()->value(), "hello");
}

TEST(Framer, RefusesAMessageThatIsTooLongWithoutWaitingForItsEnd)
{
    Framer framer(5);
    framer.feed("hello!");

    EXPECT_EQ(framer.next().error(), Flaw::too_long);
}

TEST(Framer, NeverHasRoomForMoreThanOneMessageOfTheLimit)
{
    Framer framer(5);
    EXPECT_EQ(framer.room(), 6u);
    framer.feed("ab\0cde"s);
    EXPECT_EQ(framer.room(), 0u);

    EXPECT_EQ(framer.next()->value(), "ab");
    EXPECT_EQ(framer.room(), 3u);
}

} // namespace
} // namespace dpslave::control
