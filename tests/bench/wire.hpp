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

inline constexpr std::uint8_t kSlave = 5; ///< the first station of a daemon
inline constexpr std::uint8_t kMaster = 2;
inline constexpr std::uint8_t kOtherStation = 100; ///< an address that no station has

/// What a station exchanges beside Demand Data.
enum class Words : std::uint8_t {
    all_read,     ///< twelve parameters are read: 8 octets out, 32 in
    half_written, ///< six are read and six written: 20 octets each way
};
std::size_t inputs_of(Words words); ///< octets, with Demand Data

/// SD2 with the FCS worked out; `body` begins with DA.
Octets sd2(const Octets& body);

Octets slave_diag(std::uint8_t address, std::uint8_t fc);
Octets set_prm(std::uint8_t address, std::uint8_t fc); ///< twelve tags, watchdog 10 s, min T_SDR 11
Octets chk_cfg(std::uint8_t address, std::uint8_t fc, Words words); ///< 73 and twelve times 50, or 60 and 50
/// No Demand Data is asked for. `value` goes into each word that is written.
Octets data_exchange(std::uint8_t address, std::uint8_t fc, Words words = Words::all_read,
                     std::uint16_t value = 0);
Octets data_exchange_reply(std::uint8_t inputs); ///< of kSlave, all_read: FC 08, every input octet `inputs`

/// How many octets the telegram that begins with `head` has; 0: not known yet, or no SD2 and no SC.
std::size_t length_of(std::span<const std::uint8_t> head);

/// A reply of Data_Exchange from `address` to the master with so many octets of input, DL or DH.
bool is_data_exchange_reply(std::span<const std::uint8_t> frame, std::uint8_t address, std::size_t inputs);

/// User data of a Slave_Diag reply: the six octets of the standard part and what follows; empty if it is
/// none.
std::span<const std::uint8_t> diagnosis_in(std::span<const std::uint8_t> frame, std::uint8_t address);

} // namespace dpslave::bench
