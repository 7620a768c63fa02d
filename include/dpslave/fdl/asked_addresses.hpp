// SPDX-License-Identifier: Apache-2.0
/// Addresses that masters ask and that do not answer: shows that a master's project has another address
/// than the slave. Pure; allocates nothing.
#pragma once

#include "dpslave/base/units.hpp"
#include "dpslave/fdl/telegram.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace dpslave::fdl {

/// One of them. Requests count since the last answer of this address.
struct UnansweredAddress {
    std::uint8_t address = 0;
    std::uint8_t master = 0;    ///< the last one that asked
    std::uint32_t requests = 0; ///< 0: this place of a list is empty
    Instant last{};             ///< when it was asked last
};

class AskedAddresses {
public:
    /// How many are reported at most: those with the most requests.
    static constexpr std::size_t kMostReported = 4;
    using List = std::array<UnansweredAddress, kMostReported>;

    /// A valid telegram, from any station. FDL_Status does not count: masters ask every free address for it;
    /// nor does what needs no answer. An SC answers the request right before it.
    void on_telegram(const Telegram& telegram, Instant at);
    /// Those that did not answer, the most asked first.
    List unanswered() const;

private:
    struct Asked {
        std::uint8_t by = 0;
        std::uint32_t requests = 0;
        Instant last{};
    };
    void answered(std::uint8_t address) { asked_[address].requests = 0; }

    std::array<Asked, 127> asked_{};
    std::optional<std::uint8_t> last_; ///< whom the newest telegram asks
};

} // namespace dpslave::fdl
