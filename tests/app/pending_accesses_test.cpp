// SPDX-License-Identifier: Apache-2.0
/// Reads and writes of `dpctl` that wait for a drive line. The lines have no thread: the test takes their
/// orders and answers them. The callers are sockets, and the clock is the test's.
#include "app/calls/pending_accesses.hpp"
#include "control/bench.hpp"

#include "dpslave/io/clock.hpp"

#include <gmock/gmock.h>

#include <deque>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using control::Json;
using test::call;
using test::RawCaller;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr std::uint16_t kSpeed = 55;
constexpr auto kLongestWait = 5min;

/// Two stations on line p3 and one on line p4. All have the tag kSpeed.
class PendingAccess : public testing::Test {
protected:
    enum Line : std::size_t { p3, p4 };

    PendingAccess()
    {
        for (const char* const name : {"p3", "p4"}) {
            config::LineConfig line;
            line.name = name;
            lines.push_back(std::make_shared<DriveLine>(std::move(line), config::TraceConfig{}));
        }
        add("unwinder", p3);
        add("winder", p3);
        add("pump", p4);
        monitor.set_config({}); // with the stations that there are now
    }

    /// `name` calls `method`, and whoever reads the reply is the last of `callers`.
    RawCaller& calls(std::string_view method, const std::string& name, std::string_view value = {})
    {
        Json parameters{{"station", name}, {"tag", kSpeed}};
        if (!value.empty()) parameters["value"] = value;
        RawCaller& caller = callers.emplace_back(control.caller());
        caller.write(call(method, parameters.dump()));
        control.settle();
        return caller;
    }
    RawCaller& reads(const std::string& name) { return calls("ReadTag", name); }
    RawCaller& writes(const std::string& name, std::string_view value)
    {
        return calls("WriteTag", name, value);
    }

    /// The numbers of the orders that the line takes.
    std::vector<std::uint32_t> takes(Line line)
    {
        std::vector<std::uint32_t> numbers;
        while (const auto order = lines[line]->link.orders.pop()) numbers.push_back(order->order.number);
        return numbers;
    }
    void answers(Line line, std::uint32_t number, std::uint16_t word)
    {
        EXPECT_TRUE(
            lines[line]->link.answers.push({.number = number, .error = AccessError::none, .word = word}));
        lines[line]->link.order_states.remove(number);
    }
    /// The line sends the order, for the first time or again.
    bool begins(Line line, std::uint32_t number) { return lines[line]->link.order_states.begin(number); }
    bool has_ended(Line line, std::uint32_t number) const
    {
        return lines[line]->link.order_states.has_ended(number);
    }
    /// The line gives no sign.
    void stalls(Line line)
    {
        lines[line]->silent_for = 3s;
        for (Station& station : stations)
            if (station.drive_line == lines[line]) station.line_stalled = 3s;
    }
    void goes_round_again(Line line)
    {
        lines[line]->silent_for = {};
        for (Station& station : stations)
            if (station.drive_line == lines[line]) station.line_stalled = {};
    }

    bool is_answered(RawCaller& caller)
    {
        control.settle();
        const auto octets = caller.read();
        return octets && !octets->empty();
    }
    Json reply(RawCaller& caller) { return control.reply(caller).value(); }
    std::string reason(RawCaller& caller)
    {
        const Json refused = reply(caller);
        EXPECT_EQ(refused.at("error"), "org.dpslaved.Control.DriveRefused");
        return refused.at("parameters").at("reason");
    }
    /// What the log says of the writes.
    std::vector<std::string> told() const
    {
        std::vector<std::string> texts;
        for (const auto& one : events.events()) texts.push_back(one.text);
        return texts;
    }

    std::vector<Station> stations;
    DriveLines lines;
    BusLink bus;
    Monitor monitor{{}, stations, bus};
    RecentEvents events;
    Happenings happenings{events, [](const Happening&, Instant) {}};
    PendingAccesses accesses{monitor, lines, happenings};
    uid_t uid = 0; ///< of those who call from now on
    test::Bench control{methods(), [this](control::ServerSettings& settings) {
                            settings.operator_group = test::kOperators;
                            settings.identify = [this](int) {
                                control::Caller caller;
                                caller.uid = uid;
                                caller.gid = test::kOperators;
                                return caller;
                            };
                        }};
    std::deque<RawCaller> callers;

private:
    void add(const std::string& name, Line line)
    {
        drive::Tag speed;
        speed.number = kSpeed;
        config::StationConfig station;
        station.name = name;
        station.tags = std::make_shared<const drive::TagTable>(std::vector{speed});
        station.profile = std::make_shared<const profile::Profile>();
        Station one;
        one.number = static_cast<std::uint32_t>(stations.size()) + 1;
        one.config = std::make_shared<const config::StationConfig>(std::move(station));
        one.drive_line = lines[line];
        one.line = &lines[line]->config;
        stations.push_back(std::move(one));
    }

    control::Methods methods()
    {
        control::Methods all = test::quiet_methods();
        const auto station = [this](const Json& parameters) -> const Station& {
            return *monitor.find(parameters.at("station").get<std::string_view>());
        };
        all["ReadTag"].answer = [=, this](const Json& parameters, const control::Caller& caller) {
            return accesses.read(station(parameters), parameters, caller);
        };
        all["WriteTag"].answer = [=, this](const Json& parameters, const control::Caller& caller) {
            return accesses.write(station(parameters), parameters, caller);
        };
        return all;
    }
};

TEST_F(PendingAccess, GivesEachCallerItsOwnAnswerInWhateverOrderTheLinesAnswer)
{
    RawCaller& of_unwinder = reads("unwinder");
    RawCaller& of_winder = reads("winder");
    RawCaller& of_pump = reads("pump");
    ASSERT_THAT(takes(p3), ElementsAre(1, 2));
    ASSERT_THAT(takes(p4), ElementsAre(3));

    answers(p4, 3, 33);
    answers(p3, 2, 22);
    answers(p3, 1, 11);
    accesses.answer(io::monotonic_now());

    const Json first = reply(of_unwinder).at("parameters");
    EXPECT_EQ(first.at("station"), "unwinder");
    EXPECT_EQ(first.at("raw"), 11);
    EXPECT_EQ(reply(of_winder).at("parameters").at("raw"), 22);
    EXPECT_EQ(reply(of_pump).at("parameters").at("raw"), 33);
    EXPECT_TRUE(accesses.empty());
}

TEST_F(PendingAccess, OfALineThatAnswersDoesNotEnd)
{
    RawCaller& caller = writes("unwinder", "700");
    accesses.answer(io::monotonic_now());

    EXPECT_FALSE(is_answered(caller));
    EXPECT_FALSE(has_ended(p3, 1));
    EXPECT_FALSE(lines[p3]->link.sign->is_given_up());
}

TEST_F(PendingAccess, OfAStalledLineIsAnsweredAsNotCarriedOutAndNeverBegun)
{
    RawCaller& first = writes("unwinder", "700");
    RawCaller& second = writes("winder", "800");
    stalls(p3);
    accesses.answer(io::monotonic_now());

    for (RawCaller* const caller : {&first, &second})
        EXPECT_EQ(reason(*caller), "line p3 has stalled for 3.0 s: it was not carried out");
    EXPECT_FALSE(begins(p3, 1)) << "nor when it goes round again";
    EXPECT_FALSE(begins(p3, 2));
    EXPECT_TRUE(lines[p3]->link.sign->is_given_up()) << "until then it writes nothing";
    EXPECT_TRUE(accesses.empty());
}

TEST_F(PendingAccess, ThatTheStalledLineHadBegunIsNotKnownToBeDone)
{
    RawCaller& before = writes("unwinder", "600");
    RawCaller& begun = writes("unwinder", "700");
    RawCaller& behind = writes("winder", "800");
    ASSERT_THAT(takes(p3), ElementsAre(1, 2, 3));
    answers(p3, 1, 600);
    ASSERT_TRUE(begins(p3, 2));
    stalls(p3);
    accesses.answer(io::monotonic_now());

    EXPECT_EQ(reply(before).at("parameters").at("raw"), 600) << "its answer had come before";
    EXPECT_THAT(reason(begun), HasSubstr("not known whether it was done"));
    EXPECT_THAT(reason(behind), HasSubstr("it was not carried out"));
    EXPECT_THAT(told(), ElementsAre(AllOf(HasSubstr("unwinder: tag 55 set to 600"), HasSubstr(": done")),
                                    AllOf(HasSubstr("unwinder: tag 55 set to 700"),
                                          HasSubstr("not known whether it was done")),
                                    AllOf(HasSubstr("winder: tag 55 set to 800"),
                                          HasSubstr("it was not carried out"))));
    EXPECT_FALSE(begins(p3, 2)) << "it is not sent again";
}

/// Between a write and the read that proves it the line has other transactions, and behind a silence.
TEST_F(PendingAccess, ThatWasSentAndIsNotProvenWhenTheLineStallsIsNotKnownToBeDone)
{
    RawCaller& written = writes("unwinder", "700");
    ASSERT_TRUE(begins(p3, 1));
    lines[p3]->link.sign->give(io::monotonic_now()); // the transaction is over, and others have come
    stalls(p3);
    accesses.answer(io::monotonic_now());

    EXPECT_EQ(reason(written), "line p3 has stalled for 3.0 s: not known whether it was done");
}

TEST_F(PendingAccess, OfWhichNothingCouldBeSentWasNotCarriedOut)
{
    RawCaller& written = writes("unwinder", "700");
    ASSERT_TRUE(begins(p3, 1));
    lines[p3]->link.order_states.not_sent(1); // as where the port is missing
    stalls(p3);
    accesses.answer(io::monotonic_now());

    EXPECT_THAT(reason(written), HasSubstr("it was not carried out"));
}

TEST_F(PendingAccess, ThatTheLineHasJustAnsweredGetsThatAnswerAlthoughTheLineStalls)
{
    RawCaller& written = writes("unwinder", "700");
    ASSERT_TRUE(begins(p3, 1));
    lines[p3]->link.order_states.remove(1); // its answer comes between the two looks
    stalls(p3);
    accesses.answer(io::monotonic_now());
    EXPECT_FALSE(is_answered(written));

    answers(p3, 1, 700);
    accesses.answer(io::monotonic_now());
    EXPECT_EQ(reply(written).at("parameters").at("raw"), 700);
}

TEST_F(PendingAccess, ThatHasEndedDropsALateAnswerAndTheNextOneHasItsOwn)
{
    RawCaller& late = reads("unwinder");
    ASSERT_THAT(takes(p3), ElementsAre(1));
    ASSERT_TRUE(begins(p3, 1));
    stalls(p3);
    accesses.answer(io::monotonic_now());
    EXPECT_TRUE(is_answered(late));

    goes_round_again(p3);
    RawCaller& next = reads("unwinder");
    ASSERT_THAT(takes(p3), ElementsAre(2)) << "no number is given twice";
    EXPECT_FALSE(has_ended(p3, 2));
    answers(p3, 1, 11);
    accesses.answer(io::monotonic_now());
    EXPECT_FALSE(is_answered(late));
    EXPECT_FALSE(is_answered(next));

    answers(p3, 2, 22);
    accesses.answer(io::monotonic_now());
    EXPECT_EQ(reply(next).at("parameters").at("raw"), 22);
}

TEST_F(PendingAccess, OfAnotherLineGoesOn)
{
    RawCaller& of_unwinder = reads("unwinder");
    RawCaller& of_pump = reads("pump");
    ASSERT_THAT(takes(p4), ElementsAre(2));
    stalls(p3);
    accesses.answer(io::monotonic_now());

    EXPECT_TRUE(is_answered(of_unwinder));
    EXPECT_FALSE(is_answered(of_pump));
    EXPECT_FALSE(has_ended(p4, 2));
    EXPECT_FALSE(lines[p4]->link.sign->is_given_up());
    answers(p4, 2, 22);
    accesses.answer(io::monotonic_now());
    EXPECT_EQ(reply(of_pump).at("parameters").at("raw"), 22);
}

TEST_F(PendingAccess, IsRefusedAtOnceWhileItsLineIsStalled)
{
    stalls(p3);
    RawCaller& caller = writes("unwinder", "700");

    EXPECT_EQ(reason(caller), "line p3 has stalled for 3.0 s");
    EXPECT_THAT(takes(p3), SizeIs(0));
    EXPECT_TRUE(accesses.empty());
}

TEST_F(PendingAccess, EndsAfterFiveMinutesAlthoughItsLineSaysNothing)
{
    const Instant before = io::monotonic_now();
    RawCaller& caller = writes("unwinder", "700");
    const Instant behind = io::monotonic_now();

    accesses.answer(before + kLongestWait - 1ns);
    EXPECT_FALSE(is_answered(caller));
    accesses.answer(behind + kLongestWait);
    EXPECT_EQ(reason(caller), "the drive line has not come to it within 5 minutes: it was not carried out");
    EXPECT_FALSE(begins(p3, 1)) << "and it is not carried out later";
    EXPECT_THAT(told(), ElementsAre(HasSubstr("within 5 minutes: it was not carried out")));
}

TEST_F(PendingAccess, ThatEndsLateEndsNoneThatIsYounger)
{
    reads("unwinder");
    const Instant behind = io::monotonic_now();
    while (io::monotonic_now() == behind) {
    } // the second is due later
    RawCaller& younger = reads("unwinder");
    accesses.answer(behind + kLongestWait);

    EXPECT_TRUE(has_ended(p3, 1));
    EXPECT_FALSE(is_answered(younger));
    ASSERT_THAT(takes(p3), ElementsAre(1, 2));
    answers(p3, 2, 22);
    accesses.answer(behind + kLongestWait);
    EXPECT_EQ(reply(younger).at("parameters").at("raw"), 22);
}

TEST_F(PendingAccess, WhoseCallerGoesBeforeItsTurnIsNotCarriedOut)
{
    RawCaller& caller = writes("unwinder", "700");
    accesses.answer(io::monotonic_now());
    ASSERT_FALSE(has_ended(p3, 1)) << "its caller waits";
    caller.close();
    control.settle();
    accesses.answer(io::monotonic_now());

    EXPECT_FALSE(begins(p3, 1));
    EXPECT_THAT(told(),
                ElementsAre(HasSubstr("its caller has gone before its turn: it was not carried out")));
    EXPECT_TRUE(accesses.empty());
}

TEST_F(PendingAccess, ThatHasBegunWhenItsCallerGoesIsStillToldToTheLog)
{
    RawCaller& caller = writes("unwinder", "700");
    ASSERT_TRUE(begins(p3, 1));
    caller.close();
    control.settle();
    accesses.answer(io::monotonic_now());
    EXPECT_THAT(told(), SizeIs(0));
    answers(p3, 1, 700);
    accesses.answer(io::monotonic_now());

    EXPECT_THAT(told(), ElementsAre(AllOf(HasSubstr("set to 700"), HasSubstr(": done"))));
    EXPECT_TRUE(accesses.empty());
}

TEST_F(PendingAccess, OfAStationThatLeftByAReloadIsRefusedAndNotCarriedOut)
{
    RawCaller& begun = writes("unwinder", "700");
    RawCaller& of_winder = reads("winder");
    RawCaller& waits = writes("unwinder", "701");
    ASSERT_THAT(takes(p3), ElementsAre(1, 2, 3));
    ASSERT_TRUE(begins(p3, 1));
    accesses.refuse({stations.front()});

    EXPECT_THAT(reason(begun), AllOf(HasSubstr("station unwinder has just been changed or removed"),
                                     HasSubstr("not known whether it was done")));
    EXPECT_THAT(reason(waits), HasSubstr("it was not carried out"));
    EXPECT_FALSE(begins(p3, 1));
    EXPECT_FALSE(begins(p3, 3));
    answers(p3, 1, 700);
    answers(p3, 2, 22);
    accesses.answer(io::monotonic_now());
    EXPECT_FALSE(is_answered(begun));
    EXPECT_EQ(reply(of_winder).at("parameters").at("raw"), 22);
}

TEST_F(PendingAccess, AtTheEndOfTheProgramIsNotCarriedOutAndToldAsWhatIsKnown)
{
    for (const char* const value : {"700", "701", "702"}) writes("unwinder", value);
    ASSERT_THAT(takes(p3), ElementsAre(1, 2, 3));
    answers(p3, 1, 700);
    ASSERT_TRUE(begins(p3, 2));
    accesses.end();

    EXPECT_FALSE(begins(p3, 3)) << "between the zeros of the safe state";
    EXPECT_THAT(told(), ElementsAre(HasSubstr(": done"), HasSubstr("not known whether it was done"),
                                    HasSubstr("it was not carried out")));
}

TEST_F(PendingAccess, ThatFindsNoPlaceIsBusyAndTheOthersWait)
{
    for (int i = 0; i < 16; ++i) reads(i % 2 == 0 ? "unwinder" : "pump");
    EXPECT_EQ(reply(reads("unwinder")).at("error"), "org.dpslaved.Control.Busy");
    EXPECT_THAT(takes(p3), SizeIs(8));
    stalls(p3);
    accesses.answer(io::monotonic_now());

    EXPECT_FALSE(is_answered(reads("pump"))) << "what was withdrawn has made room";
    EXPECT_THAT(takes(p4), SizeIs(9));
}

TEST_F(PendingAccess, OfOneUserTakesFourPlacesAtMost)
{
    uid = 1000;
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(is_answered(reads("unwinder")));
    EXPECT_EQ(reply(reads("unwinder")).at("error"), "org.dpslaved.Control.Busy");
    uid = 1001;
    EXPECT_FALSE(is_answered(reads("unwinder")));
}

} // namespace
} // namespace dpslave::app
