// SPDX-License-Identifier: Apache-2.0
/// A DP slave: SAPs 55 to 62 and Data_Exchange over one process image. Pure: it is told the time, the inputs
/// and the answers, and gives replies, outputs, orders and events as values. Source: wire reference 4 to 7.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/dp/chk_cfg.hpp"
#include "dpslave/dp/demand_data.hpp"
#include "dpslave/dp/personality.hpp"
#include "dpslave/dp/queue.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/set_prm.hpp"
#include "dpslave/dp/slave_diag.hpp"
#include "dpslave/dp/watchdog.hpp"
#include "dpslave/fdl/sap_user.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

namespace dpslave::dp {

/// Wait_Prm, Wait_Cfg, Data_Exch (wire reference 6.1); power_on = silent, before start() and after stop().
enum class State : std::uint8_t { power_on, wait_prm, wait_cfg, data_exch };
std::string_view text(State state) noexcept; ///< "Wait_Prm" ...

/// Why Data_Exch (or Wait_Cfg) was left.
enum class LeaveReason : std::uint8_t {
    none,
    prm_fault,      ///< the owner's Set_Prm was refused
    not_supported,  ///< ... because it asked for Sync or Freeze
    cfg_fault,      ///< the owner's Chk_Cfg was refused
    watchdog,       ///< no request of the owner for T_WD
    unlock,         ///< the owner released the slave
    output_length,  ///< Data_Exchange of another length than configured
    new_parameters, ///< the owner chose other tags while in Data_Exch (row P12)
    stop,           ///< the application
};
std::string_view text(LeaveReason reason) noexcept;

/// Something that happened, for the log. Fetched with take_event(). Refusals like the event just before them
/// are not repeated: a master that sends the same wrong Set_Prm for ever fills no log (the counters go on).
struct Event {
    enum class Kind : std::uint8_t {
        state,           ///< `state` was entered from another; `reason` says why that one was left
        refused,         ///< `refusal`: a Set_Prm or Chk_Cfg of `master`
        foreign_set_prm, ///< `master` tried to parameterise a slave that another one owns
        sync,
        unsync,
        freeze,
        unfreeze,
        clear_data, ///< the first Clear_Data after an exchange without; a master in CLEAR repeats it for ever
        watchdog_of_master, ///< parameterised with the watchdog off: outputs hold for ever if the master
                            ///< vanishes
        overflow,           ///< events were lost here because nobody fetched them
    };
    Kind kind = Kind::state;
    State state = State::power_on;
    LeaveReason reason = LeaveReason::none;
    std::uint8_t master = kNoMaster; ///< the owner, on leaving the one until then; else whom it concerns
    RefusalDetail refusal{};
    friend bool operator==(const Event&, const Event&) = default;
};

/// Telegrams by service, for `dpctl counters`. All count upwards from the start of the program.
struct Counters {
    std::uint64_t data_exchange = 0; ///< carried out; the others: received
    std::uint64_t slave_diag = 0;
    std::uint64_t set_prm = 0;
    std::uint64_t chk_cfg = 0;
    std::uint64_t get_cfg = 0;
    std::uint64_t rd_inp = 0;
    std::uint64_t rd_outp = 0;
    std::uint64_t global_control = 0;
    std::uint64_t not_activated = 0; ///< answered RS
    std::uint64_t no_resource = 0;   ///< answered RR
    std::uint64_t watchdog_expired = 0;
    std::uint64_t demand_orders = 0;
    std::uint64_t demand_rejects = 0;
    std::uint64_t left_data_exchange = 0;
    std::uint64_t orders_lost = 0; ///< Demand Data orders and LeftDataExchange that nobody fetched in time
};

/// Everything that can be seen of a slave, as one plain value (for Mailbox).
struct Snapshot {
    State state = State::power_on;
    std::uint8_t address = 0;
    std::uint8_t master = kNoMaster; ///< Master_Add
    bool watchdog_on = false;
    std::chrono::milliseconds watchdog{}; ///< T_WD; 0 = off
    Tbit min_tsdr{11};
    std::uint8_t groups = 0; ///< Group_Ident
    bool sync = false;
    bool freeze = false;
    bool clear = false; ///< the master's last Global_Control was Clear_Data: 0 goes to every output
    bool stat_diag = false;
    bool holds = false; ///< Stat_Diag stands because a parameter has answered with a number of unknown scale
    bool diag_pending = false;
    ByteBuffer<244> diagnosis; ///< as Slave_Diag would answer now
    ByteBuffer<244> prm; ///< the last Set_Prm seen, accepted or not; those of foreign masters do not count
    ByteBuffer<244> cfg; ///< the last Chk_Cfg seen, likewise
    LeaveReason left_because = LeaveReason::none; ///< the last time
    RefusalDetail refusal{}; ///< of the last refused telegram; cleared by the next accepted one of its kind
    Layout layout{};
    bool demand_data = false; ///< Demand Data stands before the parameters
    bool may_write = false;
    std::array<std::uint16_t, kMaxParameters> inputs{};  ///< as sent (frozen under Freeze)
    std::array<std::uint16_t, kMaxParameters> outputs{}; ///< active (after Sync and Clear)
    std::array<std::uint16_t, 4> demand_request{};       ///< the four registers as received
    std::array<std::uint16_t, 4> demand_reply{};         ///< as sent
    DemandOrder demand_order{};                          ///< the one that stands; `cancel`: none
    Counters counters{};
};

enum class Trigger : std::uint8_t; // of the state table
enum class Effect : std::uint8_t;
enum class Switch : std::uint8_t; // of Global_Control
struct GlobalCommand;

class Slave final : public fdl::SapUser {
public:
    /// `personality` outlives the slave. `address` 0..125. Until start() the slave is in Power_On and silent
    /// above: attach it to the fdl::Station only when started.
    Slave(const Personality& personality, std::uint8_t address);
    Slave(const Slave&) = delete; // the station knows it by its place
    Slave& operator=(const Slave&) = delete;

    /// The address from the next start() on, 0..125. Only in Power_On; false, and nothing changes, in any
    /// other state: its masters know the slave under the old one.
    bool set_address(std::uint8_t address);

    void start(Instant now); ///< Power_On -> Wait_Prm
    void stop(Instant now);  ///< every state -> Power_On, with everything that leaving means

    // The door to layer 2.
    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override;
    void sdn(const fdl::Indication& request) override;
    void heard(std::uint8_t sa, Instant at) override;
    Tbit min_tsdr() const override;
    fdl::Supervision supervision() const override;
    void on_time(Instant now) override;
    Instant next_deadline() const override;

    // The door to the world: newest inputs and answers in; outputs, orders and events out.

    /// Counts only under the present layout's generation; others are dropped.
    void set_inputs(const InputImage& inputs);
    void set_demand_answer(const DemandAnswer& answer);
    /// Blocks of extended diagnosis, back to back; `fault` sets Ext_Diag. What does not fit into
    /// max_diag_length is cut off at a block boundary (Ext_Diag_Overflow). None: the device's own block as
    /// zeros (Personality::diag_octets). False: a header promised what was not there, from there on nothing
    /// was taken.
    bool set_ext_diag(Bytes blocks, bool fault);

    /// What the drive side shall write; given only when it changed since the last call.
    std::optional<OutputImage> take_outputs();
    std::optional<DemandOrder> take_demand_order();
    /// Each leaving of Data_Exch once, in order, however fast the next start-up was.
    std::optional<LeftDataExchange> take_left();
    std::optional<Event> take_event();

    State state() const { return state_; }
    Snapshot snapshot() const;

private:
    /// One direction of the cyclic exchange, by the parameters of the layout.
    struct Image {
        std::array<std::uint16_t, kMaxParameters> words{};
        DemandRegisters demand{};
    };

    // Telegrams and happenings become triggers of the state table ...
    Trigger judge(const fdl::Indication& request);
    Trigger judge_data(const fdl::Indication& request) const;
    Trigger judge_set_prm(const fdl::Indication& request);
    Trigger judge_chk_cfg(const fdl::Indication& request);
    Trigger judge_control(const fdl::Indication& request) const;
    void tick(Instant at);
    // ... and the row that the table has for them is carried out.
    fdl::Answer act(Trigger on, const fdl::Indication& request, fdl::ReplyData& reply);
    void act(Trigger on, Instant at);
    LeaveReason carry_out(Effect effect, const fdl::Indication& request, fdl::ReplyData& reply);
    LeaveReason leave_by(Effect effect, const fdl::Indication& request);
    void enter(State to, LeaveReason reason, std::uint8_t owner_before);

    void power_on();
    void leave(LeaveReason reason);
    void refuse(std::uint8_t master);
    void take_parameters(const fdl::Indication& request);
    void start_exchange(const fdl::Indication& request);
    void make_ready();
    void end_exchange();

    void receive_outputs(Bytes data);
    void clear_outputs();
    void activate_received();
    void allow_writing();
    void obey(const GlobalCommand& command);
    void set_sync(Switch to);
    void set_freeze(Switch to);
    void tell_inputs(ByteBuffer<244>& into) const;
    void tell_outputs(ByteBuffer<244>& into) const;
    void tell_diagnosis(ByteBuffer<244>& into) const;
    ExtendedDiagnosis::Outcome take_ext_diag(Bytes blocks, bool fault);
    void tell(Event event);
    void tell_once(Event event); ///< not again when it was the last one told

    /// Every parameter was tried or had its time, but one has no scale.
    bool holds() const { return stat_diag_ && inputs_.scale_missing; }
    /// Not every scale is known yet, or one of them never will be.
    bool finds_scales() const { return stat_diag_ && personality_.tries_outputs; }
    bool is_foreign(std::uint8_t sa) const { return master_ != kNoMaster && sa != master_; }

    const Personality& personality_;
    std::uint8_t address_;

    // State (wire reference 6.2).
    State state_ = State::power_on;
    std::uint8_t master_ = kNoMaster;
    Parameters prm_{};
    Tbit min_tsdr_ = kSmallestMinTsdr;
    Watchdog watchdog_;
    bool prm_fault_ = false;
    bool not_supported_ = false;
    bool cfg_fault_ = false;
    bool stat_diag_ = false;
    Instant ready_by_ = kNever; ///< Stat_Diag ends here even if not every input was tried
    bool diag_pending_ = false;
    ExtendedDiagnosis ext_diag_;

    // Configuration.
    Generation generations_ = 0;   ///< layouts so far
    Configuration config_{};       ///< layout.generation 0: there is none
    ByteBuffer<244> cfg_accepted_; ///< empty: none was ever accepted

    // Process data.
    Image received_{}; ///< D: the outputs as received last
    Image active_{};   ///< N: the outputs that are in force
    bool may_write_ = false;
    bool outputs_changed_ = false;
    InputImage inputs_{}; ///< of the present layout
    Image frozen_{};
    bool sync_ = false;
    bool freeze_ = false;
    bool clear_told_ = false; ///< the log knows that the master is in CLEAR
    DemandData demand_;

    // What the telegram being judged brings, until the table says that it is taken.
    Parameters offered_prm_{};
    Configuration offered_config_{};
    RefusalDetail offered_refusal_{};

    // What can be seen from outside.
    ByteBuffer<244> prm_seen_;
    ByteBuffer<244> cfg_seen_;
    RefusalDetail refusal_{};
    LeaveReason left_because_ = LeaveReason::none;
    Counters counters_{};
    Queue<LeftDataExchange, 8> left_;
    Queue<Event, 16> events_;
    Event last_event_{.kind = Event::Kind::overflow};
    bool events_lost_ = false;
};

} // namespace dpslave::dp
