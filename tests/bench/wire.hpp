// SPDX-License-Identifier: Apache-2.0
/// The master's side of the wire, by a hand that shares nothing with the daemon's rooms.
/// Source: wire reference 2.1 (SD2), 4.1 (SAPs), 4.4 (Set_Prm), 4.5 (Chk_Cfg); HA389815 ch. 6.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dpslave::bench {

using Octets = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kSlave = 5;
inline constexpr std::uint8_t kMaster = 2;
inline constexpr std::size_t kOutputs = 8; ///< Demand Data
inline constexpr std::size_t kInputs = 32; ///< Demand Data and twelve parameters that are read

/// SD2 with the FCS worked out; `body` begins with DA.
Octets sd2(const Octets& body);

Octets slave_diag(std::uint8_t fc);
Octets set_prm(std::uint8_t fc);                 ///< twelve tags, watchdog 10 s, min T_SDR 11
Octets chk_cfg(std::uint8_t fc);                 ///< 73 and twelve times 50
Octets data_exchange(std::uint8_t fc);           ///< eight octets out: no Demand Data asked for
Octets data_exchange_reply(std::uint8_t inputs); ///< FC 08, every input octet `inputs`

/// How many octets the telegram that begins with `head` has; 0: not known yet, or no SD2 and no SC.
std::size_t length_of(std::span<const std::uint8_t> head);

/// A reply of Data_Exchange from the slave to the master with 32 octets of input, DL or DH.
bool is_data_exchange_reply(std::span<const std::uint8_t> frame);

/// User data of a Slave_Diag reply: the six octets of the standard part and what follows; empty if it is
/// none.
std::span<const std::uint8_t> diagnosis_in(std::span<const std::uint8_t> frame);

} // namespace dpslave::bench
