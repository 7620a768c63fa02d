// SPDX-License-Identifier: Apache-2.0
/// Says whether a transceiver hears what it sends: the key `echo` of [bus] and of [[line]].
#pragma once

#include <cstdint>

namespace dpslave {

enum class EchoMode : std::uint8_t {
    off,       ///< there is no echo
    on,        ///< each transmission has its echo
    automatic, ///< the first transmissions show whether there is one
};

} // namespace dpslave
