// SPDX-License-Identifier: Apache-2.0
/// The three families of devices as a master knows them: written from the manuals, without the profile. All
/// cases use one mapping: two inputs and four outputs of a word each, so that Chk_Cfg has six octets and
/// Data_Exchange eight, as SD3 needs.
#pragma once

#include "support/wire.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace conformance {

using test::Octets;

inline constexpr std::array<std::uint16_t, 2> kInputTags{55, 57};
inline constexpr std::array<std::uint16_t, 4> kOutputTags{56, 62, 70, 71};
/// The inputs of the drive when it is switched on.
inline constexpr std::array<std::uint16_t, 2> kInputsAtStart{0x1234, 0x5678};

/// The tags of `all_user_prm`: the drive has them, because a station does not start with a tag that its drive
/// denies.
inline constexpr std::uint16_t kFirstNumberedTag = 100;
inline constexpr std::size_t kMostNumberedTags = 109;

struct Family {
    const char* name;    ///< "option board"
    const char* suite;   ///< "OptionBoard"
    const char* profile; ///< of those that are shipped
    std::uint16_t ident;
    bool has_own_ident; ///< no source states it: the station sets it
    bool sync_and_freeze;
    bool both_ways;      ///< it has the identifier 70: a word that is read and written
    bool dpv1_status;    ///< three octets stand before the tags
    Octets user_prm;     ///< the mapping
    Octets bad_user_prm; ///< one that the device cannot have
    Octets all_user_prm; ///< a mapping of as many words as the device can have, with Demand Data
    Octets all_cfg;
    Octets healthy; ///< extended diagnosis without a fault; empty: the device has none
    Octets faulty;  ///< the same with the fault of SlaveAtWire::report_fault
    std::size_t most_diag;

    bool has_diagnosis() const { return !healthy.empty(); }
};

const std::array<Family, 3>& families();

/// Cfg_Data of the mapping.
Octets cfg();

/// What Data_Exchange has in each direction with this Cfg_Data, in octets.
struct Lengths {
    std::size_t inputs = 0;
    std::size_t outputs = 0;
};
Lengths lengths_of(const Octets& cfg);

} // namespace conformance
