// SPDX-License-Identifier: Apache-2.0
/// The client of the program with one rule taken out of its judgement (CMakeLists.txt says which): the judge
/// of the line has to find that out. So a rule without a check is seen.
#include "random_runs.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive_line {
namespace {

TEST(Judge, FindsAViolationOfTheClientWithoutThisRule)
{
    constexpr std::uint64_t kSeeds = 20;
    std::string finding;
    std::uint64_t seed = 0;
    while (finding.empty() && seed < kSeeds) finding = run_ei(++seed, ei_client, {.late = true}).violation;
    EXPECT_NE(finding, "") << "after " << kSeeds << " seeds";
    RecordProperty("seed", static_cast<int>(seed));
    RecordProperty("finding", finding);
    if (!finding.empty()) SUCCEED() << "seed " << seed << ": " << finding;
}

} // namespace
} // namespace dpslave::drive_line
