// SPDX-License-Identifier: Apache-2.0
/// Who is on the bus, as the control interface reports it.
#include "app/state/report.hpp"
#include "control/interface.hpp"

#include <gtest/gtest.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;

constexpr Instant kBegin{1000s};

class BusReport : public testing::Test {
protected:
    BusReport()
    {
        view.config = &config;
        view.bus.baud = Baud::k187_5;
        config.bus.port = "/dev/ttyS1";
    }
    report::GetBusReply at(Instant now) const
    {
        report::GetBusReply reply = members_report(view, now);
        EXPECT_EQ(control::reply_mismatch("GetBus", report::json_of(reply)), std::nullopt);
        return reply;
    }

    config::Config config;
    View view;
};

TEST_F(BusReport, LeavesOutAddressesThatNobodyHasHeardOrAsked)
{
    EXPECT_TRUE(at(kBegin).members.empty());

    view.members[7].is_slave = true;
    view.members[9].asked = 1;
    const report::GetBusReply reply = at(kBegin);

    ASSERT_EQ(reply.members.size(), 2U);
    EXPECT_EQ(reply.members[0].address, 7);
    EXPECT_EQ(reply.members[1].address, 9);
}

TEST_F(BusReport, HasNoAgeNoIdentAndNoCycleThatWasNeverHeard)
{
    view.members[7].is_slave = true;
    const report::Member member = at(kBegin).members.at(0);

    EXPECT_FALSE(member.ident || member.asked_by || member.cycle);
    EXPECT_FALSE(member.last_heard_age_ms || member.last_asked_age_ms);
}

TEST_F(BusReport, HasTheLoadAsOctetsOf11BitsOfWhatTheRateAllows)
{
    view.members[2].is_master = view.members[7].is_slave = true;
    view.members[2].recurrence.octets(1'700, kBegin);
    view.members[7].recurrence.octets(3'400, kBegin);

    const report::GetBusReply reply = at(kBegin + 1s); // 17 045 octets are 187 500 bits

    EXPECT_NEAR(reply.members.at(0).load_percent, 9.97, 0.01);
    EXPECT_NEAR(reply.members.at(1).load_percent, 19.95, 0.01);
    EXPECT_NEAR(reply.load_percent, 29.92, 0.01);
}

TEST_F(BusReport, MarksTheAddressesOfThisGateway)
{
    view.members[5].is_slave = view.members[7].is_slave = true;
    Station ours;
    ours.address = 5;
    const std::span<const Station> stations{&ours, 1};
    view.stations = stations;

    EXPECT_TRUE(at(kBegin).members.at(0).ours);
    EXPECT_FALSE(at(kBegin).members.at(1).ours);
}

} // namespace
} // namespace dpslave::app
