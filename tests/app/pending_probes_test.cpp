// SPDX-License-Identifier: Apache-2.0
/// Searches for a drive that wait for their line. The line has no thread: the test takes its orders and
/// reports. The callers are sockets.
#include "app/calls/pending_probes.hpp"
#include "control/bench.hpp"

#include "dpslave/io/clock.hpp"

#include <gmock/gmock.h>

#include <deque>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using control::Json;
using test::RawCaller;

/// One station on line p3.
class PendingProbe : public testing::Test {
protected:
    PendingProbe()
    {
        config::LineConfig config;
        config.name = "p3";
        config.protocol = config::kEiAscii;
        line = std::make_shared<DriveLine>(std::move(config), config::TraceConfig{});
        config::StationConfig station;
        station.name = "unwinder";
        station.profile = std::make_shared<const profile::Profile>();
        Station one;
        one.number = 1;
        one.config = std::make_shared<const config::StationConfig>(std::move(station));
        one.drive_line = line;
        one.line = &line->config;
        stations.push_back(std::move(one));
        lines.push_back(line);
        monitor.set_config({});
    }

    RawCaller& searches()
    {
        RawCaller& caller = callers.emplace_back(control.caller());
        caller.write(test::call("ProbeDrive", R"({"station": "unwinder"})"));
        control.settle();
        return caller;
    }
    /// The number of the next order that the line takes, if it has to carry it out.
    std::uint32_t begins()
    {
        const auto order = line->link.probes.pop();
        return order && line->link.probe_states.begin(order->number) ? order->number : 0;
    }
    void reports(std::uint32_t number)
    {
        EXPECT_TRUE(line->link.probe_reports.push({.number = number, .tried = 7}));
        line->link.probe_states.remove(number);
    }
    void stalls()
    {
        line->silent_for = 3s;
        stations.front().line_stalled = 3s;
    }
    std::string why_ended(RawCaller& caller)
    {
        const Json reply = control.reply(caller).value();
        EXPECT_EQ(reply.at("error"), "org.dpslaved.Control.ProbeEnded");
        return reply.at("parameters").at("reason");
    }

    std::vector<Station> stations;
    std::shared_ptr<DriveLine> line;
    DriveLines lines;
    BusLink bus;
    Monitor monitor{{}, stations, bus};
    PendingProbes probes{monitor, lines};
    test::Bench control{methods(), [](control::ServerSettings& settings) {
                            settings.operator_group = test::kOperators;
                            settings.identify = [](int) {
                                control::Caller caller;
                                caller.uid = 0;
                                return caller;
                            };
                        }};
    std::deque<RawCaller> callers;

private:
    control::Methods methods()
    {
        control::Methods all = test::quiet_methods();
        all["ProbeDrive"].answer = [this](const Json& parameters, const control::Caller& caller) {
            return probes.start(stations.front(), parameters, caller);
        };
        return all;
    }
};

TEST_F(PendingProbe, IsAnsweredWithTheReportOfTheLine)
{
    RawCaller& caller = searches();
    const std::uint32_t number = begins();
    ASSERT_NE(number, 0u);
    reports(number);
    probes.answer(io::monotonic_now());

    EXPECT_EQ(control.reply(caller).value().at("parameters").at("tried"), 7);
}

TEST_F(PendingProbe, OfALineThatStallsIsRefusedWithTheStall)
{
    stalls();
    RawCaller& caller = searches();

    EXPECT_EQ(why_ended(caller), "line p3 has stalled for 3.0 s");
    EXPECT_EQ(begins(), 0u);
}

TEST_F(PendingProbe, EndsWhenItsLineStallsAndIsNotBegunLater)
{
    RawCaller& first = searches();
    const std::uint32_t number = begins();
    RawCaller& second = searches();
    stalls();
    probes.answer(io::monotonic_now());

    EXPECT_EQ(why_ended(first), "line p3 has stalled for 3.0 s");
    EXPECT_EQ(why_ended(second), "line p3 has stalled for 3.0 s");
    EXPECT_TRUE(line->link.probe_states.has_ended(number)) << "it asks no further question";
    EXPECT_EQ(begins(), 0u);
}

TEST_F(PendingProbe, WhoseCallerHasGoneIsNotBegun)
{
    searches().close();
    searches().close();
    control.settle();
    probes.answer(io::monotonic_now());

    EXPECT_EQ(begins(), 0u);
    EXPECT_EQ(begins(), 0u) << "nor the second one";
}

TEST_F(PendingProbe, OfAStationThatLeftByAReloadIsNotBegun)
{
    RawCaller& caller = searches();
    probes.refuse({stations.front()});

    EXPECT_EQ(why_ended(caller), "the station was changed or removed by a reload");
    EXPECT_EQ(begins(), 0u);
}

} // namespace
} // namespace dpslave::app
