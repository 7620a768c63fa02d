// SPDX-License-Identifier: Apache-2.0
/// Row F09 of the fault matrix on the simulated clock: bit errors on the line of the drives, in both
/// directions. The judge of the line knows what each tag held and what each master wanted.
#include "line_bench.hpp"
#include "noisy_lines.hpp"
#include "support/row.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <optional>
#include <tuple>

namespace dpslave::drive_line {
namespace {

constexpr double kErrors[] = {1e-6, 1e-5, 1e-4, 1e-3, 1e-2};

/// Ten minutes of new values on both sides, then none of the bits is inverted any more.
template <class Bench, class Noisy>
void goes_through(Bench& bench, Noisy& noisy)
{
    for (int change = 0; change < 2'000 && !bench.run->violation(); ++change) {
        bench.run->change(static_cast<std::size_t>(change) % 2);
        bench.run->live_for(300ms);
    }
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
    EXPECT_GT(noisy.hits(), 0U) << "or nothing was shown";

    noisy.heal();
    bench.run->change(0);
    test::recovered_in(bench.until_it_works(60s));
    EXPECT_TRUE(bench.works());
    EXPECT_FALSE(bench.run->violation()) << *bench.run->violation();
}

class BitErrorsOfEiAscii : public testing::TestWithParam<double> {};

TEST_P(BitErrorsOfEiAscii, F09_NeverShowAValueThatTheDriveDidNotHoldNorWriteOneThatNobodyWanted)
{
    std::optional<EiLineWithBitErrors> noisy;
    LineBench<EiLine> bench{calm(2),
                            [&](EiLine& line, const Conditions& conditions) {
                                noisy.emplace(line, GetParam());
                                return ei_client_on(*noisy, line, conditions);
                            },
                            false};
    goes_through(bench, *noisy);
}

INSTANTIATE_TEST_SUITE_P(OneIn, BitErrorsOfEiAscii, testing::ValuesIn(kErrors),
                         [](const auto& one) { return fmt::format("{:.0f}", 1 / one.param); });

class BitErrorsOfModbus : public testing::TestWithParam<std::tuple<double, ::test::Parity>> {};

TEST_P(BitErrorsOfModbus, F09_NeverShowAValueThatTheDriveDidNotHoldNorWriteOneThatNobodyWanted)
{
    const auto [errors, parity] = GetParam();
    Conditions conditions = calm(2);
    if (parity == ::test::Parity::even) conditions.bits_of_a_character = 11;
    conditions.line.character = conditions.bits_of_a_character * 1'000'000'000ns / conditions.baud;
    std::optional<ModbusLineWithBitErrors> noisy;
    LineBench<ModbusFrames> bench{conditions,
                                  [&](ModbusFrames& line, const Conditions& of_line) {
                                      noisy.emplace(line, std::get<0>(GetParam()), std::get<1>(GetParam()));
                                      return modbus_client_on(*noisy, line, of_line);
                                  },
                                  true};
    goes_through(bench, *noisy);
    EXPECT_EQ(noisy->taken_for_good(), 0U) << "damaged, and taken for a frame";
    EXPECT_TRUE(errors < 1e-4 || noisy->refused() > 0) << "or the receiver was not asked";
}

INSTANTIATE_TEST_SUITE_P(OneIn, BitErrorsOfModbus,
                         testing::Combine(testing::ValuesIn(kErrors),
                                          testing::Values(::test::Parity::without, ::test::Parity::even)),
                         [](const auto& one) {
                             return fmt::format("{:.0f}_{}", 1 / std::get<0>(one.param),
                                                std::get<1>(one.param) == ::test::Parity::even ? "8E1"
                                                                                               : "8N1");
                         });

} // namespace
} // namespace dpslave::drive_line
