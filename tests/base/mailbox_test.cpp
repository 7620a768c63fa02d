// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/mailbox.hpp"

#include <gtest/gtest.h>

#include <thread>

using namespace dpslave;

namespace {

/// Large enough that a copy takes many instructions; all words are equal in every value that is published.
struct Page {
    std::array<std::uint64_t, 64> words{};
};
Page page(std::uint64_t number)
{
    Page p;
    p.words.fill(number);
    return p;
}

TEST(Mailbox, HoldsADefaultBeforeTheFirstPublication)
{
    Mailbox<int> mailbox;

    EXPECT_FALSE(mailbox.fresh());
    EXPECT_EQ(mailbox.latest(), 0);
}

TEST(Mailbox, NewestWins)
{
    Mailbox<int> mailbox;
    for (int i = 1; i <= 7; ++i) mailbox.publish(i);

    EXPECT_TRUE(mailbox.fresh());
    EXPECT_EQ(mailbox.latest(), 7);
    EXPECT_FALSE(mailbox.fresh());
}

TEST(Mailbox, LastValueStaysUntilThereIsANewerOne)
{
    Mailbox<int> mailbox;
    mailbox.publish(3);

    EXPECT_EQ(mailbox.latest(), 3);
    EXPECT_EQ(mailbox.latest(), 3);
    mailbox.publish(4);
    EXPECT_EQ(mailbox.latest(), 4);
}

TEST(Mailbox, ValueInTheReadersHandIsNotTouchedByPublications)
{
    Mailbox<int> mailbox;
    mailbox.publish(1);
    const int& held = mailbox.latest();
    for (int i = 2; i < 10; ++i) mailbox.publish(i);

    EXPECT_EQ(held, 1);
    EXPECT_EQ(mailbox.latest(), 9);
}

TEST(Mailbox, ValuesAreNeverTornAndNeverGoBackBetweenTwoThreads)
{
    constexpr std::uint64_t kLast = 200'000;
    Mailbox<Page> mailbox;
    std::thread writer{[&] {
        for (std::uint64_t i = 1; i <= kLast; ++i) mailbox.publish(page(i));
    }};
    std::uint64_t newest = 0;
    std::uint64_t torn = 0;
    std::uint64_t back = 0;
    while (newest < kLast) {
        const Page& p = mailbox.latest();
        const std::uint64_t number = p.words[0];
        for (const std::uint64_t word : p.words) torn += word != number ? 1u : 0u;
        back += number < newest ? 1u : 0u;
        newest = number;
    }
    writer.join();

    EXPECT_EQ(torn, 0u);
    EXPECT_EQ(back, 0u);
}

} // namespace
