// SPDX-License-Identifier: Apache-2.0
/// The two registers of a tag in the IEEE area of the 2000 series, and the 16 bits that PROFIBUS has for it.
/// Pure. Source: EI-ASCII and Modbus reference, section 5.
#pragma once

#include "dpslave/drive/tag.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace dpslave::modbus {

/// Registers of a row from here on are the IEEE area.
inline constexpr std::uint16_t kIeeeArea = 0x8000;

using IeeePair = std::array<std::uint16_t, 2>; ///< in the order of the registers: high word first

bool is_ieee(const drive::Tag& tag);

/// Returns for a REAL the value in counts of the row's decimals, rounded to nearest, ties away from zero
/// as the value is written in decimal: 0.35 with one decimal is 4 counts, whatever the single makes
/// of it. It is nullopt if the value does not fit 16 bits. Everything else lies in the first register as it
/// is; times, which take both as milliseconds, are not read from here (the tag table refuses such rows).
std::optional<std::uint16_t> word_of(const drive::Tag& tag, IeeePair pair);
IeeePair pair_of(const drive::Tag& tag, std::uint16_t word);

/// Returns for the log why word_of() is nullopt: a sentence with the value that the drive itself has.
std::string ieee_flaw(const drive::Tag& tag, IeeePair pair);

} // namespace dpslave::modbus
