// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

namespace dpslave::control {
namespace {

using test::Bench;
using test::call;
using test::kOperators;

constexpr uid_t kUnprivileged = 65534;

Caller caller_with(uid_t uid, gid_t gid, std::vector<gid_t> groups)
{
    Caller caller;
    caller.uid = uid;
    caller.gid = gid;
    caller.groups = std::move(groups);
    return caller;
}

TEST(OperatorRights, AreRoots)
{
    EXPECT_TRUE(may_operate(caller_with(0, 0, {}), kOperators));
    EXPECT_TRUE(may_operate(caller_with(0, 100, {}), std::nullopt));
}

TEST(OperatorRights, AreThoseOfTheGroupsMembersAsMainOrSupplementaryGroup)
{
    EXPECT_TRUE(may_operate(caller_with(1000, kOperators, {}), kOperators));
    EXPECT_TRUE(may_operate(caller_with(1000, 1000, {20, kOperators, 27}), kOperators));
}

TEST(OperatorRights, AreForNoOtherUser)
{
    EXPECT_FALSE(may_operate(caller_with(1000, 1000, {20, 27}), kOperators));
    EXPECT_FALSE(may_operate(caller_with(1000, 0, {0}), kOperators));
    EXPECT_FALSE(may_operate(Caller{}, kOperators));
}

TEST(OperatorRights, AreOnlyRootsWithoutAGroup)
{
    EXPECT_FALSE(may_operate(caller_with(1000, kOperators, {kOperators}), std::nullopt));
    EXPECT_FALSE(may_operate(Caller{}, std::nullopt));
}

/// In a process of its own: becomes this user, calls, and writes the reply into `pipe`. Never returns.
[[noreturn]] void be_caller(const Bench& bench, const Caller& who, const std::string& octets, int pipe)
{
    if (::setgroups(who.groups.size(), who.groups.data()) != 0 || ::setgid(who.gid) != 0 ||
        ::setuid(who.uid) != 0)
        ::_exit(1);
    test::RawCaller caller{bench.socket};
    ::fcntl(caller.fd(), F_SETFL, 0); // this one may wait
    caller.write(octets);
    caller.close_writing();
    while (const auto part = caller.read())
        if (::write(pipe, part->data(), part->size()) < 0) ::_exit(1);
    ::_exit(0);
}

/// What the server answers to a caller with these ids, whom it knows from the kernel.
Json ask_as(Bench& bench, const Caller& who, const std::string& octets)
{
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe2(pipe.data(), O_NONBLOCK | O_CLOEXEC), 0);
    const pid_t child = ::fork();
    if (child == 0) be_caller(bench, who, octets, pipe[1]);
    ::close(pipe[1]);
    std::string reply;
    const auto ended = [&] {
        std::array<char, 4096> chunk;
        const auto n = ::read(pipe[0], chunk.data(), chunk.size());
        if (n > 0) reply.append(chunk.data(), static_cast<std::size_t>(n));
        return n == 0;
    };
    EXPECT_TRUE(bench.run_until(ended, pipe[0]));
    ::close(pipe[0]);
    ::waitpid(child, nullptr, 0);
    return Json::parse(reply.substr(0, reply.find('\0')), nullptr, false);
}

class KernelsWord : public testing::Test {
protected:
    void SetUp() override
    {
        if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    }
    Bench bench{test::quiet_methods(), [](ServerSettings& s) {
                    s.operator_group = kOperators;
                    s.operator_group_name = "dpslaved";
                }};
    const std::string write = call("WriteTag", R"({"tag":56,"value":"1"})");
    const Json done = Json::parse(R"({"parameters":{}})");
    const Json refused =
        Json::parse(R"({"error":"org.dpslaved.Control.NotPermitted","parameters":{"group":"dpslaved"}})");
};

TEST_F(KernelsWord, LetsNobodyWriteWhereTheDaemonOnlyShows)
{
    bench.server->set_read_only(true);
    const Caller root = caller_with(0, 0, {});
    EXPECT_EQ(ask_as(bench, root, write),
              Json::parse(R"({"error":"org.dpslaved.Control.ReadOnly","parameters":{}})"));
    EXPECT_EQ(ask_as(bench, root, call("Reload")), done) << "it operates, and writes nothing to a drive";
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {}), write), refused);

    bench.server->set_read_only(false);
    EXPECT_EQ(ask_as(bench, root, write), done);
}

TEST_F(KernelsWord, LetsRootWrite)
{
    EXPECT_EQ(ask_as(bench, caller_with(0, 0, {}), write), done);
}

TEST_F(KernelsWord, LetsAMemberBySupplementaryGroupWrite)
{
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {20, kOperators}), write), done);
}

TEST_F(KernelsWord, LetsAMemberByMainGroupWrite)
{
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kOperators, {}), write), done);
}

TEST_F(KernelsWord, CountsForTheGroupThatMayOperateFromNowOn)
{
    constexpr gid_t others = 4343;
    bench.server->set_operators(others, "others");
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, others, {}), write), done);
    EXPECT_NE(ask_as(bench, caller_with(kUnprivileged, kOperators, {}), write), done);
}

TEST_F(KernelsWord, RefusesAnOrdinaryUserAndCountsIt)
{
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {20}), write), refused);
    EXPECT_EQ(bench.server->counters().not_permitted, 1u);
}

TEST_F(KernelsWord, LetsAnOrdinaryUserLook)
{
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {}), call("GetStatus")), done);
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {}), call("ReadTag", R"({"tag":56})")),
              done);
}

TEST_F(KernelsWord, RefusesBeforeItLooksAtTheParameters)
{
    EXPECT_EQ(
        ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {}), call("WriteTag", R"({"nonsense":1})")),
        refused);
}

TEST_F(KernelsWord, KeepsTheLastPlacesForOperators)
{
    std::vector<test::RawCaller> callers;
    for (int i = 0; i < 28; ++i) callers.push_back(bench.caller());
    bench.settle();

    EXPECT_EQ(
        ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {}), call("GetStatus")).value("error", ""),
        "org.dpslaved.Control.Busy");
    EXPECT_EQ(ask_as(bench, caller_with(kUnprivileged, kUnprivileged, {kOperators}), call("GetStatus")),
              done);
}

} // namespace
} // namespace dpslave::control
