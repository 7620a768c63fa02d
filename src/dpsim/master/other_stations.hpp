// SPDX-License-Identifier: Apache-2.0
/// Makes the telegrams of the other stations of a busy bus: exchanges of the same master with slaves from
/// address kFirstOther on. Each telegram has a running number, so that no two are equal. It is pure.
#pragma once

#include "dpsim/common/telegram.hpp"

namespace dpslave::sim {

inline constexpr std::uint8_t kFirstOther = 90;

class OtherStations {
public:
    /// `count` exchanges, each a request and its reply, without a pause. `count` up to 32.
    Octets exchanges(std::uint8_t master, unsigned count);

private:
    std::uint32_t number_ = 0; ///< of the next exchange
};

} // namespace dpslave::sim
