// SPDX-License-Identifier: Apache-2.0
/// The program with one rule taken out: the judge of the histories has to find that out. So a rule without a
/// check is seen.
#include "mutant.hpp"
#include "stall_run.hpp"

#include <gtest/gtest.h>

#include <string>

namespace dpslave::stalls {
namespace {

constexpr std::uint64_t kSeeds = 150;

/// The first finding, over both protocols.
std::string finding(int mutant, std::uint64_t seeds)
{
    the_mutant = mutant;
    std::string found;
    for (std::uint64_t seed = 1; found.empty() && seed <= seeds; ++seed)
        found = run_histories(seed, {.is_modbus = seed % 2 == 0}).violation;
    the_mutant = 0;
    return found;
}

struct Mutant {
    int number;
    const char* name;
};

class JudgeOfStalls : public ::testing::TestWithParam<Mutant> {};

TEST_P(JudgeOfStalls, FindsAViolationOfTheProgramWithoutThisRule)
{
    const std::string found = finding(GetParam().number, kSeeds);
    EXPECT_NE(found, "") << "after " << kSeeds << " seeds";
    RecordProperty("finding", found);
}

INSTANTIATE_TEST_SUITE_P(
    , JudgeOfStalls,
    ::testing::Values(Mutant{1, "NoVerdictOfTheBus"}, Mutant{2, "LineIsNotGivenUp"},
                      Mutant{3, "OrdersAreHandedToAStalledLine"}, Mutant{4, "StationsStayWithoutAMainThread"},
                      Mutant{5, "OvertakenOrdersStand"}, Mutant{6, "DriveIsNotGoneForTheLine"},
                      Mutant{7, "PortIsNotClosed"}, Mutant{8, "FailedOrdersAreKept"},
                      Mutant{9, "MasterIsNotLostForTheLine"}, Mutant{10, "OldWordsStayGood"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(JudgeOfNoStall, FindsNothingInTheProgramItself)
{
    EXPECT_EQ(finding(0, 10), "");
}

} // namespace
} // namespace dpslave::stalls
