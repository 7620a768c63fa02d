// SPDX-License-Identifier: Apache-2.0
/// The settings of a master, what it can ask, and what it counts.
#pragma once

#include "dpsim/common/telegram.hpp"

#include "dpslave/base/units.hpp"

namespace dpslave::sim {

/// First identifier of a Cfg_Data with Demand Data.
inline constexpr std::uint8_t kDemandIdentifier = 0x73;

struct MasterSettings {
    Baud baud = Baud::k187_5;
    std::uint8_t address = 2;
    std::uint8_t slave = 5;
    std::uint16_t ident = 0x0533;
    Octets user_prm = Octets(24, 0); ///< User_Prm_Data
    Octets cfg{kDemandIdentifier};   ///< Cfg_Data, identifier octets
    /// 0 = off; rounded up to a product of two factors and 10 ms.
    std::chrono::milliseconds watchdog{1000};
    std::uint8_t min_tsdr = 11; ///< bit times
    std::uint8_t group = 0x01;  ///< Group_Ident, a bit per group
    bool sync = true;           ///< ask for Sync in Set_Prm
    bool freeze = true;         ///< ask for Freeze
    Fixed fixed = Fixed::never; ///< SD3 for data units of eight octets
    unsigned others = 0;        ///< exchanges of other stations before each request
    unsigned retries = 1;       ///< repetitions of a request that got no valid answer
    std::chrono::nanoseconds cycle = std::chrono::milliseconds{10}; ///< from one cyclic request to the next
    /// On top of the slot time, for the jitter of a host.
    std::chrono::nanoseconds allowance = std::chrono::milliseconds{20};
};

/// The number of octets that a configuration carries in each direction; or why it cannot be one.
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

/// The result of one order.
struct Answer {
    Service service = Service::slave_diag;
    std::optional<Frame> frame; ///< nullopt: no answer, or an invalid one
    Octets octets;              ///< as heard
    std::string words;          ///< a sentence
};

struct MasterCounters {
    std::uint64_t others = 0;         ///< exchanges of other stations
    std::uint64_t cycles = 0;         ///< Data_Exchange with a valid answer
    std::uint64_t retries = 0;        ///< requests sent again
    std::uint64_t missing = 0;        ///< requests without a valid answer after all retries
    std::uint64_t invalid = 0;        ///< answers with a flaw
    std::uint64_t unasked_octets = 0; ///< heard while nothing was asked
    std::uint64_t refused = 0;        ///< UE, RR, RS
    std::uint64_t diagnosis_reads = 0;
    std::uint64_t diagnosis_pending = 0; ///< Data_Exchange answers with DH
    std::uint64_t exchanges_lost = 0;    ///< times that Data_Exch was left that were not ordered here
    /// Data_Exchange: handed over until answer complete.
    std::chrono::nanoseconds answer_min{0}, answer_max{0}, answer_sum{0};
};

/// The counters in two to four lines.
std::vector<std::string> in_words(const MasterCounters& counters);

} // namespace dpslave::sim
