// SPDX-License-Identifier: Apache-2.0
/// A folder that stands for /dev, in which the GPIO chips of a test lie.
#pragma once

#include "support/gpio_stand_in/chip.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace dpslave::io {

class GpioFolder : public testing::Test {
protected:
    GpioFolder()
    {
        std::string name = (std::filesystem::temp_directory_path() / "dpslave-gpio-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::system_error{errno, std::system_category(), name};
        folder = name;
    }
    ~GpioFolder() override { std::filesystem::remove_all(folder); }

    std::filesystem::path folder;
};

} // namespace dpslave::io
