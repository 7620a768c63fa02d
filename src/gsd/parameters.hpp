// SPDX-License-Identifier: Apache-2.0
/// ExtUserPrmData: the new style of user parameters (wire reference 9.1).
#pragma once

#include "dpslave/gsd/document.hpp"

#include <cstdint>
#include <map>
#include <optional>

namespace dpslave::gsd {

/// `Unsigned16 100 0-1000`: type, default and legal values of one ExtUserPrmData.
struct ParameterType {
    std::size_t octets = 1;
    std::uint8_t bits = 0xFF;   ///< that it takes of its octet, where it takes one
    unsigned shift = 0;         ///< of its lowest bit
    std::int64_t value = 0;     ///< the default
    bool value_is_legal = true; ///< it lies in the type and among the legal values
};
/// Returns nullopt if the line has no type.
std::optional<ParameterType> parameter_type(const Entry& line);

/// Those of a file by their reference numbers. The first of equal numbers counts.
std::map<std::uint32_t, ParameterType> parameter_types(const Document& document);
/// Returns the reference number of a block ExtUserPrmData or PrmText; nullopt if it has none.
std::optional<std::uint32_t> reference_of(const Block& block);

} // namespace dpslave::gsd
