// SPDX-License-Identifier: Apache-2.0
/// A slave at a wire with two masters, and what most cases of conformance begin with.
#pragma once

#include "family.hpp"
#include "slave_at_wire.hpp"

#include <string>

namespace conformance {

using test::Master;
using test::Saps;

/// The seven octets of Set_Prm before User_Prm_Data, as the cases change them.
struct PrmHeader {
    std::uint8_t status = 0x88;                ///< lock, watchdog on
    std::uint8_t factor_1 = 50, factor_2 = 10; ///< 5 s: no case waits for it
    std::uint8_t min_tsdr = 0;
    std::uint8_t group = 0;
};

/// Octets 1 to 4 of Slave_Diag in the states; the owner has address 2.
inline constexpr const char* kWaitPrm = "02 05 00 FF";
inline constexpr const char* kWaitCfg = "02 0C 00 02";
inline constexpr const char* kExchanging = "00 0C 00 02";
inline constexpr const char* kExchangingUnguarded = "00 04 00 02"; ///< watchdog off

class Bench {
public:
    Bench(const Family& of, SlaveAtWire& at_wire) : family(of), slave(at_wire) {}

    const Family& family;
    SlaveAtWire& slave;
    Master owner{slave, 2};
    Master foreign{slave, 9};

    Octets prm(const PrmHeader& header = {}) const { return prm(header, family.user_prm); }
    Octets prm(const PrmHeader& header, const Octets& user) const;

    /// Wait_Cfg, owned by `owner`.
    testing::AssertionResult parameterise(const PrmHeader& header = {});
    /// Data_Exch, the inputs read, nothing pending; the outputs were not sent yet.
    testing::AssertionResult start_up(const PrmHeader& header = {});
    /// The same, and the outputs of the owner are `outputs`.
    testing::AssertionResult exchange(const Octets& outputs, const PrmHeader& header = {});
    /// Set_Prm and Chk_Cfg of another mapping, until Stat_Diag ends.
    testing::AssertionResult start_up(const PrmHeader& header, const Octets& user, const Octets& cfg);
    /// The owner reads diagnosis until Stat_Diag ends.
    testing::AssertionResult becomes_ready();

    /// In Data_Exch: T_WD becomes 100 ms. A start-up takes longer on a loaded machine.
    void shorten_the_watchdog();
    /// The owner is silent for longer than its watchdog.
    void let_the_watchdog_expire();

    /// Octets 1 to 4 of Slave_Diag as `who` reads it: "02 05 00 FF".
    std::string diag(Master& who);
    std::string diag() { return diag(foreign); } ///< the owner's pending flag stays
};

/// Words as octets of a telegram, the high octet first.
Octets words(const std::vector<std::uint16_t>& all);
/// "DL 12 34 ..." for these words.
std::string dl(const std::vector<std::uint16_t>& all);
/// The same with diagnosis pending.
std::string dh(const std::vector<std::uint16_t>& all);

/// The inputs as they are when the drive is switched on.
std::string inputs_at_start();

} // namespace conformance
