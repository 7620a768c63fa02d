// SPDX-License-Identifier: Apache-2.0
/// The counters, as the control interface reports them.
#include "app/state/report.hpp"
#include "control/interface.hpp"

#include <gtest/gtest.h>

#include <map>

namespace dpslave::app {
namespace {

using nlohmann::json;
using report::json_of;

std::uint64_t counter(const json& reply, const std::string& name)
{
    for (const json& one : reply.at("groups").at(0).at("counters"))
        if (one.at("name") == name) return one.at("value").get<std::uint64_t>();
    ADD_FAILURE() << "no counter " << name;
    return 0;
}

TEST(CountersReport, HasNoFigureBeforeTheFirstReply)
{
    const json reply = json_of(counters_report(View{}, Instant{}));

    EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);
    ASSERT_EQ(reply.at("turnaround").size(), 2u);
    for (const json& one : reply.at("turnaround")) {
        EXPECT_EQ(one.at("count"), 0);
        for (const char* figure : {"p50", "p99", "p999", "highest"})
            EXPECT_TRUE(one.at(figure).is_null()) << figure;
        EXPECT_TRUE(one.at("classes").empty());
    }
}

TEST(CountersReport, HasTheTurnaroundInMicrosecondsAndBitTimes)
{
    View view;
    for (int i = 0; i < 999; ++i) view.bus.turnaround_us.add(66);
    view.bus.turnaround_us.add(50'000);
    view.bus.turnaround_tbit.add(12);
    const json reply = json_of(counters_report(view, Instant{}));
    EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);

    const json& us = reply.at("turnaround").at(0);
    EXPECT_EQ(us.at("unit"), "us");
    EXPECT_EQ(us.at("count"), 1000);
    EXPECT_EQ(us.at("sum"), 999 * 66 + 50'000);
    EXPECT_EQ(us.at("p50"), 79); // the upper end of 64 to 79
    EXPECT_EQ(us.at("p999"), 79);
    EXPECT_EQ(us.at("highest"), 50'000);
    EXPECT_EQ(us.at("classes"), json::parse(R"([{"from":64,"to":79,"count":999},
                                                {"from":14336,"to":null,"count":1}])"));
    const json& bits = reply.at("turnaround").at(1);
    EXPECT_EQ(bits.at("unit"), "T_bit");
    EXPECT_EQ(bits.at("classes"), json::parse(R"([{"from":12,"to":12,"count":1}])"));
}

TEST(CountersReport, HasTheRoundsOfEachStationOnItsLine)
{
    config::StationConfig config;
    config.name = "unwinder";
    config::LineConfig line;
    line.name = "p3";
    Station station{};
    station.config = std::make_shared<const config::StationConfig>(config);
    station.line = &line;
    station.drive.refresh_ms.add(12);
    station.drive.refresh_ms.add(100);
    View view;
    view.stations = {&station, 1};
    const json reply = json_of(counters_report(view, Instant{}));
    EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);

    ASSERT_EQ(reply.at("refresh").size(), 1u);
    const json& one = reply.at("refresh").at(0);
    EXPECT_EQ(one.at("station"), "unwinder");
    EXPECT_EQ(one.at("line"), "p3");
    EXPECT_EQ(one.at("rounds").at("unit"), "ms");
    EXPECT_EQ(one.at("rounds").at("sum"), 112);
    EXPECT_EQ(one.at("rounds").at("classes"), json::parse(R"([{"from":12,"to":12,"count":1},
                                                              {"from":96,"to":111,"count":1}])"));
}

TEST(CountersReport, HasWhatTheEdgeCounted)
{
    View view;
    view.bus.counters.late = 1;
    view.bus.too_late = 2;
    view.bus.driver_errors = 3;
    view.bus.driver_guarded = 4;
    view.bus.echo_missing = 5;
    view.bus.echo_broken = 6;
    view.bus.page_faults = 7;
    const json reply = json_of(counters_report(view, Instant{}));

    EXPECT_EQ(counter(reply, "late"), 1u);
    EXPECT_EQ(counter(reply, "too_late"), 2u);
    EXPECT_EQ(counter(reply, "driver_errors"), 3u);
    EXPECT_EQ(counter(reply, "driver_guarded"), 4u);
    EXPECT_EQ(counter(reply, "echo_missing"), 5u);
    EXPECT_EQ(counter(reply, "echo_broken"), 6u);
    EXPECT_EQ(counter(reply, "page_faults"), 7u);
}

TEST(CountersReport, HasWhatTheControlSocketCountedBehindAllStations)
{
    View view;
    Station station{};
    station.config = std::make_shared<const config::StationConfig>();
    view.stations = {&station, 1};
    view.calls = {.connections = 1,
                  .calls = 2,
                  .errors = 3,
                  .turned_away = 4,
                  .displaced = 5,
                  .malformed = 6,
                  .too_slow = 7,
                  .not_permitted = 8,
                  .handler_failures = 9};
    const json reply = json_of(counters_report(view, Instant{}));
    EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);
    const json& group = reply.at("groups").at(2);

    EXPECT_EQ(group.at("name"), "control socket");
    int value = 0;
    for (const json& one : group.at("counters")) EXPECT_EQ(one.at("value"), ++value) << one.at("name");
    EXPECT_EQ(value, 9);
}

TEST(CountersReport, HasTheDelayOfADriveThatIsAlwaysLateAndTheTimeOutThatItNeeds)
{
    config::StationConfig config;
    config.name = "unwinder";
    View view;
    Station station{};
    station.config = std::make_shared<const config::StationConfig>(config);
    station.drive.heard = {.damaged = 1,
                           .late = 2,
                           .foreign = 3,
                           .late_in_a_row = drive::kAlwaysLate,
                           .delay = std::chrono::milliseconds{420}};
    view.stations = {&station, 1};
    const json group = json_of(counters_report(view, Instant{})).at("groups").at(1);
    const auto value = [&](const std::string& name) {
        for (const json& one : group.at("counters"))
            if (one.at("name") == name) return one.at("value").get<int>();
        return -1;
    };

    EXPECT_EQ(value("drive_damaged"), 1);
    EXPECT_EQ(value("drive_late"), 2);
    EXPECT_EQ(value("drive_foreign"), 3);
    EXPECT_EQ(value("drive_delay_ms"), 420);
    EXPECT_EQ(value("drive_needs_timeout_ms"), 525) << "a quarter more";
}

TEST(CountersReport, HasTheDemandDataThatWasDroppedWhileTheLineStalled)
{
    config::StationConfig config;
    config.name = "unwinder";
    View view;
    Station station{};
    station.config = std::make_shared<const config::StationConfig>(config);
    station.orders_dropped = 3;       // by the bus thread
    station.drive.orders_dropped = 5; // by the line itself
    view.stations = {&station, 1};
    const json group = json_of(counters_report(view, Instant{})).at("groups").at(1);
    std::map<std::string, int> values;
    for (const json& one : group.at("counters")) values[one.at("name")] = one.at("value").get<int>();

    EXPECT_EQ(values["line_orders_dropped"], 3);
    EXPECT_EQ(values["drive_orders_dropped"], 5);
}

TEST(CountersReport, HasWhatWasCountedWithinTheLastMinuteAndSinceWhen)
{
    using std::chrono::seconds;
    View view;
    const Instant start{seconds{100}};
    view.bus.counters.late = 3;
    view.history.sample(view, start);
    view.bus.counters.late = 5;
    view.history.sample(view, start + seconds{10});

    const auto late = [&](Instant now) {
        const json reply = json_of(counters_report(view, now));
        EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);
        for (const json& one : reply.at("groups").at(0).at("counters"))
            if (one.at("name") == "late") return one;
        return json();
    };
    EXPECT_EQ(late(start + seconds{12}).at("minute"), 5);
    EXPECT_EQ(late(start + seconds{12}).at("last_age_ms"), 2000.0);
    EXPECT_EQ(late(start + seconds{12}).at("since_age_ms"), 12000.0);

    view.history.sample(view, start + seconds{75});
    EXPECT_EQ(late(start + seconds{75}).at("value"), 5);
    EXPECT_EQ(late(start + seconds{75}).at("minute"), 0);
    EXPECT_EQ(late(start + seconds{75}).at("last_age_ms"), 65000.0);
    EXPECT_TRUE(late(start + seconds{75}).at("since_age_ms").is_null());
}

TEST(CountersReport, IsExactWhereANumberOf32BitsOrADoubleIsFull)
{
    using std::chrono::seconds;
    for (const unsigned bits : {32U, 53U}) {
        View view;
        const Instant start{std::chrono::days{60}};
        view.bus.counters.octets = (std::uint64_t{1} << bits) - 1;
        view.history.sample(view, start);
        view.bus.counters.octets += 2;
        view.history.sample(view, start + seconds{100});

        const json reply = json_of(counters_report(view, start + seconds{100}));
        const json& octets = reply.at("groups").at(0).at("counters").at(0);
        EXPECT_EQ(control::reply_mismatch("GetCounters", reply), std::nullopt);
        EXPECT_EQ(octets.at("name"), "octets");
        EXPECT_EQ(octets.at("value").dump(), bits == 32 ? "4294967297" : "9007199254740993");
        EXPECT_EQ(octets.at("minute"), 2);
    }
}

} // namespace
} // namespace dpslave::app
