// SPDX-License-Identifier: Apache-2.0
// A caller may be slow, dead, noisy or one of too many: no other caller is delayed or refused.
#include "bench.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

namespace dpslave::control {
namespace {

using test::Bench;
using test::call;
using test::message;
using test::quiet_methods;
using test::RawCaller;

Methods large_answers(std::size_t octets)
{
    Methods methods = quiet_methods();
    const Json large = Json::object({{"x", std::string(octets, 'x')}});
    methods["GetStatus"].answer = [large](const Json&, const Caller&) { return Done{large}; };
    methods["Watch"].answer = [large](const Json&, const Caller&) { return Stream{large}; };
    return methods;
}

class MalformedMessage : public testing::TestWithParam<std::string> {};

TEST_P(MalformedMessage, EndsItsConnectionAndNoOther)
{
    Bench bench;
    auto good = bench.caller(), bad = bench.caller();
    bench.settle();

    EXPECT_EQ(bench.ask(bad, GetParam()), std::nullopt);
    EXPECT_EQ(bench.server->counters().malformed, 1u);
    EXPECT_TRUE(bench.ask(good, call("GetStatus"))->contains("parameters"));
}

INSTANTIATE_TEST_SUITE_P(All, MalformedMessage,
                         testing::Values(message("hello"), message(""), message("{}"),
                                         message(R"({"method":"a.B","parameters":3})"), message("\xFF\xFE"),
                                         message(std::string(1000, '[')),
                                         std::string(kMaxCall + 1, ' '))); // and no end in sight

TEST(ControlLimits, ManyOctetsWithoutAnEndAreRefusedAtTheLimit)
{
    Bench bench;
    auto caller = bench.caller();
    const std::string flood(16 * 1024, 'x');

    std::size_t written = 0;
    while (bench.server->counters().malformed == 0 && written < 10 * kMaxCall) {
        written += caller.write(flood);
        bench.settle();
    }

    EXPECT_EQ(bench.server->counters().malformed, 1u);
    EXPECT_LE(written, kMaxCall + 2 * flood.size());
}

TEST(ControlLimits, TheLongestCallIsAnswered)
{
    Bench bench;
    auto caller = bench.caller();
    std::string longest = call("GetStatus");
    longest.insert(longest.size() - 1, std::string(kMaxCall + 1 - longest.size(), ' '));

    std::size_t written = 0;
    ASSERT_TRUE(bench.run_until([&] {
        written += caller.write(std::string_view{longest}.substr(written));
        return written == longest.size();
    }));
    EXPECT_TRUE(bench.reply(caller)->contains("parameters"));
}

TEST(ControlLimits, AStreamThatIsNotReadIsDroppedAtItsBound)
{
    constexpr std::size_t kReply = 100'000;
    ReplyTo watch;
    Methods methods = quiet_methods();
    methods["Watch"].answer = [&watch](const Json&, const Caller& caller) {
        watch = caller.reply_to;
        return Stream{Json::object()};
    };
    Bench bench{methods, [](ServerSettings& s) { s.max_unsent = 3 * kReply; }};
    auto slow = bench.caller();
    slow.write(call("Watch", "{}", R"(,"more":true)"));
    bench.settle();

    int pushed = 0;
    while (watch.send(Json::object({{"x", std::string(kReply, 'x')}}))) ASSERT_LT(++pushed, 100);

    EXPECT_GE(pushed, 2);
    EXPECT_EQ(bench.server->counters().too_slow, 1u);
    EXPECT_EQ(bench.server->clients(), 0u);
    EXPECT_FALSE(watch.is_open());
}

TEST(ControlLimits, ManyCallersThatDoNotReadOccupyNoMoreThanAFewDo)
{
    constexpr std::size_t kReply = 500'000, kOfAll = 2'000'000;
    Bench bench{large_answers(kReply), [](ServerSettings& s) { s.max_unsent_of_all = kOfAll; }};
    std::vector<RawCaller> deaf;
    for (int i = 0; i < 20; ++i) {
        deaf.push_back(bench.caller());
        deaf.back().write(call("GetStatus"));
        bench.settle();
    }

    EXPECT_GE(bench.server->counters().too_slow, 20 - kOfAll / (kReply / 4));
    EXPECT_LE(bench.server->clients(), kOfAll / (kReply / 4)) << "a socket holds some of a reply";
    EXPECT_TRUE(bench.ask("GetVersion").contains("parameters"));
}

TEST(ControlLimits, ACallerThatDoesNotReadIsNotReadFromEither)
{
    Bench bench{large_answers(300'000)};
    auto caller = bench.caller();
    const std::string one = call("GetStatus");
    std::size_t sent = 0;
    for (std::size_t n = one.size(); n == one.size() && sent < 100'000;
         ++sent) { // until the socket takes no more
        bench.settle();
        n = caller.write(one);
    }

    EXPECT_LT(sent, 100'000u);
    EXPECT_LE(bench.server->counters().calls, 3u);
    EXPECT_EQ(bench.server->clients(), 1u);
    EXPECT_TRUE(bench.ask("GetVersion").contains("parameters"));
    for (int i = 0; i < 5; ++i)
        EXPECT_EQ(bench.reply(caller)->at("parameters").at("x").get<std::string>().size(), 300'000u);
}

TEST(ControlLimits, AnAnswerLongerThanAnyClientTakesIsOurFault)
{
    Bench bench{large_answers(kMaxReply)};
    auto caller = bench.caller();

    EXPECT_EQ(bench.ask(caller, call("GetStatus")), std::nullopt);
    EXPECT_EQ(bench.server->counters().handler_failures, 1u);
}

TEST(ControlLimits, ThirtyTwoCallersAreServedAndTheNextGetsBusy)
{
    Bench bench;
    std::vector<RawCaller> callers;
    for (int i = 0; i < 32; ++i) {
        callers.push_back(bench.caller());
        bench.settle();
    }
    for (RawCaller& caller : callers)
        EXPECT_TRUE(bench.ask(caller, call("GetStatus"))->contains("parameters"));
    auto next = bench.caller();

    EXPECT_EQ(bench.reply(next), Json::parse(R"({"error":"org.dpslaved.Control.Busy","parameters":{}})"));
    EXPECT_EQ(bench.reply(next), std::nullopt);
    EXPECT_EQ(bench.server->counters().turned_away, 1u);

    callers.pop_back();
    ASSERT_TRUE(bench.run_until([&] { return bench.server->clients() == 31; }));
    EXPECT_TRUE(bench.ask("GetStatus").contains("parameters"));
}

TEST(ControlLimits, WithoutFreeDescriptorsACallerIsTurnedAwayAndTheServerStaysQuiet)
{
    Bench bench;
    auto first = bench.caller(), second = bench.caller();
    bench.settle();
    auto third = bench.caller(); // waits in the queue of the socket
    rlimit before{};
    ::getrlimit(RLIMIT_NOFILE, &before);
    const int lowest_free = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    ::close(lowest_free);
    rlimit none = before;
    none.rlim_cur = static_cast<rlim_t>(lowest_free);
    ::setrlimit(RLIMIT_NOFILE, &none);

    bench.settle(); // would never end if the waiting caller stayed reported

    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_EQ(bench.server->counters().turned_away, 1u);
    EXPECT_EQ(third.read(), std::nullopt);
    EXPECT_TRUE(bench.ask(first, call("GetStatus"))->contains("parameters"));
    EXPECT_TRUE(bench.ask("GetStatus").contains("parameters"));
}

} // namespace
} // namespace dpslave::control
