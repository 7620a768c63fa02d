// SPDX-License-Identifier: Apache-2.0
/// Demand Data: access to any tag through the first eight octets of the cyclic exchange.
/// Source: HA389815 ch. 7; 2408f/2404f handbook ch. 7; rows, C-060 to C-069.
#pragma once

#include "dpslave/base/process_image.hpp"
#include "dpslave/base/queue.hpp"
#include "dpslave/dp/personality.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace dpslave::dp {

/// The error code of Demand Data for a failed access, 0 to 2; nothing where no code stands for it (success,
/// silence, noise). Source: HA389815 ch. 7; for the finer reasons rows X-34.
std::optional<std::uint16_t> demand_code(AccessError error) noexcept;

/// The eight octets as words: command and tag, extended tag, reserved, value or error code.
using DemandRegisters = std::array<std::uint16_t, 4>;

class DemandData {
public:
    explicit DemandData(const Personality& personality) : personality_(&personality) {}

    /// A layout with Demand Data begins: nothing is asked, the reply is 0.
    void begin(Generation generation);
    /// The layout ended: a standing order is cancelled, and a write that was not fetched yet is
    /// dropped.
    void end();

    /// The registers that are active now. Only a change makes an order.
    void request(const DemandRegisters& registers);
    /// Takes the result of an order; it is dropped if the order is no longer in force.
    void answer(const DemandAnswer& answer);

    const DemandRegisters& reply() const { return reply_; }
    const DemandOrder& standing() const { return standing_; } ///< `cancel`: none is in force
    std::optional<DemandOrder> take_order() { return orders_.pop(); }

    std::uint64_t orders() const { return ordered_; }   ///< reads and writes ordered
    std::uint64_t rejects() const { return rejected_; } ///< replies that became 7
    std::uint64_t lost() const { return lost_; }        ///< orders that were not fetched in time

private:
    /// The order of the master; the parts of the registers that do not matter for its command are 0.
    struct Wanted {
        std::uint8_t command = 0;
        std::uint16_t tag_field = 0;
        std::uint16_t extended_tag = 0;
        std::uint16_t value = 0;
        friend bool operator==(const Wanted&, const Wanted&) = default;
    };
    Wanted wanted_by(const DemandRegisters& registers) const;
    void give(DemandOrder::Kind kind);
    void withdraw();
    bool is_extended_form() const;
    bool as_example() const;
    std::uint16_t tag_echo() const;
    void accept(std::uint16_t value);
    void reject(std::uint16_t code);
    void reply_with(std::uint16_t first, std::uint16_t value);

    const Personality* personality_;
    Generation generation_ = 0;
    Wanted wanted_{};
    DemandOrder standing_{}; ///< the order given last; `cancel` = none is in force
    DemandRegisters reply_{};
    /// Orders are fetched after each telegram, so one place is enough; eight are for a caller that is
    /// late.
    Queue<DemandOrder, 8> orders_;
    std::uint64_t ordered_ = 0;
    std::uint64_t rejected_ = 0;
    std::uint64_t lost_ = 0;
};

} // namespace dpslave::dp
