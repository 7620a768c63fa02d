// SPDX-License-Identifier: Apache-2.0
// The examples of wire reference 4.5.
#include "dpslave/gsd/identifier.hpp"

#include <gmock/gmock.h>

namespace dpslave::gsd {
namespace {

struct Example {
    std::vector<std::uint8_t> octets;
    std::size_t length, in, out;
};

class Identifiers : public testing::TestWithParam<Example> {};

TEST_P(Identifiers, OfTheReferenceAreUnderstood)
{
    const auto found = first_identifier(GetParam().octets);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->length, GetParam().length);
    EXPECT_EQ(found->in, GetParam().in);
    EXPECT_EQ(found->out, GetParam().out);
}

INSTANTIATE_TEST_SUITE_P(General, Identifiers,
                         testing::Values(Example{{0x10}, 1, 1, 0}, Example{{0x11}, 1, 2, 0},
                                         Example{{0x20}, 1, 0, 1}, Example{{0x30}, 1, 1, 1},
                                         Example{{0x50}, 1, 2, 0}, Example{{0x60}, 1, 0, 2},
                                         Example{{0x70}, 1, 2, 2}, Example{{0x73}, 1, 8, 8},
                                         Example{{0xD3}, 1, 8, 0}, Example{{0xB7}, 1, 8, 8},
                                         Example{{0xFF}, 1, 32, 32}));
INSTANTIATE_TEST_SUITE_P(Special, Identifiers,
                         testing::Values(Example{{0x00}, 1, 0, 0}, Example{{0x40, 0x01}, 2, 2, 0},
                                         Example{{0x80, 0xC3}, 2, 0, 8}, Example{{0xC0, 0x00, 0x01}, 3, 2, 1},
                                         Example{{0x42, 0x01, 0xAA, 0xBB}, 4, 2, 0},
                                         Example{{0x01, 0x0A}, 2, 0, 0}, Example{{0x4F, 0x01}, 2, 2, 0}));

TEST(Identifier, CutShortIsNone)
{
    const std::vector<std::vector<std::uint8_t>> cut{{}, {0x40}, {0xC0, 0x00}, {0x42, 0x01, 0xAA}, {0x01}};
    for (const auto& octets : cut) EXPECT_FALSE(first_identifier(octets)) << testing::PrintToString(octets);
}

TEST(Identifier, SumCountsAllOfThem)
{
    const std::vector<std::uint8_t> octets{0x73, 0x50, 0x60, 0xC0, 0x00, 0x01};
    const auto sum = sum_of_identifiers(octets);
    ASSERT_TRUE(sum);
    EXPECT_EQ(sum->length, 6U);
    EXPECT_EQ(sum->in, 12U);
    EXPECT_EQ(sum->out, 11U);
    EXPECT_FALSE(sum_of_identifiers(std::vector<std::uint8_t>{0x50, 0x40}));
}

} // namespace
} // namespace dpslave::gsd
