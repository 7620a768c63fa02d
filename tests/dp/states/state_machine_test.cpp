// SPDX-License-Identifier: Apache-2.0
/// The state machine by itself: triggers go in, no telegram is judged.
#include "dp/bench.hpp"
#include "dp/state_table.hpp"

namespace test {
namespace {

using dpslave::dp::Event;
using dpslave::dp::LeaveReason;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;
using dpslave::dp::Trigger;
using dpslave::fdl::Answer;

class StateMachine : public testing::Test {
protected:
    StateMachine() { machine.apply(Trigger::start); }

    Answer apply(const dpslave::dp::Judgement& judged)
    {
        static constexpr std::array<std::uint8_t, 7> kPrm{0x80, 0, 0, 11, 0x47, 0x11, 0};
        dpslave::fdl::Indication request;
        request.sa = 2;
        request.data = kPrm;
        reply.clear();
        return machine.apply(judged, request, reply);
    }
    dpslave::dp::Snapshot seen() const
    {
        dpslave::dp::Snapshot snapshot;
        machine.fill(snapshot);
        return snapshot;
    }
    void exchanges()
    {
        apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});
        apply({Trigger::cfg_ok, dpslave::dp::Configuration{}});
        ASSERT_EQ(machine.state(), State::data_exch);
    }

    dpslave::dp::Personality device = example_device();
    dpslave::dp::ProcessData data{device};
    dpslave::dp::PendingEvents log;
    dpslave::dp::StateMachine machine{device, data, log};
    dpslave::fdl::ReplyData reply;
};

TEST_F(StateMachine, TakesOwnerAndParametersOfAnAcceptedSetPrm)
{
    dpslave::dp::SetPrm parameters;
    parameters.groups = 4;

    EXPECT_EQ(apply({Trigger::prm_ok, parameters}), Answer::sc);

    EXPECT_EQ(machine.state(), State::wait_cfg);
    EXPECT_EQ(machine.master(), 2);
    EXPECT_EQ(machine.parameters().groups, 4);
    EXPECT_TRUE(machine.is_foreign(9));
}

TEST_F(StateMachine, KeepsAndLogsTheRefusalThatComesWithATrigger)
{
    const RefusalDetail refusal{Refusal::cfg_identifier, 2, 0x11, 0x99};
    apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});
    while (log.take({}, {})) {
    }

    apply({Trigger::cfg_bad, refusal});

    EXPECT_EQ(machine.state(), State::wait_prm);
    EXPECT_EQ(seen().refusal, refusal);
    EXPECT_EQ(seen().left_because, LeaveReason::cfg_fault);
    EXPECT_EQ(
        log.take({}, {}),
        (Event{.kind = Event::Kind::refused, .state = State::wait_cfg, .master = 2, .refusal = refusal}));
    EXPECT_EQ(log.take({}, {}), (Event{.kind = Event::Kind::state,
                                       .state = State::wait_prm,
                                       .reason = LeaveReason::cfg_fault,
                                       .master = 2}));
}

TEST_F(StateMachine, ForgetsARefusedSetPrmWithTheNextAcceptedOne)
{
    const RefusalDetail refusal{Refusal::prm_ident, 5, 0x4711, 0x4712};
    apply({Trigger::prm_bad, refusal});
    ASSERT_EQ(seen().refusal, refusal);

    apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});

    EXPECT_EQ(seen().refusal, RefusalDetail{});
}

TEST_F(StateMachine, ForgetsARefusedChkCfgWithTheNextAcceptedOneAndNoSooner)
{
    const RefusalDetail refusal{Refusal::cfg_identifier, 2, 0x11, 0x99};
    apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});
    apply({Trigger::cfg_bad, refusal});
    apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});
    ASSERT_EQ(seen().refusal, refusal);

    apply({Trigger::cfg_ok, dpslave::dp::Configuration{}});

    EXPECT_EQ(seen().refusal, RefusalDetail{});
}

TEST_F(StateMachine, EndsTheProcessDataOnlyWhenItLeavesDataExch)
{
    apply({Trigger::prm_ok, dpslave::dp::SetPrm{}});
    apply({Trigger::prm_unlock});
    EXPECT_FALSE(data.take_left());

    exchanges();
    apply({Trigger::prm_unlock});
    EXPECT_TRUE(data.take_left());
}

TEST_F(StateMachine, AnswersAnExchangeHighWhileADiagnosisIsPending)
{
    exchanges();
    dpslave::fdl::Indication request;
    request.sa = 2;
    EXPECT_EQ(machine.apply({Trigger::data_ok}, request, reply), Answer::sc);

    machine.apply(Trigger::diagnosis_changed);

    EXPECT_EQ(machine.apply({Trigger::data_ok}, request, reply), Answer::high);
    EXPECT_EQ(machine.apply({Trigger::read_inputs}, request, reply), Answer::sc);
}

TEST(StateTable, ARowThatLeavesEndsInAnotherState)
{
    for (const auto& row : dpslave::dp::kTable)
        EXPECT_TRUE(row.leave == LeaveReason::none || row.to) << row.id;
}

} // namespace
} // namespace test
