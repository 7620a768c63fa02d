// SPDX-License-Identifier: Apache-2.0
/// The state machine of a DP slave as a table: which telegram or happening does what in which state. The rows
/// carry the names of wire reference 6.4, so that a reviewer lays the two side by side.
///
/// Rows of 6.4 that are not here: F1 and F2 (FDL status, retries) are layer 2's; S1 and S2 need
/// Set_Slave_Add, which no personality has, so S3 is the row; W2 (a silent master, watchdog off) is the
/// absence of any trigger; A3 (the application lost a module) is told by diagnosis, that is by A1; M1 needs
/// DP-V1.
#pragma once

#include "dpslave/dp/slave.hpp"

#include <array>
#include <cstdint>
#include <initializer_list>
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
    count,
};

/// What goes back. `data`: what the effect makes of it (DL, DH, or SC when there is nothing to say).
enum class Reply : std::uint8_t { none, sc, rs, rr, data };

enum class Effect : std::uint8_t {
    none,
    power_on,       ///< forget what was before
    leave_stop,     ///< L(stop); "L" is the leave procedure of 6.3
    tell_diagnosis, ///< the owner's reading clears Diag_Pending, unless Stat_Diag
    tell_configuration,
    take_min_tsdr,
    take_parameters,     ///< Master_Add := SA; WD, min T_SDR, groups, User_Prm_Data
    renew_parameters,    ///< L(), then take_parameters
    fail_parameters,     ///< Prm_Fault := 1
    fail_supported,      ///< Not_Supported := 1
    leave_parameters,    ///< L(prm)
    leave_supported,     ///< L(unsupported)
    leave_unlock,        ///< L(unlock)
    start_exchange,      ///< a new layout; outputs 0; Stat_Diag := 1 if there are inputs to wait for
    leave_configuration, ///< L(cfg)
    exchange,            ///< outputs taken, inputs told
    exchange_empty,      ///< outputs to their safe state, inputs told
    leave_length,        ///< L(length)
    tell_inputs,
    tell_outputs,
    obey_control,
    leave_watchdog, ///< L(wd)
    tell_owner,     ///< Diag_Pending := 1
    make_ready,     ///< Stat_Diag := 0, Diag_Pending := 1
};

enum class To : std::uint8_t { same, power_on, wait_prm, wait_cfg, data_exch };

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

struct Row {
    std::string_view id; ///< of wire reference 6.4; "-": a pair that 6.4 has no row for
    Set<State> in;
    Set<Trigger> on;
    Reply reply;
    Effect effect;
    To to;
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
    return std::to_array<Row>({
    // id    in               on                                  reply        effect                        to
    {"B1",   kPon,            start,                              Reply::none, Effect::power_on,             To::wait_prm},
    {"-",    kPon,            T::all_but(start),                  Reply::rs,   Effect::none,                 To::same}, // nobody is attached
    {"-",    kAny3,           start,                              Reply::none, Effect::none,                 To::same},
    {"B2",   kAny3,           stop,                               Reply::none, Effect::leave_stop,           To::power_on},
    {"S3",   kAny3,           set_slave_add,                      Reply::rs,   Effect::none,                 To::same},
    {"D1",   kAny3,           slave_diag,                         Reply::data, Effect::tell_diagnosis,       To::same},
    {"D1",   kAny3,           slave_diag_with_data,               Reply::rr,   Effect::none,                 To::same}, // 3.1
    {"D2",   kAny3,           get_cfg,                            Reply::data, Effect::tell_configuration,   To::same},
    {"D3",   kAny3,           get_cfg_with_data,                  Reply::rr,   Effect::none,                 To::same},
    {"P1",   kAny3,           prm_short,                          Reply::sc,   Effect::none,                 To::same},
    {"P2",   kAny3,           prm_min_tsdr,                       Reply::sc,   Effect::take_min_tsdr,        To::same},
    {"P3",   kWprm,           T{prm_ok, prm_other_tags},          Reply::sc,   Effect::take_parameters,      To::wait_cfg},
    {"P4",   kWprm,           prm_bad,                            Reply::sc,   Effect::fail_parameters,      To::same},
    {"P5",   kWprm,           prm_unsupported,                    Reply::sc,   Effect::fail_supported,       To::same},
    {"P6",   kWprm,           prm_unlock,                         Reply::sc,   Effect::none,                 To::same},
    {"P7",   kWcfg,           T{prm_ok, prm_other_tags},          Reply::sc,   Effect::take_parameters,      To::same},
    {"P8",   S{kWcfg, kDxch}, prm_bad,                            Reply::sc,   Effect::leave_parameters,     To::wait_prm},
    {"P8",   S{kWcfg, kDxch}, prm_unsupported,                    Reply::sc,   Effect::leave_supported,      To::wait_prm},
    {"P9",   kAny3,           prm_foreign,                        Reply::sc,   Effect::none,                 To::same}, // in Wait_Prm nobody is foreign
    {"P10",  S{kWcfg, kDxch}, prm_unlock,                         Reply::sc,   Effect::leave_unlock,         To::wait_prm},
    {"P11",  kDxch,           prm_ok,                             Reply::sc,   Effect::take_parameters,      To::same},
    {"P12",  kDxch,           prm_other_tags,                     Reply::sc,   Effect::renew_parameters,     To::wait_cfg},
    {"C1",   kWprm,           T{cfg_ok, cfg_bad, cfg_not_owner},  Reply::rs,   Effect::none,                 To::same},
    {"C2",   kWcfg,           cfg_ok,                             Reply::sc,   Effect::start_exchange,       To::data_exch},
    {"C3",   kWcfg,           cfg_bad,                            Reply::sc,   Effect::leave_configuration,  To::wait_prm},
    {"C4",   kDxch,           cfg_ok,                             Reply::sc,   Effect::none,                 To::same},
    {"C5",   kDxch,           cfg_bad,                            Reply::sc,   Effect::leave_configuration,  To::wait_prm},
    {"C6",   S{kWcfg, kDxch}, cfg_not_owner,                      Reply::rs,   Effect::none,                 To::same},
    {"X1",   S{kWprm, kWcfg}, T{data_ok, data_empty, data_length, data_not_owner},
                                                                  Reply::rs,   Effect::none,                 To::same},
    {"X2",   kDxch,           data_ok,                            Reply::data, Effect::exchange,             To::same},
    {"X3",   kDxch,           data_empty,                         Reply::data, Effect::exchange_empty,       To::same},
    {"X4",   kDxch,           data_length,                        Reply::rs,   Effect::leave_length,         To::wait_prm},
    {"X5",   kDxch,           data_not_owner,                     Reply::rs,   Effect::none,                 To::same},
    {"R1",   kDxch,           read_inputs,                        Reply::data, Effect::tell_inputs,          To::same},
    {"R1",   kDxch,           read_outputs,                       Reply::data, Effect::tell_outputs,         To::same},
    {"R2",   kDxch,           read_back_with_data,                Reply::rr,   Effect::none,                 To::same},
    {"R3",   S{kWprm, kWcfg}, T{read_inputs, read_outputs, read_back_with_data},
                                                                  Reply::rs,   Effect::none,                 To::same},
    {"G1",   kDxch,           control,                            Reply::none, Effect::obey_control,         To::same},
    {"G2",   kDxch,           control_not_ours,                   Reply::none, Effect::none,                 To::same},
    {"G2",   S{kWprm, kWcfg}, T{control, control_not_ours},       Reply::none, Effect::none,                 To::same},
    {"W1",   S{kWcfg, kDxch}, watchdog_expired,                   Reply::none, Effect::leave_watchdog,       To::wait_prm},
    {"-",    kWprm,           watchdog_expired,                   Reply::none, Effect::none,                 To::same}, // it is off there
    {"A1",   S{kWcfg, kDxch}, diagnosis_changed,                  Reply::none, Effect::tell_owner,           To::same}, // Wait_Cfg has an owner too
    {"-",    kWprm,           diagnosis_changed,                  Reply::none, Effect::none,                 To::same}, // nobody to tell
    {"A2",   kDxch,           inputs_ready,                       Reply::none, Effect::make_ready,           To::same},
    {"-",    S{kWprm, kWcfg}, inputs_ready,                       Reply::none, Effect::none,                 To::same},
    {"M2",   kAny3,           other_sap,                          Reply::rs,   Effect::none,                 To::same},
    });
}();
// clang-format on

inline constexpr std::size_t kStates = 4;
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

/// The one row for this pair.
const Row& row_of(State in, Trigger on);

} // namespace dpslave::dp
