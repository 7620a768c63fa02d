// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/handover.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

using namespace dpslave;

namespace {

/// Counts those that are alive, and knows in which thread it went.
struct Thing {
    explicit Thing(int n) : number(n), check(n) { ++alive; }
    Thing(const Thing&) = delete;
    Thing& operator=(const Thing&) = delete;
    ~Thing()
    {
        --alive;
        if (std::this_thread::get_id() == forbidden) ++died_at_the_user;
    }
    int number;
    int check; ///< equal to `number`: what is seen is whole
    static inline std::atomic<int> alive{0};
    static inline std::atomic<int> died_at_the_user{0};
    static inline std::thread::id forbidden{};
};

TEST(Handover, HasNothingToTakeBeforeAnOffer)
{
    Handover<Thing> handover;
    auto present = std::make_unique<Thing>(1);

    EXPECT_EQ(handover.offered(), nullptr);
    EXPECT_FALSE(handover.take(present));
    EXPECT_EQ(present->number, 1);
    EXPECT_TRUE(handover.taken());
    EXPECT_EQ(handover.collect(), nullptr);
}

TEST(Handover, ShowsWhatIsOfferedBeforeItIsTaken)
{
    Handover<Thing> handover;
    auto next = std::make_unique<Thing>(2);
    ASSERT_TRUE(handover.offer(next));
    EXPECT_EQ(next, nullptr);

    ASSERT_NE(handover.offered(), nullptr);
    EXPECT_EQ(handover.offered()->number, 2);
    EXPECT_FALSE(handover.taken());
}

TEST(Handover, GivesBackToTheGiverWhatWasNotTakenYet)
{
    Handover<Thing> handover;
    auto present = std::make_unique<Thing>(1), next = std::make_unique<Thing>(2);
    EXPECT_EQ(handover.withdraw(), nullptr) << "nothing was offered";
    ASSERT_TRUE(handover.offer(next));

    next = handover.withdraw();

    ASSERT_NE(next, nullptr);
    EXPECT_EQ(next->number, 2);
    EXPECT_TRUE(handover.taken());
    EXPECT_FALSE(handover.take(present));
    ASSERT_TRUE(handover.offer(next));
    ASSERT_TRUE(handover.take(present));
    EXPECT_EQ(present->number, 2);
    EXPECT_EQ(handover.withdraw(), nullptr) << "it was taken";
}

TEST(Handover, GivesEachOfferToOneOfBothWhenItIsTakenAndWithdrawnAtOnce)
{
    constexpr int kOffers = 20'000;
    Handover<Thing> handover;
    std::atomic<bool> is_over{false};
    int taken = 0;
    std::thread user([&] {
        std::unique_ptr<Thing> present;
        while (!is_over)
            if (handover.take(present)) {
                taken += present->number == present->check ? 1 : 0;
                present.reset();
            }
    });
    int withdrawn = 0;
    for (int i = 0; i < kOffers; ++i) {
        auto next = std::make_unique<Thing>(i);
        while (!handover.offer(next)) handover.collect();
        withdrawn += handover.withdraw() ? 1 : 0;
    }
    while (!handover.taken()) std::this_thread::yield();
    is_over = true;
    user.join();
    EXPECT_EQ(taken + withdrawn, kOffers);
    EXPECT_EQ(Thing::alive, 0);
}

TEST(Handover, GivesBackWhatWasPresent)
{
    Handover<Thing> handover;
    auto present = std::make_unique<Thing>(1), next = std::make_unique<Thing>(2);
    ASSERT_TRUE(handover.offer(next));

    ASSERT_TRUE(handover.take(present));
    EXPECT_EQ(present->number, 2);
    EXPECT_TRUE(handover.taken());
    EXPECT_EQ(handover.offered(), nullptr);
    const auto used_up = handover.collect();
    ASSERT_NE(used_up, nullptr);
    EXPECT_EQ(used_up->number, 1);
    EXPECT_EQ(handover.collect(), nullptr);
}

TEST(Handover, RefusesASecondOfferUntilTheFirstWasTakenAndItsPredecessorCollected)
{
    Handover<Thing> handover;
    auto present = std::make_unique<Thing>(1), next = std::make_unique<Thing>(2);
    ASSERT_TRUE(handover.offer(next));
    auto third = std::make_unique<Thing>(3);

    EXPECT_FALSE(handover.offer(third)); // not taken yet
    ASSERT_NE(third, nullptr);
    handover.take(present);
    EXPECT_FALSE(handover.offer(third)); // not collected yet
    ASSERT_NE(third, nullptr);
    handover.collect();
    EXPECT_TRUE(handover.offer(third));
}

TEST(Handover, LosesNothingAtItsEnd)
{
    const int before = Thing::alive;
    {
        Handover<Thing> handover;
        auto present = std::make_unique<Thing>(1), next = std::make_unique<Thing>(2);
        handover.offer(next);
        handover.take(present);
        auto other = std::make_unique<Thing>(3);
        handover.collect();
        handover.offer(other);
        EXPECT_EQ(Thing::alive, before + 2);
    }

    EXPECT_EQ(Thing::alive, before);
}

TEST(Handover, CrossesThreadsInOrderAndTheUserDestroysNothing)
{
    constexpr int kLast = 2000;
    Handover<Thing> handover;
    Thing::died_at_the_user = 0;
    std::atomic<bool> wrong{false};
    std::unique_ptr<Thing> present = std::make_unique<Thing>(0);
    std::thread user([&] {
        Thing::forbidden = std::this_thread::get_id();
        int last = 0;
        while (last != kLast) {
            if (!handover.take(present)) {
                std::this_thread::yield();
                continue;
            }
            if (present->number != last + 1 || present->check != present->number) wrong = true;
            last = present->number;
        }
        Thing::forbidden = {};
    });
    int collected = 0;
    for (int n = 1; n <= kLast; ++n) {
        auto next = std::make_unique<Thing>(n);
        while (!handover.offer(next)) {
            if (handover.collect()) ++collected;
            std::this_thread::yield();
        }
    }
    user.join();
    while (handover.collect()) ++collected;

    EXPECT_FALSE(wrong);
    EXPECT_EQ(collected, kLast); // 0 to 1999
    EXPECT_EQ(Thing::died_at_the_user, 0);
}

} // namespace
