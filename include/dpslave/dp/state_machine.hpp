// SPDX-License-Identifier: Apache-2.0
/// The state machine of a DP slave: state, owner, watchdog, faults and diagnosis. A trigger goes in, the row
/// of the state table is carried out. Source: wire reference 6.
#pragma once

#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/pending_events.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/process_data.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/dp/slave_diag.hpp"
#include "dpslave/dp/state.hpp"
#include "dpslave/dp/watchdog.hpp"
#include "dpslave/fdl/sap_user.hpp"

#include <cstdint>
#include <variant>

namespace dpslave::dp {

enum class Trigger : std::uint8_t; // of the state table
enum class Effect : std::uint8_t;
enum class Fault : std::uint8_t;

/// A judged telegram or an event inside, as a trigger, and its data.
struct Judgement {
    Trigger trigger;
    /// Parameters with an accepted Set_Prm, a configuration with an accepted Chk_Cfg that starts an exchange,
    /// the refusal with a refused one.
    std::variant<std::monostate, SetPrm, Configuration, RefusalDetail> brings{};
};

/// Begins in Power_On. It is for one thread and allocates nothing.
class StateMachine {
public:
    /// All three outlive it.
    StateMachine(const Personality& personality, ProcessData& data, PendingEvents& log);

    /// A request, judged: carries out what the table has for it, fills `reply` and says how to answer.
    fdl::Answer apply(const Judgement& judged, const fdl::Indication& request, fdl::ReplyData& reply);
    /// An event inside: no telegram, no reply.
    void apply(Trigger trigger, Instant at = {});
    /// Judges the watchdog, and the time within which inputs have to be tried. Call it before each request as
    /// well: one that comes after the watchdog's expiry finds the slave in Wait_Prm.
    void on_time(Instant at);
    /// A request of `sa` was received at `at`: the watchdog begins anew if it is the owner's.
    void retrigger(std::uint8_t sa, Instant at);
    /// kNever = none.
    Instant next_deadline() const;
    /// Does what Slave::set_ext_diag() says.
    bool set_ext_diag(Bytes blocks, bool fault);

    State state() const { return state_; }
    std::uint8_t master() const { return master_; } ///< the owner, or kNoMaster
    bool is_foreign(std::uint8_t sa) const { return master_ != kNoMaster && sa != master_; }
    const SetPrm& parameters() const { return parameters_; }       ///< of the owner
    Bytes accepted_configuration() const { return cfg_accepted_; } ///< Cfg_Data; empty: there never was one
    Tbit min_tsdr() const { return min_tsdr_; }
    fdl::Supervision supervision() const;

    /// Fills its part of the snapshot.
    void fill(Snapshot& seen) const;

private:
    void set_fault(Fault fault, const Judgement& judged, std::uint8_t master);
    void leave(LeaveReason reason);
    void carry_out(Effect effect, const Judgement& judged, const fdl::Indication& request,
                   fdl::ReplyData& reply);
    void enter(State to, LeaveReason reason, std::uint8_t owner_before);

    void power_on();
    void read_diagnosis(std::uint8_t sa, fdl::ReplyData& reply);
    void take_parameters(const Judgement& judged, const fdl::Indication& request);
    void start_exchange(const Judgement& judged, const fdl::Indication& request);
    void control(Bytes data);
    void set_sync(Switch to);
    void set_freeze(Switch to);
    void append_diagnosis(ByteBuffer<244>& into) const;
    Event event(Event::Kind kind) const;

    const Personality& personality_;
    ProcessData& data_;
    PendingEvents& log_;

    State state_ = State::power_on;
    std::uint8_t master_ = kNoMaster;
    SetPrm parameters_{};
    Tbit min_tsdr_ = kSmallestMinTsdr;
    Watchdog watchdog_;
    bool prm_fault_ = false;
    bool not_supported_ = false;
    bool cfg_fault_ = false;
    bool diag_pending_ = false;
    ExtendedDiagnosis ext_diag_;
    ByteBuffer<244> cfg_accepted_;

    RefusalDetail refusal_{};
    LeaveReason left_because_ = LeaveReason::none;
    std::uint64_t expirations_ = 0; ///< of the watchdog
};

} // namespace dpslave::dp
