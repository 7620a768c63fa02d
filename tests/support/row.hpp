// SPDX-License-Identifier: Apache-2.0
/// A row of the fault matrix (docs/internals/reliability.md). Its test begins with its number: F07_….
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>

namespace dpslave::test {

/// How long the service of this row was not back after the end of the fault. tools/run faults collects it: a
/// line "F07 12.3" (ms) goes to the file that DPSLAVE_FAULT_TIMES names. A row may say so several times: the
/// longest counts.
inline void recovered_in(std::chrono::nanoseconds time)
{
    const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string row = std::string{test->name()}.substr(0, 3);
    const double ms = std::chrono::duration<double, std::milli>{time}.count();
    testing::Test::RecordProperty("recovered_in_ms", std::to_string(ms));
    const char* const path = std::getenv("DPSLAVE_FAULT_TIMES");
    if (path == nullptr) return;
    std::ofstream out{path, std::ios::app};
    out << row + " " + std::to_string(ms) + "\n" << std::flush; // in one write: rows run side by side
}

} // namespace dpslave::test
