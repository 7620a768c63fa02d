// SPDX-License-Identifier: Apache-2.0
/// Runs of the model check: from one seed, or from a list of steps.
#pragma once

#include "step.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace test {

/// Steps that one pair of slaves takes before the next pair begins.
inline constexpr std::uint64_t kStepsOfARun = 2'000;

/// What was found: the device, the steps up to the difference (as few as possible), and the difference.
struct Finding {
    std::uint64_t seed = 0;
    std::size_t device = 0;
    Steps steps;
    std::string difference;
};
std::string show(const Finding& finding);

/// One run with this seed; the seed also chooses the device.
std::optional<Finding> run_seed(std::uint64_t seed, std::uint64_t steps = kStepsOfARun);
/// Takes these steps. None: slave and model agree after each of them.
std::optional<std::string> difference_in(std::size_t device, const Steps& steps);
/// Leaves out what is not needed for a difference of the same kind.
Steps shrunk(std::size_t device, Steps steps);

/// How many of the states and replies the runs have reached, so that a check that reaches nothing is seen.
struct Reached {
    std::uint64_t steps = 0;
    std::uint64_t in_state[4] = {};
    std::uint64_t replies[5] = {}; ///< SC, SD1, DL, DH, none
};
Reached reached();

} // namespace test
