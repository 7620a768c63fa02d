// SPDX-License-Identifier: Apache-2.0
/// Finds out whether records begin in the middle of a telegram. Nothing says that they do: the octets decide.
/// It is pure. Source: wire reference 2.1.
#pragma once

#include "dpslave/base/bytes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace dpslave::trace {

/// The kind of octets or silence after these octets.
enum class Behind : std::uint8_t {
    more,    ///< perhaps more of them
    silence, ///< something that is none of a telegram
    gap,     ///< records are missing, so a telegram may break off
};

/// Returns how many of the octets after a gap are the end of a telegram that began in it. The result 0 means
/// that they begin with a complete telegram, or with octets that are none. It is nullopt if more octets are
/// needed, which is never so before silence or a gap.
///
/// It is the end of a telegram if it is shorter than one, ends with the end delimiter (of a token: is one or
/// two addresses), and if complete telegrams follow it up to one with a right checksum. Telegrams that are
/// damaged in their contents only may be among them: they are flaws of their own. Octets that cannot be
/// distinguished from such an end, a damaged telegram of fixed length at the very begin for example, count as
/// one.
std::optional<std::size_t> cut_off(Bytes octets, Behind behind);

} // namespace dpslave::trace
