// SPDX-License-Identifier: Apache-2.0
/// A search for a drive (`dpctl doctor --probe`) on a line whose thread and port are real, and where nothing
/// answers.
#include "app/bus_bench.hpp"
#include "app/reload/plant.hpp"

#include <gmock/gmock.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using test::eventually;
using test::kGood;

class SearchOfALine : public test::ConfigFile {
protected:
    SearchOfALine()
    {
        std::string text = kGood;
        text.replace(text.find("/dev/null-p3"), 12, pty.path());
        plant.open(good(text));
        EXPECT_TRUE(link().probe_states.add(1));
        EXPECT_TRUE(link().probes.push({.number = 1, .station = plant.stations().front().number}));
    }
    ~SearchOfALine() override
    {
        plant.request_end(io::monotonic_now());
        EXPECT_THAT(plant.end(io::monotonic_now() + 1min), testing::IsEmpty());
    }
    LineLink& link() { return plant.lines().front()->link; }
    /// How many questions it has asked, when it has come to its end.
    std::uint32_t tried()
    {
        std::optional<ProbeReport> report;
        EXPECT_TRUE(eventually([&] { return (report = link().probe_reports.pop()).has_value(); }));
        return report ? report->tried : 0;
    }

    io::Pty pty;
    BusLink bus;
    Plant plant{bus, true};
};

TEST_F(SearchOfALine, ThatHasEndedBeforeItsTurnIsNotBegunAndTheDrivesAreAskedAsBefore)
{
    EXPECT_EQ(link().probe_states.end(1), OrderStates::End::not_begun);
    plant.start();

    EXPECT_EQ(tried(), 0u);
    auto& drive = plant.stations().front().link->drive_snapshot;
    EXPECT_TRUE(eventually([&] { return !pty.received().empty(); }));
    EXPECT_EQ(drive.latest().departures, 0u) << "the drive does not count as gone for it";
    EXPECT_TRUE(link().probe_states.add(1)) << "its place is free";
}

TEST_F(SearchOfALine, EndsWhenTheBusThreadStallsSoThatTheOutputsGoToTheirSafeState)
{
    bus.signs.bus.give(io::monotonic_now()); // and no more
    plant.start();

    const std::uint32_t asked = tried();
    EXPECT_GT(asked, 0u);
    EXPECT_LT(asked, 30u) << "after a second";
    EXPECT_TRUE(eventually([&] {
        const auto told = link().happenings.take();
        return told && std::string{told->text.data()}.find("the bus thread has stalled") != std::string::npos;
    }));
}

} // namespace
} // namespace dpslave::app
