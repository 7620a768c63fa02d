// SPDX-License-Identifier: Apache-2.0
// Who has how much of the server: turns in a round, and places.
#include "bench.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <filesystem>

namespace dpslave::control {
namespace {

using test::Bench;
using test::call;
using test::kOperators;
using test::quiet_methods;
using test::RawCaller;

constexpr std::size_t kPlaces = 32, kShare = 8, kKept = 4;

std::string many_calls(int count)
{
    std::string all;
    for (int i = 0; i < count; ++i) all += call("GetStatus");
    return all;
}

/// Each Watch and each WriteTag is added to `waiting`.
Methods methods_that_wait(std::vector<ReplyTo>& waiting)
{
    Methods methods = quiet_methods();
    methods["Watch"].answer = [&waiting](const Json&, const Caller& caller) {
        waiting.push_back(caller.reply_to);
        return Stream{};
    };
    methods["WriteTag"].answer = [&waiting](const Json&, const Caller& caller) {
        waiting.push_back(caller.reply_to);
        return Later{};
    };
    return methods;
}

/// A server that gets the user of each caller from the test.
class Fairness : public testing::Test {
protected:
    RawCaller caller(uid_t uid, gid_t gid = 100)
    {
        who.uid = uid;
        who.gid = gid;
        RawCaller one = bench.caller();
        bench.settle();
        return one;
    }
    std::vector<RawCaller> callers(std::size_t count, uid_t uid, gid_t gid = 100)
    {
        std::vector<RawCaller> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(caller(uid, gid));
        return all;
    }
    bool is_served(RawCaller& one)
    {
        const auto reply = bench.ask(one, call("GetStatus"));
        return reply && reply->contains("parameters") && !reply->contains("error");
    }
    bool was_ended(RawCaller& one)
    {
        for (;;) { // a last word may have come before
            const auto octets = one.read();
            if (!octets) return true;
            if (octets->empty()) return false;
        }
    }
    std::uint64_t calls() const { return bench.server->counters().calls; }

    Caller who;
    std::vector<ReplyTo> waiting;
    Bench bench{methods_that_wait(waiting), [this](ServerSettings& settings) {
                    settings.operator_group = kOperators;
                    settings.identify = [this](int) { return who; };
                }};
};

TEST_F(Fairness, ACallerThatSendsManyCallsAtOnceHasOneAnsweredInEachRound)
{
    RawCaller one = caller(1000);
    one.write(many_calls(50));

    for (std::uint64_t round = 1; round <= 50; ++round) {
        bench.server->on_ready();
        EXPECT_EQ(calls(), round);
    }
}

TEST_F(Fairness, ARoundHasAnEndHoweverManyCallersSendHoweverMuch)
{
    std::vector<RawCaller> all;
    for (uid_t uid = 1000; uid < 1004; ++uid)
        for (RawCaller& one : callers(5, uid)) all.push_back(std::move(one));
    for (RawCaller& one : all) one.write(many_calls(50));

    bench.server->on_ready();

    EXPECT_LE(calls(), kTurnsARound);
    EXPECT_GT(calls(), 0u);
    bench.settle();
    EXPECT_EQ(calls(), 20u * 50u) << "and none is lost";
}

TEST_F(Fairness, ACallerBehindAFloodIsAcceptedWithinAFewRounds)
{
    constexpr std::size_t kFlood = 500;
    std::vector<RawCaller> flood;
    for (std::size_t i = 0; i < kFlood; ++i) flood.push_back(bench.caller()); // none of them waits
    const RawCaller one = bench.caller();

    for (int round = 0; round < 10; ++round) bench.server->on_ready();

    const ServerCounters& counters = bench.server->counters();
    EXPECT_EQ(counters.connections + counters.turned_away, kFlood + 1);
}

TEST_F(Fairness, ACallerWithOneCallDoesNotWaitForThoseWithMany)
{
    std::vector<RawCaller> busy = callers(kShare, 1000);
    RawCaller modest = caller(1001);
    for (RawCaller& one : busy) one.write(many_calls(200));
    for (int i = 0; i < 20; ++i) bench.server->on_ready();
    modest.write(call("GetStatus"));

    for (int i = 0; i < 2; ++i) bench.server->on_ready();

    EXPECT_FALSE(modest.read()->empty());
}

TEST_F(Fairness, CallsBehindOneThatWaitsHaveTheirTurnsAfterIt)
{
    RawCaller one = caller(0);
    one.write(call("WriteTag", R"({"tag":1,"value":"1"})") + many_calls(3));
    bench.settle();
    ASSERT_EQ(calls(), 1u);

    ASSERT_TRUE(waiting.at(0).end(Done{}));
    EXPECT_EQ(calls(), 1u) << "none within the answer to another one";
    bench.settle();

    EXPECT_EQ(calls(), 4u);
}

TEST_F(Fairness, AUserWithAQuarterOfThePlacesLosesTheOneIdleForLongestToTheNext)
{
    std::vector<RawCaller> all = callers(kShare, 1000);
    EXPECT_TRUE(is_served(all[0])); // so that the second one is idle for longest
    RawCaller next = caller(1000);

    EXPECT_EQ(bench.server->clients(), kShare);
    EXPECT_TRUE(was_ended(all[1]));
    EXPECT_TRUE(is_served(all[0]));
    EXPECT_TRUE(is_served(next));
    EXPECT_EQ(bench.server->counters().displaced, 1u);
}

TEST_F(Fairness, HalfCallsAndWatchesAreEndedAsAnyIdleConnection)
{
    std::vector<RawCaller> halves = callers(kShare / 2, 1000), watches = callers(kShare / 2, 1000);
    for (RawCaller& one : halves) one.write(R"({"method":"org.dpslaved.)");
    for (RawCaller& one : watches) one.write(call("Watch", "{}", R"(,"more":true)"));
    bench.settle();

    std::vector<RawCaller> next = callers(kShare, 1000);

    for (RawCaller& one : halves) EXPECT_TRUE(was_ended(one));
    for (RawCaller& one : watches) EXPECT_TRUE(was_ended(one));
    for (RawCaller& one : next) EXPECT_TRUE(is_served(one));
    for (const ReplyTo& watch : waiting) EXPECT_FALSE(watch.is_open());
}

TEST_F(Fairness, AUserNeverDisplacesAnotherOneThatHasLess)
{
    std::vector<RawCaller> other = callers(3, 1001);
    std::vector<RawCaller> many = callers(100, 1000);

    for (RawCaller& one : other) EXPECT_TRUE(is_served(one));
    EXPECT_EQ(bench.server->clients(), kShare + 3);
}

TEST_F(Fairness, AConnectionThatWaitsForItsAnswerIsNotIdle)
{
    std::vector<RawCaller> all = callers(kShare, 1000, kOperators);
    for (RawCaller& one : all) one.write(call("WriteTag", R"({"tag":1,"value":"1"})"));
    bench.settle();
    RawCaller next = caller(1000, kOperators);

    EXPECT_EQ(bench.reply(next)->at("error"), "org.dpslaved.Control.Busy");
    EXPECT_EQ(waiting.size(), kShare);
    for (const ReplyTo& write : waiting) EXPECT_TRUE(write.end(Done{}));
}

TEST_F(Fairness, OfManyUsersThatHoldAllPlacesTheOneWithTheMostMakesRoomForOneThatHasNone)
{
    std::vector<RawCaller> all;
    for (uid_t uid = 1000; uid < 1004; ++uid)
        for (RawCaller& one : callers(kShare, uid)) all.push_back(std::move(one));
    EXPECT_EQ(bench.server->clients(), kPlaces - kKept);

    RawCaller next = caller(1004);

    EXPECT_TRUE(is_served(next));
    EXPECT_EQ(bench.server->clients(), kPlaces - kKept);
}

TEST_F(Fairness, OperatorsHavePlacesThatOthersCannotTake)
{
    std::vector<RawCaller> others;
    for (uid_t uid = 1000; uid < 1040; ++uid)
        for (RawCaller& one : callers(kShare, uid)) others.push_back(std::move(one));

    std::vector<RawCaller> operators = callers(kKept, 2000, kOperators);

    for (RawCaller& one : operators) EXPECT_TRUE(is_served(one));
}

TEST_F(Fairness, RootAlwaysGetsIn)
{
    std::vector<RawCaller> others;
    for (uid_t uid = 1000; uid < 1010; ++uid)
        for (RawCaller& one : callers(kShare, uid, kOperators)) others.push_back(std::move(one));
    ASSERT_EQ(bench.server->clients(), kPlaces);

    std::vector<RawCaller> root = callers(kPlaces, 0);

    for (RawCaller& one : root) EXPECT_TRUE(is_served(one));
    RawCaller next = caller(0);
    EXPECT_EQ(bench.reply(next)->at("error"), "org.dpslaved.Control.Busy")
        << "root is not counted, only bounded";
}

std::size_t open_descriptors()
{
    const std::filesystem::directory_iterator all{"/proc/self/fd"};
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

/// One octet with a descriptor behind it.
void pass_descriptor(int socket, int descriptor, char octet)
{
    iovec data{&octet, 1};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(sizeof(int));
    *reinterpret_cast<int*>(CMSG_DATA(head)) = descriptor;
    ASSERT_EQ(::sendmsg(socket, &message, MSG_NOSIGNAL), 1);
}

TEST_F(Fairness, DescriptorsThatACallerPassesAreNotKept)
{
    RawCaller one = caller(1000);
    const std::size_t before = open_descriptors();

    for (const char octet : call("GetStatus")) pass_descriptor(one.fd(), STDIN_FILENO, octet);
    bench.settle();

    EXPECT_EQ(open_descriptors(), before);
    EXPECT_FALSE(one.read()->empty()) << "and the call is answered";
}

TEST_F(Fairness, AThousandConnectionsOneAfterTheOtherLeaveNothingBehind)
{
    RawCaller other = caller(1001);
    for (int i = 0; i < 1000; ++i) {
        RawCaller one = caller(1000);
        if (i % 3 == 0) one.write("{");
        if (i % 3 == 1) one.close_writing();
    }
    bench.settle();

    EXPECT_EQ(bench.server->clients(), 1u);
    EXPECT_TRUE(is_served(other));
}

} // namespace
} // namespace dpslave::control
