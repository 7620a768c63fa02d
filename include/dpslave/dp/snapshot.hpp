// SPDX-License-Identifier: Apache-2.0
/// Everything that can be seen of a slave, as one plain value that may cross between threads (Mailbox).
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/base/units.hpp"
#include "dpslave/dp/demand_data.hpp"
#include "dpslave/dp/refusal.hpp"
#include "dpslave/dp/slave_diag.hpp"
#include "dpslave/dp/state.hpp"

#include <array>
#include <chrono>
#include <cstdint>

namespace dpslave::dp {

/// Telegrams by service, for `dpctl counters`. All count upwards from the start of the program.
struct Counters {
    std::uint64_t data_exchange = 0; ///< carried out; the others: received
    std::uint64_t slave_diag = 0;
    std::uint64_t set_prm = 0;
    std::uint64_t foreign_prm = 0; ///< those of them that another master sent than the owner
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
    std::uint64_t orders_lost = 0; ///< Demand Data orders and LeftDataExchange that were not fetched in time
};

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
    StartHold hold = StartHold::none; ///< why Stat_Diag stands, where it is no longer waited for an answer
    bool diag_pending = false;
    ByteBuffer<244> diagnosis; ///< as Slave_Diag would answer now
    ByteBuffer<244> prm; ///< the last Set_Prm seen, accepted or not; those of foreign masters do not count
    ByteBuffer<244> cfg; ///< the last Chk_Cfg seen, likewise
    LeaveReason left_because = LeaveReason::none; ///< the last time
    RefusalDetail refusal{}; ///< of the last refused telegram; cleared by the next accepted one of its kind
    Layout layout{};
    bool demand_data = false; ///< Demand Data comes before the parameters
    bool may_write = false;
    std::array<std::uint16_t, kMaxParameters> inputs{};  ///< as sent (frozen under Freeze)
    std::array<std::uint16_t, kMaxParameters> outputs{}; ///< active (after Sync and Clear)
    DemandRegisters demand_request{};                    ///< as received
    DemandRegisters demand_reply{};                      ///< as sent
    DemandOrder demand_order{};                          ///< the one in force; `cancel`: none
    Counters counters{};
};

} // namespace dpslave::dp
