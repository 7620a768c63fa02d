// SPDX-License-Identifier: Apache-2.0
/// A folder that stands for /dev, in which the GPIO chips of a test lie.
#pragma once

#include "support/folder.hpp"
#include "support/gpio_stand_in/chip.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace dpslave::io {

class GpioFolder : public testing::Test {
protected:
    dpslave::test::Folder kept;
    std::filesystem::path folder = kept.path();
};

} // namespace dpslave::io
