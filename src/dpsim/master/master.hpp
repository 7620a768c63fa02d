// SPDX-License-Identifier: Apache-2.0
/// A DP master (class 1) for one slave, and a judge of what the slave answers. Pure: octets and times go in,
/// telegrams, deadlines and events come out (wire reference, sections 2.6, 4 and 5).
#pragma once

#include "diagnosis.hpp"
#include "dpsim/common/telegram.hpp"

#include "dpslave/base/units.hpp"

#include <deque>

namespace dpslave::sim {

struct MasterSettings {
    Baud baud = Baud::k187_5;
    std::uint8_t address = 2;
    std::uint8_t slave = 5;
    std::uint16_t ident = 0x0533;
    Octets user_prm = Octets(24, 0); ///< User_Prm_Data
    Octets cfg{0x73};                ///< Cfg_Data, identifier octets
    std::chrono::milliseconds watchdog{
        1000};                  ///< 0 = off; rounded up to what two factors can say (10 ms base)
    std::uint8_t min_tsdr = 11; ///< bit times
    std::uint8_t group = 0x01;  ///< Group_Ident, a bit per group
    bool sync_freeze = true;    ///< ask for Sync and Freeze in Set_Prm
    Fixed fixed = Fixed::never; ///< SD3 for data units of eight octets
    unsigned retries = 1;       ///< repetitions of a request that got no valid answer
    std::chrono::nanoseconds cycle = std::chrono::milliseconds{10}; ///< from one cyclic request to the next
    std::chrono::nanoseconds allowance =
        std::chrono::milliseconds{20}; ///< on top of the slot time: a host jitters
};

/// How many octets a configuration carries in each direction; why it cannot be one.
struct CfgLengths {
    std::size_t inputs = 0;
    std::size_t outputs = 0;
};
Result<CfgLengths, std::string> cfg_lengths(Bytes cfg);

/// The data unit of Set_Prm that these settings make: 7 octets and User_Prm_Data.
Octets set_prm_unit(const MasterSettings& settings);

enum class MasterState : std::uint8_t {
    stopped,        ///< sends nothing on its own
    searching,      ///< FDL status until the slave answers
    asking,         ///< first Slave_Diag
    parameterising, ///< Set_Prm
    configuring,    ///< Chk_Cfg
    awaiting_ready, ///< Slave_Diag until the slave is ready
    data_exchange,
};
std::string_view text(MasterState state); ///< "data-exchange"
std::optional<MasterState> master_state(std::string_view name);

enum class Service : std::uint8_t {
    fdl_status,
    slave_diag,
    set_prm,
    chk_cfg,
    get_cfg,
    data_exchange,
    global_control,
    raw
};

std::string_view text(Service service); ///< "Slave_Diag"
std::uint8_t sap_of(Service service);   ///< DSAP at the slave; of a service that has one

/// Something to be sent once, beside what the state asks for.
struct Order {
    Service service = Service::slave_diag;
    Octets data; ///< data unit without SAPs; of raw: the octets as they are
};

/// What came of one order.
struct Answer {
    Service service = Service::slave_diag;
    std::optional<Frame> frame; ///< nothing: no answer, or an invalid one
    Octets octets;              ///< as heard
    std::string words;          ///< for people
};

struct MasterEvent {
    enum class Kind : std::uint8_t {
        state,     ///< the state has changed
        refused,   ///< start-up failed: the slave refuses; the master tries again later
        lost,      ///< no answer any more
        complaint, ///< the slave did what a slave must not do
        diagnosis, ///< it was read in data exchange, and is another one than before
        answer,    ///< an order is done
    };
    Kind kind = Kind::state;
    std::string words;
    std::optional<Answer> answer;
};

struct MasterCounters {
    std::uint64_t cycles = 0;         ///< Data_Exchange with a valid answer
    std::uint64_t retries = 0;        ///< requests sent again
    std::uint64_t missing = 0;        ///< requests without a valid answer after all retries
    std::uint64_t invalid = 0;        ///< answers with a flaw
    std::uint64_t unasked_octets = 0; ///< heard while nothing was asked
    std::uint64_t refused = 0;        ///< UE, RR, RS
    std::uint64_t diagnosis_reads = 0;
    std::uint64_t diagnosis_pending = 0; ///< Data_Exchange answers with DH
    std::uint64_t exchanges_lost = 0;    ///< ways out of Data_Exch that nobody here asked for
    std::chrono::nanoseconds answer_min{0}, answer_max{0},
        answer_sum{0}; ///< Data_Exchange: handed over until answer whole
};

/// The counters in two or three lines.
std::vector<std::string> in_words(const MasterCounters& counters);

/// After every on_* call: take_transmit(), then take_event() until empty, then next_deadline().
class Master {
public:
    explicit Master(MasterSettings settings);

    void on_bytes(Bytes octets, Instant now);
    void on_time(Instant now);
    /// A telegram to be written now; the slot time runs from `now` plus its length on the wire.
    std::optional<Octets> take_transmit(Instant now);
    Instant next_deadline() const;
    std::optional<MasterEvent> take_event();

    void start(); ///< begins the start-up; does nothing if it is running
    void stop();  ///< falls silent at once
    void order(Order order) { orders_.push_back(std::move(order)); }
    void clear(bool on); ///< Clear: zeros go out and a Global_Control says so; false = Operate

    Octets& outputs() { return outputs_; }   ///< what is sent while not in Clear
    Bytes inputs() const { return inputs_; } ///< last good answer; empty before the first
    MasterState state() const { return state_; }
    const std::optional<Diagnosis>& diagnosis() const { return diagnosis_; }
    const MasterCounters& counters() const { return counters_; }
    const MasterSettings& settings() const { return settings_; }
    CfgLengths lengths() const { return lengths_; }

private:
    struct Pending {
        Order order{};
        Octets wire{};
        bool one_shot = false;
        bool counted = false; ///< carries a valid or a first frame count bit
        bool answered = true; ///< false: SDN, nothing comes back
        unsigned tries = 0;
        Instant sent{};
        Instant give_up{};
    };

    void begin(Order order, bool one_shot);
    Frame frame_of(const Order& order);
    std::optional<Order> cyclic_order();
    void whole_answer(Bytes octets, Instant now);
    void bad_answer(std::string why, Instant now);
    void finished(Instant now);
    void no_answer(Instant now);
    void report(Answer answer);

    std::string flaw_of(const Frame& frame) const;
    void handle(const Frame& frame, Instant now);
    void on_slave_diag(const Frame& frame, Instant now);
    void on_data_exchange(const Frame& frame, Instant now);
    void on_negative(const Frame& frame, Instant now);
    void judge_start_up(const Diagnosis& diagnosis, Instant now);
    void refuse(std::string why, Instant now);
    void leave_exchange(std::string why, MasterState to);
    void enter(MasterState state);
    void complain(std::string words);

    MasterSettings settings_;
    CfgLengths lengths_;
    MasterState state_ = MasterState::stopped;
    Octets outputs_, inputs_;
    bool clear_ = false;
    bool diagnosis_due_ = false;
    std::optional<Diagnosis> diagnosis_;
    Octets told_diagnosis_; ///< said once, not at every reading

    bool first_ = true; ///< the next counted request starts a sequence (FCB 1, FCV 0)
    bool fcb_ = false;  ///< of the next counted request
    std::optional<Pending> pending_;
    bool to_send_ = false;
    Octets rx_, heard_;
    std::string rx_flaw_;  ///< not empty: what was heard is no answer; wait until the line is idle
    Instant idle_until_{}; ///< T_ID1 / T_ID2
    Instant next_cycle_{};
    Instant unasked_at_ = Instant::min();
    std::deque<Order> orders_;
    std::deque<MasterEvent> events_;
    std::string last_refusal_; ///< said once, not at every attempt
    std::string cfg_refusal_;  ///< Chk_Cfg was answered with RS, RR or UE
    MasterCounters counters_;
};

} // namespace dpslave::sim
