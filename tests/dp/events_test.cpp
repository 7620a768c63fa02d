// SPDX-License-Identifier: Apache-2.0
/// Tests what a log and `dpctl` get to see: events, counters, texts.
#include "bench.hpp"

#include <gmock/gmock.h>

namespace test {
namespace {

using dpslave::dp::Event;
using dpslave::dp::LeaveReason;
using dpslave::dp::Refusal;
using dpslave::dp::Service;
using dpslave::dp::State;
using Kind = Event::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

class Events : public ExampleSlave {
protected:
    std::vector<Kind> kinds()
    {
        std::vector<Kind> all;
        for (const Event& event : events()) all.push_back(event.kind);
        return all;
    }
};

TEST_F(Events, AStartUpReportsItsStatesAndItsMaster)
{
    exchanges();

    EXPECT_THAT(events(), ElementsAre(Event{.kind = Kind::state, .state = State::wait_cfg, .master = 2},
                                      Event{.kind = Kind::state, .state = State::data_exch, .master = 2}));
}

TEST_F(Events, LeavingReportsReasonAndMaster)
{
    exchanges();
    events();
    bus.advance(std::chrono::seconds{1});

    EXPECT_THAT(
        events(),
        ElementsAre(Event{
            .kind = Kind::state, .state = State::wait_prm, .reason = LeaveReason::watchdog, .master = 2}));
}

TEST_F(Events, ARefusalIsReportedWithItsDetail)
{
    master.set_prm("88 14 01 0B 47 12 01");

    const auto logged = events();
    ASSERT_EQ(logged.size(), 1u);
    EXPECT_EQ(logged[0].kind, Kind::refused);
    EXPECT_EQ(logged[0].master, 2);
    EXPECT_EQ(logged[0].refusal.why, Refusal::prm_ident);
    EXPECT_EQ(logged[0].refusal.got, 0x4712);
}

TEST_F(Events, TheSameRefusalForEverIsReportedOnce)
{
    for (int i = 0; i < 5; ++i) master.set_prm("88 14 01 0B 47 12 01");
    EXPECT_THAT(kinds(), ElementsAre(Kind::refused));
    master.set_prm("88 14 01 0B 47 13 01");
    EXPECT_THAT(kinds(), ElementsAre(Kind::refused));
    EXPECT_EQ(seen().counters.set_prm, 6u);
}

TEST_F(Events, AForeignSetPrmIsReported)
{
    exchanges();
    events();
    foreign.set_prm(kPrm);

    const auto logged = events();
    ASSERT_EQ(logged.size(), 1u);
    EXPECT_EQ(logged[0].kind, Kind::foreign_set_prm);
    EXPECT_EQ(logged[0].master, 9);
    EXPECT_EQ(seen().counters.foreign_prm, 1u);
}

TEST_F(Events, ASetPrmThatIsTooShortIsNotReported)
{
    EXPECT_EQ(master.set_prm("88 14 01 0B 47 11"), "SC");

    EXPECT_THAT(kinds(), IsEmpty());
}

TEST_F(Events, AMasterWithoutWatchdogIsWarnedOf)
{
    master.set_prm(kPrmNoWatchdog);

    EXPECT_THAT(kinds(), ElementsAre(Kind::watchdog_of_master, Kind::state));
}

TEST_F(Events, GlobalControlIsReportedWhereItChangesSomething)
{
    exchanges(kPrmSyncFreeze);
    events();
    for (int i = 0; i < 3; ++i) master.control("20 00");
    for (int i = 0; i < 3; ++i) master.control("08 00");
    for (int i = 0; i < 3; ++i) master.control("14 00");
    for (int i = 0; i < 3; ++i) master.control("02 00"); // a master in CLEAR
    master.control("00 00");
    master.control("02 00");

    EXPECT_THAT(kinds(), ElementsAre(Kind::sync, Kind::freeze, Kind::unsync, Kind::unfreeze, Kind::clear_data,
                                     Kind::clear_data));
}

TEST_F(Events, WhatIsNotFetchedIsLostAndReportedAsLost)
{
    for (int i = 0; i < 10; ++i) {
        master.set_prm(kPrm);
        master.set_prm("40 00 00 00 47 11 00");
    }

    const auto logged = events();
    ASSERT_EQ(logged.size(), 17u);
    EXPECT_EQ(logged[15].state, State::wait_prm);
    EXPECT_EQ(logged[16].kind, Kind::overflow);
    EXPECT_THAT(kinds(), IsEmpty());
    master.set_prm(kPrm);
    EXPECT_THAT(kinds(), ElementsAre(Kind::state));
}

TEST_F(Events, TelegramsAreCountedByService)
{
    exchanges(); // Set_Prm, Chk_Cfg, Slave_Diag
    master.data_exchange("00 00");
    master.data_exchange("00 00");
    foreign.data_exchange("00 00"); // RS
    master.rd_inp();
    master.rd_outp({1}); // RR
    master.get_cfg();
    master.control("00 00");
    master.asks(55); // RS

    const auto c = seen().counters;
    EXPECT_EQ(c.set_prm, 1u);
    EXPECT_EQ(c.chk_cfg, 1u);
    EXPECT_EQ(c.slave_diag, 1u);
    EXPECT_EQ(c.data_exchange, 2u);
    EXPECT_EQ(c.rd_inp, 1u);
    EXPECT_EQ(c.rd_outp, 1u);
    EXPECT_EQ(c.get_cfg, 1u);
    EXPECT_EQ(c.global_control, 1u);
    EXPECT_EQ(c.not_activated, 2u);
    EXPECT_EQ(c.no_resource, 1u);
}

TEST_F(Events, OtherAnswersThanRsAndRrAreNotCounted)
{
    exchanges(); // SC, SC, DL

    EXPECT_EQ(seen().counters.not_activated, 0u);
    EXPECT_EQ(seen().counters.no_resource, 0u);
}

TEST_F(Events, TheStateHasTheStandardsNames)
{
    EXPECT_EQ(text(State::power_on), "Power_On");
    EXPECT_EQ(text(State::wait_prm), "Wait_Prm");
    EXPECT_EQ(text(State::wait_cfg), "Wait_Cfg");
    EXPECT_EQ(text(State::data_exch), "Data_Exch");
}

TEST(Refusals, AreEachOfTheServiceThatTheirNameSays)
{
    EXPECT_EQ(service_of(Refusal::none), Service::none);
    for (const Refusal why :
         {Refusal::prm_ident, Refusal::prm_watchdog, Refusal::prm_not_supported, Refusal::prm_length,
          Refusal::prm_dpv1, Refusal::prm_tag_too_large, Refusal::prm_zero_tag})
        EXPECT_EQ(service_of(why), Service::set_prm) << text(why);
    for (const Refusal why : {Refusal::cfg_empty, Refusal::cfg_too_long, Refusal::cfg_identifier,
                              Refusal::cfg_too_few, Refusal::cfg_too_many, Refusal::cfg_changed})
        EXPECT_EQ(service_of(why), Service::chk_cfg) << text(why);
}

TEST_F(Events, TheSnapshotShowsTheWholeSlave)
{
    exchanges("B8 14 01 0B 47 11 05");
    master.data_exchange("A5 01");
    const auto snapshot = seen();

    EXPECT_EQ(snapshot.state, State::data_exch);
    EXPECT_EQ(snapshot.address, kUs);
    EXPECT_EQ(snapshot.master, 2);
    EXPECT_TRUE(snapshot.watchdog_on);
    EXPECT_EQ(snapshot.watchdog, std::chrono::milliseconds{200});
    EXPECT_EQ(snapshot.min_tsdr, dpslave::Tbit{11});
    EXPECT_EQ(snapshot.groups, 0x05);
    EXPECT_EQ(snapshot.layout.count, 2);
    EXPECT_TRUE(snapshot.may_write);
    EXPECT_EQ(snapshot.inputs[0], 0x1234);
    EXPECT_EQ(snapshot.outputs[1], 0xA501);
}

} // namespace
} // namespace test
