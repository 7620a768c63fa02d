// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"
#include "control/interface.hpp"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

namespace dpslave::control {
namespace {

using test::Bench;
using test::call;
using test::message;
using test::quiet_methods;

Json json(const char* text)
{
    return Json::parse(text);
}

/// ReadTag waits for its answer, by its tag; Watch is a stream; GetStatus counts its calls.
struct Application {
    Methods methods()
    {
        Methods all = quiet_methods();
        all["GetStatus"].answer = [this](const Json&, const Caller&) {
            return Done{Json::object({{"n", ++calls}})};
        };
        all["ReadTag"].answer = [this](const Json& parameters, const Caller& caller) {
            reads[parameters["tag"].get<int>()] = caller.reply_to;
            return Later{};
        };
        all["Watch"].answer = [this](const Json&, const Caller& caller) {
            more = caller.more;
            watch = caller.reply_to;
            return Stream{Json::object({{"n", 0}})};
        };
        return all;
    }
    int calls = 0;
    bool more = false;
    std::map<int, ReplyTo> reads;
    ReplyTo watch;
};

class ControlServer : public testing::Test {
protected:
    Application application;
    Bench bench{application.methods()};
};

TEST_F(ControlServer, AnswersACallWithTheHandlersParameters)
{
    auto caller = bench.caller();

    EXPECT_EQ(bench.ask(caller, call("GetStatus")), json(R"({"parameters":{"n":1}})"));
}

TEST_F(ControlServer, AnswersCallsOfOneConnectionInTheirOrder)
{
    auto caller = bench.caller();
    caller.write(call("GetStatus") + call("GetVersion") + call("GetStatus"));

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":1}})"));
    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{}})"));
    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":2}})"));
}

TEST_F(ControlServer, PutsACallTogetherThatComesInPieces)
{
    auto caller = bench.caller();
    for (const char octet : call("GetStatus")) {
        caller.write({&octet, 1});
        bench.settle();
    }

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":1}})"));
}

TEST_F(ControlServer, SendsNothingToAOnewayCall)
{
    auto caller = bench.caller();
    caller.write(call("GetStatus", "{}", R"(,"oneway":true)") + call("GetStatus"));

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":2}})"));
}

TEST_F(ControlServer, StillDoesTheOnewayCallOfACallerThatHasGone)
{
    auto caller = bench.caller();
    caller.write(call("GetStatus", "{}", R"(,"oneway":true)"));
    caller.close();

    EXPECT_TRUE(bench.run_until([&] { return application.calls == 1 && bench.server->clients() == 0; }));
}

TEST_F(ControlServer, StillAnswersACallerThatHasClosedItsWritingSide)
{
    auto caller = bench.caller();
    caller.write(call("GetStatus") + call("ReadTag", R"({"tag":7})"));
    caller.close_writing();

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":1}})"));
    bench.settle();
    EXPECT_TRUE(application.reads[7].end(Done{}));
    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{}})"));
    EXPECT_EQ(bench.reply(caller), std::nullopt);
}

// ---------------------------------------------------------------- org.varlink.service

TEST_F(ControlServer, ListsItsInterfaces)
{
    auto caller = bench.caller();

    const auto reply = bench.ask(caller, message(R"({"method":"org.varlink.service.GetInfo"})"));

    EXPECT_EQ(
        reply,
        json(
            R"({"parameters":{"vendor":"dpslaved","product":"dpslaved","version":"9.8.7","url":"file:///doc/README.md",
                              "interfaces":["org.varlink.service","org.dpslaved.Control"]}})"));
}

TEST_F(ControlServer, ReturnsTheDescriptionOfAnInterface)
{
    auto caller = bench.caller();

    const auto reply = bench.ask(
        caller,
        message(
            R"({"method":"org.varlink.service.GetInterfaceDescription","parameters":{"interface":"org.dpslaved.Control"}})"));

    const auto read = parse_interface(reply->at("parameters").at("description").get<std::string>());
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(read->methods.size(), quiet_methods().size());
}

struct Wrong {
    const char* name;
    const char* call;
    const char* reply;
};
class WrongCall : public testing::TestWithParam<Wrong> {};

TEST_P(WrongCall, GetsTheErrorOfTheStandardAndKeepsItsConnection)
{
    Bench bench;
    auto caller = bench.caller();

    EXPECT_EQ(bench.ask(caller, message(GetParam().call)), json(GetParam().reply));
    EXPECT_EQ(bench.server->counters().errors, 1u);
    EXPECT_EQ(bench.ask(caller, call("GetStatus")), json(R"({"parameters":{}})"));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongCall,
    testing::Values(
        Wrong{
            "Interface", R"({"method":"org.example.GetStatus"})",
            R"({"error":"org.varlink.service.InterfaceNotFound","parameters":{"interface":"org.example"}})"},
        Wrong{
            "Method", R"({"method":"org.dpslaved.Control.Explode"})",
            R"({"error":"org.varlink.service.MethodNotFound","parameters":{"method":"org.dpslaved.Control.Explode"}})"},
        Wrong{
            "ServiceMethod", R"({"method":"org.varlink.service.GetStatus"})",
            R"({"error":"org.varlink.service.MethodNotFound","parameters":{"method":"org.varlink.service.GetStatus"}})"},
        Wrong{
            "Description",
            R"({"method":"org.varlink.service.GetInterfaceDescription","parameters":{"interface":"org.example"}})",
            R"({"error":"org.varlink.service.InterfaceNotFound","parameters":{"interface":"org.example"}})"},
        Wrong{"UnknownParameter",
              R"({"method":"org.dpslaved.Control.GetStatus","parameters":{"verbose":true}})",
              R"({"error":"org.varlink.service.InvalidParameter","parameters":{"parameter":"verbose"}})"},
        Wrong{"MissingParameter", R"({"method":"org.dpslaved.Control.ReadTag"})",
              R"({"error":"org.varlink.service.InvalidParameter","parameters":{"parameter":"tag"}})"},
        Wrong{"ParameterOfAWrongType",
              R"({"method":"org.dpslaved.Control.GetIo","parameters":{"station":5}})",
              R"({"error":"org.varlink.service.InvalidParameter","parameters":{"parameter":"station"}})"},
        Wrong{
            "Upgrade", R"({"method":"org.dpslaved.Control.GetStatus","upgrade":true})",
            R"({"error":"org.varlink.service.MethodNotImplemented","parameters":{"method":"org.dpslaved.Control.GetStatus"}})"}),
    [](const auto& row) { return row.param.name; });

TEST_F(ControlServer, ShowsAHandlerNoNullParameters)
{
    Json seen;
    Methods methods = quiet_methods();
    methods["GetIo"].answer = [&seen](const Json& parameters, const Caller&) {
        seen = parameters;
        return Done{};
    };
    Bench own{methods};

    own.ask("GetIo", R"({"station":null})");

    EXPECT_EQ(seen, Json::object());
}

// ---------------------------------------------------------------- answers that come later

TEST_F(ControlServer, AnswersLaterWhenTheApplicationHasTheAnswer)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":56})"));
    bench.settle();
    EXPECT_EQ(caller.read(), "");

    EXPECT_TRUE(application.reads[56].end(Done{json(R"({"raw":7})")}));

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"raw":7}})"));
}

TEST_F(ControlServer, AnswersLaterWithAnErrorToo)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":56})"));
    bench.settle();

    application.reads[56].end(Error{"DriveRefused", json(R"({"tag":56})")});

    EXPECT_EQ(bench.reply(caller),
              json(R"({"error":"org.dpslaved.Control.DriveRefused","parameters":{"tag":56}})"));
}

TEST_F(ControlServer, ServesOthersWhileOneWaits)
{
    auto waiting = bench.caller();
    waiting.write(call("ReadTag", R"({"tag":1})"));
    bench.settle();

    EXPECT_EQ(bench.ask("GetStatus"), json(R"({"parameters":{"n":1}})"));
}

TEST_F(ControlServer, LeavesFurtherCallsOfAWaitingCallerForAfterwards)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":1})") + call("GetStatus"));
    bench.settle();
    EXPECT_EQ(application.calls, 0);

    application.reads[1].end(Done{});

    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{}})"));
    EXPECT_EQ(bench.reply(caller), json(R"({"parameters":{"n":1}})"));
}

TEST_F(ControlServer, ToleratesThatTheWaitingCallerHasGone)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":1})"));
    bench.settle();
    caller.close();

    EXPECT_TRUE(bench.run_until([&] { return bench.server->clients() == 0; }));
    EXPECT_FALSE(application.reads[1].end(Done{}));
}

TEST_F(ControlServer, CompletesOnceAndOnlyWhatWasPromised)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":1})"));
    bench.settle();

    EXPECT_FALSE(application.reads[2].end(Done{}));
    EXPECT_FALSE(application.reads[1].send(Json::object())) << "it is no stream";
    EXPECT_TRUE(application.reads[1].end(Done{}));
    EXPECT_FALSE(application.reads[1].end(Done{}));
}

TEST_F(ControlServer, AnswersEachOfTwoCallsThatWait)
{
    auto first = bench.caller(), second = bench.caller();
    first.write(call("ReadTag", R"({"tag":1})"));
    second.write(call("ReadTag", R"({"tag":2})"));
    bench.settle();

    EXPECT_TRUE(application.reads[2].end(Done{json(R"({"raw":2})")}));
    EXPECT_TRUE(application.reads[1].end(Done{json(R"({"raw":1})")}));
    EXPECT_EQ(bench.reply(first), json(R"({"parameters":{"raw":1}})"));
    EXPECT_EQ(bench.reply(second), json(R"({"parameters":{"raw":2}})"));
}

TEST_F(ControlServer, LeavesNobodyToAnswerWhenItEnds)
{
    auto caller = bench.caller();
    bench.ask(caller, call("Watch", "{}", R"(,"more":true)"));
    bench.server.reset();

    EXPECT_FALSE(application.watch.is_open());
    EXPECT_FALSE(application.watch.send(Json::object()));
    EXPECT_EQ(application.watch.unsent(), 0u);
    EXPECT_FALSE(application.watch.end(Done{}));
}

TEST_F(ControlServer, HasNobodyToAnswerLaterOfAOnewayCall)
{
    auto caller = bench.caller();
    caller.write(call("ReadTag", R"({"tag":1})", R"(,"oneway":true)"));
    bench.settle();

    EXPECT_FALSE(application.reads[1].is_open());
    EXPECT_FALSE(application.reads[1].end(Done{}));
}

// ---------------------------------------------------------------- streams

TEST_F(ControlServer, StreamsRepliesThatContinue)
{
    auto caller = bench.caller();
    EXPECT_EQ(bench.ask(caller, call("Watch", "{}", R"(,"more":true)")),
              json(R"({"continues":true,"parameters":{"n":0}})"));
    EXPECT_TRUE(application.more);
    EXPECT_TRUE(application.watch.is_open());

    EXPECT_TRUE(application.watch.send(json(R"({"n":1})")));
    EXPECT_TRUE(application.watch.send(json(R"({"n":2})")));

    EXPECT_EQ(bench.reply(caller), json(R"({"continues":true,"parameters":{"n":1}})"));
    EXPECT_EQ(bench.reply(caller), json(R"({"continues":true,"parameters":{"n":2}})"));
}

TEST_F(ControlServer, StreamsOneReplyToACallerThatDidNotAskForMore)
{
    auto caller = bench.caller();

    EXPECT_EQ(bench.ask(caller, call("Watch")), json(R"({"parameters":{"n":0}})"));
    EXPECT_FALSE(application.more);
    EXPECT_FALSE(application.watch.send(Json::object()));
}

TEST_F(ControlServer, EndsAStreamWithAnErrorAndTakesTheNextCall)
{
    auto caller = bench.caller();
    bench.ask(caller, call("Watch", "{}", R"(,"more":true)"));

    EXPECT_TRUE(application.watch.end(Error{"NoSuchStation", json(R"({"station":"5","known":[]})")}));
    EXPECT_EQ(
        bench.reply(caller),
        json(R"({"error":"org.dpslaved.Control.NoSuchStation","parameters":{"station":"5","known":[]}})"));
    EXPECT_FALSE(application.watch.is_open());
    EXPECT_FALSE(application.watch.end(Error{"Busy", Json::object()}));
    EXPECT_EQ(bench.ask(caller, call("GetStatus")), json(R"({"parameters":{"n":1}})"));
}

TEST_F(ControlServer, EndsAStreamWhenItsCallerGoes)
{
    auto caller = bench.caller();
    bench.ask(caller, call("Watch", "{}", R"(,"more":true)"));
    caller.close();

    EXPECT_TRUE(bench.run_until([&] { return bench.server->clients() == 0; }));
    EXPECT_FALSE(application.watch.is_open());
    EXPECT_FALSE(application.watch.send(Json::object()));
}

// ---------------------------------------------------------------- the server itself

TEST(ControlServerOpen, RequiresAHandlerForEachMethodAndNoOther)
{
    Methods missing = quiet_methods(), surplus = quiet_methods();
    missing.erase("GetLeds");
    surplus["Explode"] = surplus["GetLeds"];
    ServerSettings settings;
    settings.socket = "/nonexistent/control.sock";

    EXPECT_EQ(Server::open(settings, missing).error(), "the method GetLeds has no handler");
    EXPECT_EQ(Server::open(settings, surplus).error(), "a handler has no method");
}

TEST_F(ControlServer, EndsTheConnectionWhenAHandlerFailsAndServesOn)
{
    Methods methods = quiet_methods();
    methods["GetIo"].answer = [](const Json&, const Caller&) -> Reply {
        throw std::runtime_error("a fault");
    };
    Bench own{methods};
    auto caller = own.caller();

    EXPECT_EQ(own.ask(caller, call("GetIo")), std::nullopt);
    EXPECT_EQ(own.server->counters().handler_failures, 1u);
    EXPECT_EQ(own.ask("GetStatus"), json(R"({"parameters":{}})"));
}

TEST_F(ControlServer, CountsWhatItDoes)
{
    bench.ask("GetStatus");
    bench.ask("Explode");

    const ServerCounters& counters = bench.server->counters();
    EXPECT_EQ(counters.connections, 2u);
    EXPECT_EQ(counters.calls, 2u);
    EXPECT_EQ(counters.errors, 1u);
}

} // namespace
} // namespace dpslave::control
