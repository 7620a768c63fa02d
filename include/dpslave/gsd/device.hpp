// SPDX-License-Identifier: Apache-2.0
/// A slave as a GSD file describes it, and the file itself.
#pragma once

#include "dpslave/base/units.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace dpslave::gsd {

/// Limits of the standard that a Device must keep (wire reference 9.2).
inline constexpr std::size_t kMaxText = 32; ///< characters of a name
inline constexpr std::size_t kMaxLine = 80; ///< characters of a line
/// Identifier octets of one module that tools of every GSD_Revision take (wire reference 9.2).
inline constexpr std::size_t kMaxModuleOctets = 17;
inline constexpr std::size_t kMaxDescription = 256; ///< characters of Info_Text, whose line may be longer

struct DeviceModule {
    std::string name; ///< at most kMaxText characters
    std::vector<std::uint8_t> identifiers;
};

/// Texts are Latin-1 (see latin1()). A key with a default value here is in every file that this project
/// writes.
struct Device {
    std::vector<std::string> comments; ///< for the head of the file, one paragraph each; folded to kMaxLine

    std::string vendor, model, revision, hardware, software;
    std::string description; ///< Info_Text; empty = the keyword is left out
    std::uint16_t ident = 0;
    std::uint8_t family = 0; ///< Slave_Family
    /// Per rate in the order of kBauds, T_bit; 0 = the keyword of this rate is left out.
    std::array<Tbit, kBauds.size()> max_tsdr{};
    std::uint8_t repeater = 0; ///< Repeater_Ctrl_Sig
    bool freeze = false, sync = false, fail_safe = false;
    std::uint16_t min_slave_interval = 0; ///< 100 us
    std::uint8_t max_diag_length = 6;

    std::vector<std::string>
        prm_comments; ///< what the octets of User_Prm_Data mean; one line each, cut to kMaxLine
    std::vector<std::uint8_t> user_prm_data;

    /// true: the master's tool puts the modules together. false: they are the mapping; one is a compact
    /// station, more are plugged from the start and fixed.
    bool choice_of_modules = true;
    std::uint8_t max_module = 0;
    std::uint8_t max_in = 0, max_out = 0; ///< octets
    std::uint16_t max_data = 0;
    std::vector<DeviceModule> modules;
};

/// The file: GSD_Revision 3, CR LF, lines of at most kMaxLine characters, the same octets for the same
/// device.
std::string write(const Device& device);

/// `utf8` in the character set of a GSD; what is not in it becomes "?", a double quote a single one, a
/// control character a blank.
std::string latin1(std::string_view utf8);

} // namespace dpslave::gsd
