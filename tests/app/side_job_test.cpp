// SPDX-License-Identifier: Apache-2.0
#include "app/job/side_job.hpp"

#include <gtest/gtest.h>

#include <atomic>

namespace dpslave::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Work that hangs until the test opens the gate.
class SideJobs : public testing::Test {
protected:
    SideJob::Work hanging()
    {
        return [gate = gate, is_done = &is_done]() -> SideJob::Then {
            gate->wait(false);
            return [is_done] { *is_done = true; };
        };
    }
    void open()
    {
        *gate = true;
        gate->notify_all();
    }

    std::shared_ptr<std::atomic<bool>> gate = std::make_shared<std::atomic<bool>>(false);
    bool is_done = false;
    SideJob job{"test", "the work of a test"};
};

TEST_F(SideJobs, DoThePartOfTheMainThreadWhenTheWorkIsOver)
{
    EXPECT_TRUE(job.is_idle());
    ASSERT_TRUE(job.start(hanging()));
    EXPECT_FALSE(job.start([]() -> SideJob::Then { return {}; })) << "one at a time";
    EXPECT_FALSE(job.wait(milliseconds{0}));
    EXPECT_FALSE(is_done);

    open();

    EXPECT_TRUE(job.wait(seconds{60}));
    EXPECT_TRUE(is_done);
}

TEST_F(SideJobs, GoOnWithThePieceThatFollows)
{
    open();
    ASSERT_TRUE(
        job.start([this]() -> SideJob::Then { return [this] { EXPECT_TRUE(job.start(hanging())); }; }));

    EXPECT_TRUE(job.wait(seconds{60}));

    EXPECT_TRUE(is_done);
}

TEST_F(SideJobs, ThatFailAreOver)
{
    ASSERT_TRUE(job.start([]() -> SideJob::Then { throw std::bad_alloc{}; }));

    EXPECT_TRUE(job.wait(seconds{60}));
}

TEST_F(SideJobs, ThatAreLeftKeepNobody)
{
    {
        SideJob hangs{"test", "the work of a test"};
        ASSERT_TRUE(hangs.start(hanging()));
        hangs.leave();
        EXPECT_TRUE(hangs.is_idle());
        EXPECT_FALSE(hangs.start([]() -> SideJob::Then { return {}; }));
    }
    open();
    EXPECT_FALSE(is_done);
}

} // namespace
} // namespace dpslave::app
