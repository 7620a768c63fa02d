// SPDX-License-Identifier: Apache-2.0
/// Every difference that the model check has found, shrunk, with its seed. `who` says who was wrong: the
/// slave, or the model where the reference had been read wrongly. A new finding gets a row here.
#include "run.hpp"

#include <gtest/gtest.h>

namespace test {
namespace {

struct Found {
    const char* name;
    const char* who;
    std::size_t device; ///< of model_devices()
    std::uint64_t seed; ///< of the generator at that time
    const char* steps;
};

class ModelFinding : public testing::TestWithParam<Found> {};

TEST_P(ModelFinding, IsNoDifferenceAnyMore)
{
    EXPECT_EQ(difference_in(GetParam().device, steps_of(GetParam().steps)), std::nullopt);
}

// Sync, then the first Data_Exchange: the drive side was allowed to write the 0 that no master had sent.
constexpr const char* kSyncBeforeTheFirstOutputs = R"(
request 58416 93 2 61 62 | A6 14 02 FF 47 11 01 A1
request 33353 125 2 62 62 | 21 11 21
sdn 135455 70 2 58 62 | 20 00
request 21942 93 2 -1 -1 | BE ED 3B 0E
)";

// The same where scales have to be found, with Demand Data.
constexpr const char* kSyncBeforeTheFirstOutputsAndScales = R"(
request 264854 125 9 61 62 | B0 04 0A 00 05 33 8B 00 16 00 0F 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00
request 128755 125 9 62 62 | 73 50 60
sdn 162548 70 9 58 62 | 20 79
inputs 269610 0 1 0 0 | 87 B4 77 4C
request 327886 125 9 -1 -1 | 10 00 00 02 00 00 00 01 62 5D
)";

// Sync alone brings nothing that could be written.
constexpr const char* kSyncWithoutOutputs = R"(
request 60053 125 2 61 62 | B8 01 03 05 16 49 01 00 00 00 01 D5 00 47 00 0D
request 6764 93 2 62 62 | 73 60 60 60
sdn 133771 70 2 58 62 | 20 9F
)";

// What does not fit is reported as Overflow alone: the zeros of the device's own block would say "no fault".
constexpr const char* kOverflowOfTheFirstBlock = R"(
diag 252596 0 0 0 0 | 05 00 00 00 01 F7 04 00 01 00
)";

// Ext_Diag as the application says it, also over the device's own block.
constexpr const char* kFaultWithoutABlock = R"(
diag 195160 1 0 0 0 |
)";

// No block at all is what a malformed one leaves.
constexpr const char* kMalformedBlock = R"(
diag 186753 0 0 0 0 | 00
)";

INSTANTIATE_TEST_SUITE_P(
    Model, ModelFinding,
    testing::Values(Found{"SyncBeforeTheFirstOutputs", "slave", 4, 4, kSyncBeforeTheFirstOutputs},
                    Found{"SyncBeforeTheFirstOutputsAndScales", "slave", 5, 5,
                          kSyncBeforeTheFirstOutputsAndScales},
                    Found{"SyncWithoutOutputs", "model", 2, 2, kSyncWithoutOutputs},
                    Found{"OverflowOfTheFirstBlock", "model", 3, 3, kOverflowOfTheFirstBlock},
                    Found{"FaultWithoutABlock", "model", 2, 2, kFaultWithoutABlock},
                    Found{"MalformedBlock", "model", 2, 2, kMalformedBlock}),
    [](const auto& one) { return std::string{one.param.name}; });

TEST(ModelStep, IsReadBackAsItIsShown)
{
    const char* const line = "request 58416 93 2 61 62 | A6 14 02 FF 47 11 01 A1";

    EXPECT_EQ(show(steps_of(line).at(0)), line);
    EXPECT_THROW(steps_of("request 1 2"), std::invalid_argument);
}

} // namespace
} // namespace test
