// SPDX-License-Identifier: Apache-2.0
/// The device types of the model check: one of each family and of each behaviour that a profile can choose.
#pragma once

#include "model.hpp"

#include "dpslave/dp/personality.hpp"

#include <vector>

namespace test {

const std::vector<model::Device>& model_devices();

/// The same device in the words of the slave under test.
dpslave::dp::Personality personality_of(const model::Device& device);

} // namespace test
