// SPDX-License-Identifier: Apache-2.0
/// The tests of the transition table's rows use this.
#pragma once

#include "dp/bench.hpp"

namespace test {

class Rows : public ExampleSlave {
protected:
    explicit Rows(dpslave::dp::Personality device = example_device()) : ExampleSlave(std::move(device)) {}
    void waits_for_cfg() { ASSERT_EQ(master.set_prm(kPrm), "SC"); }
    void expect_outputs_zeroed_once()
    {
        EXPECT_EQ(left().size(), 1u);
        const auto outputs = slave.take_outputs();
        ASSERT_TRUE(outputs);
        EXPECT_FALSE(outputs->may_write);
        EXPECT_EQ(outputs->words[1], 0);
        EXPECT_EQ(outputs->layout.generation, 0u);
    }
    static constexpr std::string_view kWrongIdent = "88 14 01 0B 47 12 01";
    static constexpr std::string_view kUnlock = "40 00 00 00 47 11 00";
};

class RowsWithTags : public OptionBoard {};

class RowsWithoutSync : public Rows {
protected:
    RowsWithoutSync() : Rows(device()) {}
    static dpslave::dp::Personality device()
    {
        auto device = example_device();
        device.sync = device.freeze = false;
        return device;
    }
};

} // namespace test
