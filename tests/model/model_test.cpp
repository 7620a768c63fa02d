// SPDX-License-Identifier: Apache-2.0
/// Random steps for the real slave and for the model. MODEL_STEPS and MODEL_SEED choose how many, and from
/// which seed on; tools/run model sets them.
#include "devices.hpp"
#include "generator.hpp"
#include "pair.hpp"
#include "run.hpp"
#include "support/count_of.hpp"

#include <gtest/gtest.h>

namespace test {
namespace {

TEST(Model, AgreesWithTheSlaveAfterEachRandomStep)
{
    const std::uint64_t steps = dpslave::test::count_of("MODEL_STEPS", 100'000);
    const std::uint64_t first = dpslave::test::count_of("MODEL_SEED", 1);

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

/// A property of a device in which slave and model are told different things.
struct Property {
    const char* name;
    std::size_t device;
    void (*change)(model::Device&);
};

class ModelOfAnotherDevice : public testing::TestWithParam<Property> {};

TEST_P(ModelOfAnotherDevice, IsFoundToDiffer)
{
    const model::Device& device = model_devices()[GetParam().device];
    model::Device other = device;
    GetParam().change(other);
    std::string difference;

    for (std::uint64_t seed = 1; difference.empty() && seed <= 100; ++seed) {
        Generator generator{seed};
        Pair pair{device, other};
        Step step;
        bool same = true;
        for (std::uint64_t i = 0; same && i < kStepsOfARun; ++i) {
            generator.next(pair.model(), pair.now(), step);
            same = pair.take(step);
        }
        difference = pair.difference();
    }

    EXPECT_NE(difference, "") << "200 000 steps agree";
}

INSTANTIATE_TEST_SUITE_P(
    Model, ModelOfAnotherDevice,
    testing::Values(Property{"HighestTag", 1, [](model::Device& d) { --d.highest_tag; }},
                    Property{"MostWords", 6, [](model::Device& d) { --d.most_words; }},
                    Property{"MostParameters", 2, [](model::Device& d) { --d.most_parameters; }},
                    Property{"LongestDiagnosis", 0, [](model::Device& d) { --d.longest_diag; }},
                    Property{"MaxTsdr", 6, [](model::Device& d) { --d.max_tsdr; }},
                    Property{"Dpv1Status", 2, [](model::Device& d) { d.dpv1_status = false; }},
                    Property{"FailSafe", 4, [](model::Device& d) { d.fail_safe = false; }},
                    Property{"Scales", 5, [](model::Device& d) { d.tries_outputs = false; }},
                    Property{"WaitsForDrive", 8, [](model::Device& d) { d.waits_for_drive = false; }},
                    Property{"ErrorBase", 5, [](model::Device& d) { d.error_base = 0; }},
                    Property{"ExtendedReply", 6, [](model::Device& d) { d.replies_as_example = false; }}),
    [](const auto& one) { return std::string{one.param.name}; });

} // namespace
} // namespace test
