// SPDX-License-Identifier: Apache-2.0
/// The state machine of a DP slave as a table: which telegram or happening does what in which state. The rows
/// carry the names of wire reference 6.4, so that a reviewer lays the two side by side.
///
/// Rows of 6.4 that are not here: F1 and F2 (FDL status, retries) are layer 2's; S1 and S2 need
/// Set_Slave_Add, which no personality has, so S3 is the row; W2 (a silent master, watchdog off) is the
/// absence of any trigger; A3 (the application lost a module) is reported by diagnosis: by A1; M1 needs
/// DP-V1.
#pragma once

#include "dpslave/dp/state_machine.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>

namespace dpslave::dp {

/// A telegram already judged, or something that happened inside.
enum class Trigger : std::uint8_t {
    start,
    stop,
    set_slave_add,
    slave_diag,
    slave_diag_with_data,
    get_cfg,
    get_cfg_with_data,
    prm_short,    ///< fewer than seven octets
    prm_foreign,  ///< another master owns this slave
    prm_min_tsdr, ///< Lock_Req and Unlock_Req 0
    prm_unlock,
    prm_ok,          ///< Lock_Req, all checks passed, User_Prm_Data as at present
    prm_other_tags,  ///< Lock_Req, all checks passed, other User_Prm_Data
    prm_bad,         ///< Lock_Req, a check failed
    prm_unsupported, ///< Lock_Req, Sync or Freeze that the device does not have
    cfg_ok,          ///< of the owner: legal and as many as tags; in Data_Exch: the accepted octets
    cfg_bad,         ///< of the owner: anything else
    cfg_not_owner,
    data_ok,     ///< of the owner, as long as configured
    data_empty,  ///< of the owner, no data, and the device knows Fail_Safe
    data_length, ///< of the owner, any other length
    data_not_owner,
    read_inputs,
    read_outputs,
    read_back_with_data, ///< RD_Inp or RD_Outp with request data
    other_sap,
    control,          ///< Global_Control of the owner, two octets, for our group
    control_not_ours, ///< any other
    watchdog_expired,
    diagnosis_changed,
    inputs_ready, ///< every input was tried once, or the time for it is over
    drive_gone,   ///< while inputs are exchanged (X-51, diagnosis)
    count,
};

/// The kind of reply that is sent.
enum class Reply : std::uint8_t {
    none,
    sc,
    rs,
    rr,
    data,     ///< what the effect makes of it: DL, or SC when there is nothing to say
    exchange, ///< the same, but DH while a diagnosis is pending
};

enum class Effect : std::uint8_t {
    none,
    power_on,       ///< forget what was before
    read_diagnosis, ///< the owner's reading clears Diag_Pending, unless Stat_Diag
    read_configuration,
    take_min_tsdr,
    take_parameters, ///< Master_Add := SA; WD, min T_SDR, groups, User_Prm_Data
    log_foreign_prm,
    start_exchange,   ///< a new layout; outputs 0; Stat_Diag := 1 if there are inputs to wait for
    exchange,         ///< outputs received, inputs in the reply
    exchange_nothing, ///< outputs to their safe state, inputs in the reply
    read_inputs,
    read_outputs,
    control,          ///< Clear, Sync, Freeze
    set_diag_pending, ///< Diag_Pending := 1
    end_stat_diag,    ///< Stat_Diag := 0, Diag_Pending := 1
    begin_stat_diag,  ///< Stat_Diag := 1, Diag_Pending := 1; a frozen image is released
};

/// The bit of Slave_Diag that a refused telegram sets; the refusal is kept and logged.
enum class Fault : std::uint8_t { none, prm, not_supported, cfg };

/// A set of states or triggers.
template <class E>
class Set {
public:
    constexpr Set(E one) : bits_(bit(one)) {}
    constexpr Set(std::initializer_list<E> several)
    {
        for (const E one : several) bits_ |= bit(one);
    }
    static constexpr Set all_but(E one)
    {
        Set all{one};
        all.bits_ = ~all.bits_;
        return all;
    }
    constexpr bool has(E one) const { return (bits_ & bit(one)) != 0; }

private:
    static constexpr std::uint64_t bit(E one) { return std::uint64_t{1} << static_cast<unsigned>(one); }
    std::uint64_t bits_ = 0;
};

/// Carried out from left to right: the fault, the leave procedure L of 6.3, the effect, the new state.
struct Row {
    std::string_view id; ///< of wire reference 6.4; "-": a pair that 6.4 has no row for
    Set<State> in;
    Set<Trigger> on;
    Reply reply;
    Fault fault;
    LeaveReason leave; ///< none: L is not carried out
    Effect effect;
    std::optional<State> to; ///< nullopt: the state stays
};

inline constexpr State kPon = State::power_on;
inline constexpr State kWprm = State::wait_prm;
inline constexpr State kWcfg = State::wait_cfg;
inline constexpr State kDxch = State::data_exch;
inline constexpr Set<State> kAny3{kWprm, kWcfg, kDxch};

// clang-format off
inline constexpr auto kTable = [] {
    using enum Trigger;
    using T = Set<Trigger>;
    using S = Set<State>;
    using F = Fault;
    using L = LeaveReason;
    using E = Effect;
    constexpr std::nullopt_t kSame = std::nullopt;
    return std::to_array<Row>({
    // id    in               on                                  reply            fault             leave               effect                 to
    {"B1",   kPon,            start,                              Reply::none,     F::none,          L::none,            E::power_on,           kWprm},
    {"-",    kPon,            T::all_but(start),                  Reply::rs,       F::none,          L::none,            E::none,               kSame}, // no address is attached
    {"-",    kAny3,           start,                              Reply::none,     F::none,          L::none,            E::none,               kSame},
    {"B2",   kAny3,           stop,                               Reply::none,     F::none,          L::stop,            E::none,               kPon},
    {"S3",   kAny3,           set_slave_add,                      Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"D1",   kAny3,           slave_diag,                         Reply::data,     F::none,          L::none,            E::read_diagnosis,     kSame},
    {"D1",   kAny3,           slave_diag_with_data,               Reply::rr,       F::none,          L::none,            E::none,               kSame}, // 3.1
    {"D2",   kAny3,           get_cfg,                            Reply::data,     F::none,          L::none,            E::read_configuration, kSame},
    {"D3",   kAny3,           get_cfg_with_data,                  Reply::rr,       F::none,          L::none,            E::none,               kSame},
    {"P1",   kAny3,           prm_short,                          Reply::sc,       F::none,          L::none,            E::none,               kSame},
    {"P2",   kAny3,           prm_min_tsdr,                       Reply::sc,       F::none,          L::none,            E::take_min_tsdr,      kSame},
    {"P3",   kWprm,           T{prm_ok, prm_other_tags},          Reply::sc,       F::none,          L::none,            E::take_parameters,    kWcfg},
    {"P4",   kWprm,           prm_bad,                            Reply::sc,       F::prm,           L::none,            E::none,               kSame},
    {"P5",   kWprm,           prm_unsupported,                    Reply::sc,       F::not_supported, L::none,            E::none,               kSame},
    {"P6",   kWprm,           prm_unlock,                         Reply::sc,       F::none,          L::none,            E::none,               kSame},
    {"P7",   kWcfg,           T{prm_ok, prm_other_tags},          Reply::sc,       F::none,          L::none,            E::take_parameters,    kSame},
    {"P8",   S{kWcfg, kDxch}, prm_bad,                            Reply::sc,       F::prm,           L::prm_fault,       E::none,               kWprm},
    {"P8",   S{kWcfg, kDxch}, prm_unsupported,                    Reply::sc,       F::not_supported, L::not_supported,   E::none,               kWprm},
    {"P9",   kAny3,           prm_foreign,                        Reply::sc,       F::none,          L::none,            E::log_foreign_prm,    kSame}, // in Wait_Prm no master is foreign
    {"P10",  S{kWcfg, kDxch}, prm_unlock,                         Reply::sc,       F::none,          L::unlock,          E::none,               kWprm},
    {"P11",  kDxch,           prm_ok,                             Reply::sc,       F::none,          L::none,            E::take_parameters,    kSame},
    {"P12",  kDxch,           prm_other_tags,                     Reply::sc,       F::none,          L::new_parameters,  E::take_parameters,    kWcfg},
    {"C1",   kWprm,           T{cfg_ok, cfg_bad, cfg_not_owner},  Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"C2",   kWcfg,           cfg_ok,                             Reply::sc,       F::none,          L::none,            E::start_exchange,     kDxch},
    {"C3",   kWcfg,           cfg_bad,                            Reply::sc,       F::cfg,           L::cfg_fault,       E::none,               kWprm},
    {"C4",   kDxch,           cfg_ok,                             Reply::sc,       F::none,          L::none,            E::none,               kSame},
    {"C5",   kDxch,           cfg_bad,                            Reply::sc,       F::cfg,           L::cfg_fault,       E::none,               kWprm},
    {"C6",   S{kWcfg, kDxch}, cfg_not_owner,                      Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"X1",   S{kWprm, kWcfg}, T{data_ok, data_empty, data_length, data_not_owner},
                                                                  Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"X2",   kDxch,           data_ok,                            Reply::exchange, F::none,          L::none,            E::exchange,           kSame},
    {"X3",   kDxch,           data_empty,                         Reply::exchange, F::none,          L::none,            E::exchange_nothing,   kSame},
    {"X4",   kDxch,           data_length,                        Reply::rs,       F::none,          L::output_length,   E::none,               kWprm},
    {"X5",   kDxch,           data_not_owner,                     Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"R1",   kDxch,           read_inputs,                        Reply::data,     F::none,          L::none,            E::read_inputs,        kSame},
    {"R1",   kDxch,           read_outputs,                       Reply::data,     F::none,          L::none,            E::read_outputs,       kSame},
    {"R2",   kDxch,           read_back_with_data,                Reply::rr,       F::none,          L::none,            E::none,               kSame},
    {"R3",   S{kWprm, kWcfg}, T{read_inputs, read_outputs, read_back_with_data},
                                                                  Reply::rs,       F::none,          L::none,            E::none,               kSame},
    {"G1",   kDxch,           control,                            Reply::none,     F::none,          L::none,            E::control,            kSame},
    {"G2",   kDxch,           control_not_ours,                   Reply::none,     F::none,          L::none,            E::none,               kSame},
    {"G2",   S{kWprm, kWcfg}, T{control, control_not_ours},       Reply::none,     F::none,          L::none,            E::none,               kSame},
    {"W1",   S{kWcfg, kDxch}, watchdog_expired,                   Reply::none,     F::none,          L::watchdog,        E::none,               kWprm},
    {"-",    kWprm,           watchdog_expired,                   Reply::none,     F::none,          L::none,            E::none,               kSame}, // it is off there
    {"A1",   S{kWcfg, kDxch}, diagnosis_changed,                  Reply::none,     F::none,          L::none,            E::set_diag_pending,   kSame}, // Wait_Cfg has an owner too
    {"-",    kWprm,           diagnosis_changed,                  Reply::none,     F::none,          L::none,            E::none,               kSame}, // there is no owner
    {"A2",   kDxch,           inputs_ready,                       Reply::none,     F::none,          L::none,            E::end_stat_diag,      kSame},
    {"-",    S{kWprm, kWcfg}, inputs_ready,                       Reply::none,     F::none,          L::none,            E::none,               kSame},
    {"A4",   kDxch,           drive_gone,                         Reply::none,     F::none,          L::none,            E::begin_stat_diag,    kSame},
    {"-",    S{kWprm, kWcfg}, drive_gone,                         Reply::none,     F::none,          L::none,            E::none,               kSame},
    {"M2",   kAny3,           other_sap,                          Reply::rs,       F::none,          L::none,            E::none,               kSame},
    });
}();
// clang-format on

inline constexpr std::size_t kStates = 4;
static_assert(kStates == static_cast<std::size_t>(State::data_exch) + 1);
inline constexpr std::size_t kTriggers = static_cast<std::size_t>(Trigger::count);

/// Every pair of state and trigger has exactly one row: a forgotten case does not compile.
consteval bool is_total()
{
    for (std::size_t s = 0; s < kStates; ++s)
        for (std::size_t t = 0; t < kTriggers; ++t) {
            int rows = 0;
            for (const Row& row : kTable)
                if (row.in.has(static_cast<State>(s)) && row.on.has(static_cast<Trigger>(t))) ++rows;
            if (rows != 1) return false;
        }
    return true;
}
static_assert(is_total());

/// The table by state and trigger, so that a telegram costs one look-up.
inline constexpr auto kRowNumber = [] {
    std::array<std::array<std::uint8_t, kTriggers>, kStates> numbers{};
    for (std::size_t s = 0; s < kStates; ++s)
        for (std::size_t t = 0; t < kTriggers; ++t)
            for (std::size_t r = 0; r < kTable.size(); ++r)
                if (kTable[r].in.has(static_cast<State>(s)) && kTable[r].on.has(static_cast<Trigger>(t)))
                    numbers[s][t] = static_cast<std::uint8_t>(r);
    return numbers;
}();

/// The one row for this pair.
constexpr const Row& row_of(State in, Trigger on)
{
    return kTable[kRowNumber[static_cast<std::size_t>(in)][static_cast<std::size_t>(on)]];
}

} // namespace dpslave::dp
