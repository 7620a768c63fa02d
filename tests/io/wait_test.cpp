// SPDX-License-Identifier: Apache-2.0
/// Tests what threads wait with: clock, epoll, bells and signals.
#include "dpslave/io/clock.hpp"
#include "dpslave/io/epoll.hpp"
#include "dpslave/io/event_fd.hpp"
#include "dpslave/io/realtime.hpp"
#include "dpslave/io/signals.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <system_error>
#include <thread>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::uint64_t> keys(std::span<const epoll_event> events)
{
    std::vector<std::uint64_t> all;
    for (const epoll_event& event : events) all.push_back(event.data.u64);
    return all;
}

TEST(Clock, IsTheMonotonicOneOfTheKernel)
{
    timespec kernel{};
    const Instant before = monotonic_now();
    ::clock_gettime(CLOCK_MONOTONIC, &kernel);
    const Instant after = monotonic_now();

    const Instant between{std::chrono::seconds{kernel.tv_sec} + std::chrono::nanoseconds{kernel.tv_nsec}};
    EXPECT_LE(before, between);
    EXPECT_LE(between, after);
}

TEST(Fd, ClosesWhatItOwnsAndOnlyOnce)
{
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    Fd first{ends[0]};
    Fd second = std::move(first);
    const Fd other{ends[1]};

    EXPECT_FALSE(first); // NOLINT(bugprone-use-after-move): that it is empty is the promise
    EXPECT_EQ(second.get(), ends[0]);
    second.reset();

    EXPECT_FALSE(second);
    EXPECT_EQ(::fcntl(ends[0], F_GETFD), -1);
}

TEST(Fd, KeepsTheReasonOfAFailureWhileCleaningUp)
{
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    Fd first{ends[0]};
    Fd second{ends[1]};
    second.reset();
    ::close(ends[0]); // behind its back: the close() in reset() fails
    errno = ENOENT;

    first.reset();

    EXPECT_EQ(errno, ENOENT);
}

TEST(EventFd, RungIsReadableUntilCleared)
{
    EventFd bell;
    Epoll epoll;
    epoll.add(bell.fd(), EPOLLIN, 7);
    std::array<epoll_event, 4> room{};
    EXPECT_THAT(keys(epoll.wait(room, 0ns)), IsEmpty());

    bell.ring();
    bell.ring();
    EXPECT_THAT(keys(epoll.wait(room, 0ns)), ElementsAre(7));

    bell.clear();
    EXPECT_THAT(keys(epoll.wait(room, 0ns)), IsEmpty());
    bell.clear(); // a bell that is silent may be cleared: it does not wait
}

TEST(EventFd, WakesAnotherThreadThatWaitsForEver)
{
    EventFd bell;
    Epoll epoll;
    epoll.add(bell.fd(), EPOLLIN, 1);
    std::thread ringer{[&bell] { bell.ring(); }};

    std::array<epoll_event, 1> room{};
    const auto ready = epoll.wait(room, std::chrono::nanoseconds::max());

    ringer.join();
    EXPECT_THAT(keys(ready), ElementsAre(1));
}

TEST(Epoll, WaitsNoShorterThanAsked)
{
    Epoll epoll;
    std::array<epoll_event, 1> room{};
    const Instant before = monotonic_now();

    EXPECT_THAT(keys(epoll.wait(room, 300us)), IsEmpty());

    EXPECT_GE(monotonic_now() - before, 300us);
}

TEST(Epoll, ADeadlineThatHasPassedIsNotWaitedFor)
{
    Epoll epoll;
    std::array<epoll_event, 1> room{};

    EXPECT_THAT(keys(epoll.wait(room, -1s)), IsEmpty());
}

TEST(Epoll, ARemovedDescriptorIsNoLongerReported)
{
    EventFd bell;
    Epoll epoll;
    std::array<epoll_event, 4> room{};
    bell.ring();
    epoll.add(bell.fd(), EPOLLIN, 2);
    EXPECT_THAT(keys(epoll.wait(room, 0ns)), ElementsAre(2));

    epoll.remove(bell.fd());
    EXPECT_THAT(keys(epoll.wait(room, 0ns)), IsEmpty());
}

TEST(Epoll, ADescriptorThatCannotBeWaitedForIsAMistakeOfTheProgram)
{
    Epoll epoll;

    EXPECT_THROW(epoll.add(-1, EPOLLIN, 0), std::system_error);
}

TEST(Signals, ComeAsValuesInsteadOfEndingTheProcess)
{
    Signals signals;
    EXPECT_EQ(signals.take(), std::nullopt);

    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        ::raise(signal);
        EXPECT_EQ(signals.take(), signal);
    }
    EXPECT_EQ(signals.take(), std::nullopt);
}

TEST(Signals, AreBlockedInThreadsThatStartLater)
{
    const Signals signals;
    bool blocked = false;

    std::thread{[&blocked] {
        sigset_t mask;
        ::pthread_sigmask(SIG_SETMASK, nullptr, &mask);
        blocked = sigismember(&mask, SIGTERM) == 1;
    }}.join();

    EXPECT_TRUE(blocked);
}

TEST(Signals, APeerThatWentAwayIsAnErrorOfWrite)
{
    const Signals signals;
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    ::close(ends[0]);

    EXPECT_EQ(::write(ends[1], "x", 1), -1);
    EXPECT_EQ(errno, EPIPE);
    ::close(ends[1]);
}

TEST(Realtime, GivesAThreadExactTimersAndItsPriorityOrSaysWhyNot)
{
    std::thread{[] {
        const std::vector<std::string> warnings = enter_realtime(10, 0);

        sched_param param{};
        int policy = 0;
        ::pthread_getschedparam(::pthread_self(), &policy, &param);
        EXPECT_LE(::prctl(PR_GET_TIMERSLACK), 1); // newer kernels say 0 for SCHED_FIFO
        if (warnings.empty()) {
            EXPECT_EQ(policy, SCHED_FIFO);
            EXPECT_EQ(param.sched_priority, 10);
        } else {
            EXPECT_EQ(policy, SCHED_OTHER);
            EXPECT_THAT(warnings, ElementsAre(HasSubstr("LimitRTPRIO=10")));
        }
    }}.join();
}

TEST(Realtime, OrdinarySchedulingNeedsNoRights)
{
    std::thread{[] {
        EXPECT_THAT(enter_realtime(0, -1), IsEmpty());
        EXPECT_EQ(::sched_getscheduler(0), SCHED_OTHER);
    }}.join();
}

TEST(Realtime, AProcessorThatIsNotThereIsAWarningWithAWayOut)
{
    std::thread{[] {
        EXPECT_THAT(enter_realtime(0, 1000), ElementsAre(HasSubstr("not pinned to processor 1000")));
        EXPECT_THAT(enter_realtime(0, 1'000'000), ElementsAre(HasSubstr("set cpu in [realtime]")));
    }}.join();
}

TEST(Realtime, AThreadHasItsName)
{
    std::thread{[] {
        name_thread("bus");

        char name[16] = {};
        ::pthread_getname_np(::pthread_self(), name, sizeof name);
        EXPECT_STREQ(name, "bus");
    }}.join();
}

/// The size of the stack of a thread that starts now, in octets.
std::size_t stack_of_a_new_thread()
{
    std::size_t size = 0;
    std::thread{[&size] {
        pthread_attr_t attributes;
        void* base = nullptr;
        if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return;
        ::pthread_attr_getstack(&attributes, &base, &size);
        ::pthread_attr_destroy(&attributes);
    }}.join();
    return size;
}

#if defined(__SANITIZE_THREAD__) // which puts its own data on each stack
constexpr std::size_t kLargestStack = SIZE_MAX;
#else
constexpr std::size_t kLargestStack = kThreadStack;
#endif

TEST(Realtime, AThreadThatStartsLaterHasASmallStack)
{
    // In a program of its own: a thread may get the stack of an earlier one that has ended, whatever its
    // size.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(
        {
            make_stacks_small();
            const std::size_t size = stack_of_a_new_thread();
            std::fprintf(stderr, "a stack of %zu octets\n", size);
            std::_Exit(size >= kThreadStack / 2 && size <= kLargestStack ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
}

TEST(Realtime, LockedMemoryLeavesRoomForThreadsOrIsNotLocked)
{
    make_stacks_small();
    const std::vector<std::string> warnings = lock_memory();

    EXPECT_THAT(warnings, AnyOf(IsEmpty(), ElementsAre(HasSubstr("LimitMEMLOCK=infinity"))));
    bool ran = false;
    std::thread{[&ran] { ran = true; }}.join();
    EXPECT_TRUE(ran);
}

} // namespace
} // namespace dpslave::io
