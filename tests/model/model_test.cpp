// SPDX-License-Identifier: Apache-2.0
/// Random steps for the real slave and for the model. MODEL_STEPS and MODEL_SEED choose how many, and from
/// which seed on; tools/check-model sets them.
#include "run.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace test {
namespace {

std::uint64_t number(const char* variable, std::uint64_t otherwise)
{
    const char* text = std::getenv(variable);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

TEST(Model, AgreesWithTheSlaveAfterEachRandomStep)
{
    const std::uint64_t steps = number("MODEL_STEPS", MODEL_STEPS);
    const std::uint64_t first = number("MODEL_SEED", 1);

    for (std::uint64_t run = 0; run * kStepsOfARun < steps; ++run)
        if (const auto finding = run_seed(first + run)) FAIL() << show(*finding);

    const Reached all = reached();
    (void)std::printf(
        "%llu steps, seeds %llu to %llu; Wait_Prm %llu, Wait_Cfg %llu, Data_Exch %llu; SC %llu, SD1 %llu, DL "
        "%llu, DH %llu\n",
        static_cast<unsigned long long>(all.steps), static_cast<unsigned long long>(first),
        static_cast<unsigned long long>(first + all.steps / kStepsOfARun - 1),
        static_cast<unsigned long long>(all.in_state[1]), static_cast<unsigned long long>(all.in_state[2]),
        static_cast<unsigned long long>(all.in_state[3]), static_cast<unsigned long long>(all.replies[0]),
        static_cast<unsigned long long>(all.replies[1]), static_cast<unsigned long long>(all.replies[2]),
        static_cast<unsigned long long>(all.replies[3]));
}

} // namespace
} // namespace test
