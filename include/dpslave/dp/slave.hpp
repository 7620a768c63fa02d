// SPDX-License-Identifier: Apache-2.0
/// A DP slave: SAPs 55 to 62 and Data_Exchange over one process image. It is pure: the time, the inputs and
/// the answers come in; replies, outputs, orders and events go out as values. Source: wire reference 4 to 7.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/dp/pending_events.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/process_data.hpp"
#include "dpslave/dp/snapshot.hpp"
#include "dpslave/dp/state_machine.hpp"
#include "dpslave/fdl/sap_user.hpp"

#include <cstdint>
#include <optional>

namespace dpslave::dp {

/// Judges each request of layer 2 and passes it to the state machine as a trigger. It is for one thread, and
/// the reply path allocates nothing.
class Slave final : public fdl::SapUser {
public:
    /// `personality` outlives the slave. `address` 0..125. The slave is in Power_On until start(): attach it
    /// to layer 2 after start().
    Slave(const Personality& personality, std::uint8_t address);
    Slave(const Slave&) = delete; // layer 2 keeps its address
    Slave& operator=(const Slave&) = delete;

    /// The address from the next start() on, 0..125. Works only in Power_On; returns false, and changes
    /// nothing, in any other state: its masters know the slave under the old one.
    bool set_address(std::uint8_t address);

    void start(Instant now); ///< Power_On -> Wait_Prm
    void stop(Instant now);  ///< every state -> Power_On, with all effects of leaving the state

    // For layer 2.
    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override;
    void sdn(const fdl::Indication& request) override;
    void heard(std::uint8_t sa, Instant at) override;
    Tbit min_tsdr() const override { return machine_.min_tsdr(); }
    fdl::Supervision supervision() const override { return machine_.supervision(); }
    void on_time(Instant now) override { machine_.on_time(now); }
    Instant next_deadline() const override { return machine_.next_deadline(); }

    // For the bus thread: newest inputs and answers in; outputs, orders and events out.

    /// Counts only under the present layout's generation; others are dropped.
    void set_inputs(const InputImage& inputs);
    void set_demand_answer(const DemandAnswer& answer) { data_.set_demand_answer(answer); }
    /// Blocks of extended diagnosis, back to back; `fault` sets Ext_Diag. Blocks beyond max_diag_length are
    /// cut off at a block boundary (Ext_Diag_Overflow). None: the device's own block as zeros
    /// (Personality::diag_octets). False: a header announces more octets than there are; the blocks from
    /// there on are ignored.
    bool set_ext_diag(Bytes blocks, bool fault) { return machine_.set_ext_diag(blocks, fault); }

    /// Returns the outputs that the drive side has to write, if they changed since the last call.
    std::optional<OutputImage> take_outputs() { return data_.take_outputs(); }
    std::optional<DemandOrder> take_demand_order() { return data_.take_demand_order(); }
    /// Each leaving of Data_Exch once, in order, however fast the next start-up was.
    std::optional<LeftDataExchange> take_left() { return data_.take_left(); }
    std::optional<Event> take_event() { return log_.take(state(), machine_.master()); }

    State state() const { return machine_.state(); }
    Snapshot snapshot() const;

private:
    // Each counts its telegram and keeps a copy for snapshot() where it has one.
    Judgement judge(const fdl::Indication& request);
    Judgement judge_data(const fdl::Indication& request) const;
    Judgement judge_set_prm(const fdl::Indication& request);
    Judgement judge_chk_cfg(const fdl::Indication& request);
    Judgement judge_control(const fdl::Indication& request) const;

    const Personality& personality_;
    std::uint8_t address_;
    PendingEvents log_;
    ProcessData data_;
    StateMachine machine_;
    ByteBuffer<244> prm_seen_;
    ByteBuffer<244> cfg_seen_;
    Counters counters_{}; ///< of telegrams; data_ and machine_ have theirs
};

} // namespace dpslave::dp
