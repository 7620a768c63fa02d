// SPDX-License-Identifier: Apache-2.0
/// The tests of Demand Data use this: registers as a master has them, and a drive side that is asked.
#pragma once

#include "bench.hpp"

namespace test {

class DemandBench : public DpBench {
protected:
    explicit DemandBench(dpslave::dp::Personality device) : DpBench(std::move(device)) {}

    /// One exchange with these registers 1 and 4; the answer's, as "1037 1234".
    std::string demand(std::uint16_t command, std::uint16_t value = 0)
    {
        return exchange({command, 0, 0, value});
    }
    std::string exchange(const std::vector<std::uint16_t>& registers)
    {
        Octets outputs;
        for (const unsigned word : registers) {
            outputs.push_back(static_cast<std::uint8_t>(word / 256));
            outputs.push_back(static_cast<std::uint8_t>(word % 256));
        }
        const std::string reply = master.data_exchange(outputs);
        EXPECT_EQ(reply.substr(0, 3), "DL ");
        return reply.substr(3);
    }
    dpslave::DemandOrder order()
    {
        const auto one = slave.take_demand_order();
        EXPECT_TRUE(one) << "no order";
        return one.value_or(dpslave::DemandOrder{});
    }
    void answer(const dpslave::DemandOrder& order, std::uint16_t value)
    {
        slave.set_demand_answer({order.number, dpslave::AccessError::none, value});
    }
    void refuse(const dpslave::DemandOrder& order, dpslave::AccessError why)
    {
        slave.set_demand_answer({order.number, why, 0});
    }
};

inline constexpr std::string_view kNothing = "00 00 00 00 00 00 00 00";

} // namespace test
