// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/units.hpp"

#include <gtest/gtest.h>

#include <ostream>

using namespace dpslave;
using std::chrono::nanoseconds;

namespace {

struct BitTimes {
    const char* name;
    std::uint32_t bits;
    std::array<double, kBauds.size()>
        microseconds; ///< as printed: wire reference 1.2, in the order of kBauds

    friend void PrintTo(const BitTimes& row, std::ostream* out) { *out << row.name; }
};

std::string name_of(const testing::TestParamInfo<BitTimes>& info)
{
    return info.param.name;
}

class PrintedBitTimes : public testing::TestWithParam<BitTimes> {};

TEST_P(PrintedBitTimes, AreReachedToTheLastPrintedDigit)
{
    for (std::size_t i = 0; i < kBauds.size(); ++i) {
        const double printed = GetParam().microseconds[i];
        const double unit = printed >= 1000 ? 1 : printed >= 50 ? 0.1 : 0.05;
        const double computed =
            static_cast<double>(duration_of(Tbit{GetParam().bits}, kBauds[i]).count()) / 1000;
        EXPECT_NEAR(computed, printed, unit) << text(kBauds[i]);
    }
}

INSTANTIATE_TEST_SUITE_P(
    WireReference, PrintedBitTimes,
    testing::Values(BitTimes{"OneBit", 1, {104.2, 52.1, 22.0, 10.7, 5.333, 2.000, 0.667}},
                    BitTimes{"MinTsdr", 11, {1146, 572.9, 242.0, 117.3, 58.7, 22.0, 7.333}},
                    BitTimes{"Tsyn", 33, {3438, 1719, 726.1, 352.0, 176.0, 66.0, 22.0}},
                    BitTimes{"Tid1", 37, {3854, 1927, 814.1, 394.7, 197.3, 74.0, 24.7}},
                    BitTimes{"Sd1", 66, {6875, 3438, 1452, 704.0, 352.0, 132.0, 44.0}},
                    BitTimes{"Sd3", 154, {16042, 8021, 3388, 1643, 821.3, 308.0, 102.7}},
                    BitTimes{"LongestTelegram", 2805, {292188, 146094, 61716, 29920, 14960, 5610, 1870}},
                    BitTimes{"Bits250", 250, {26042, 13021, 5501, 2667, 1333, 500.0, 166.7}},
                    BitTimes{"Bits500", 500, {52083, 26042, 11001, 5333, 2667, 1000, 333.3}},
                    BitTimes{"Bits1000", 1000, {104167, 52083, 22002, 10667, 5333, 2000, 666.7}}),
    name_of);

TEST(DurationOf, IsRoundedUpSoThatAPauseIsNeverTooShort)
{
    EXPECT_EQ(duration_of(3_tbit, Baud::k1500), nanoseconds{2000});
    EXPECT_EQ(duration_of(1_tbit, Baud::k1500), nanoseconds{667});
    EXPECT_EQ(duration_of(11_tbit, Baud::k1500), nanoseconds{7334});
    EXPECT_EQ(duration_of(1_tbit, Baud::k9_6), nanoseconds{104'167});
    EXPECT_EQ(duration_of(0_tbit, Baud::k9_6), nanoseconds{0});
}

TEST(DurationOf, DoesNotOverflowForTheLongestTimeThatCanBeWritten)
{
    EXPECT_EQ(duration_of(Tbit{0xFFFF'FFFF}, Baud::k500), nanoseconds{0xFFFF'FFFFll * 2000});
}

TEST(Tbit, IsComparedAndAddedAsANumber)
{
    EXPECT_LT(11_tbit, 60_tbit);
    EXPECT_EQ(11_tbit + 50_tbit, 61_tbit);
}

TEST(Baud, IsFoundByItsNumberAndHasItsPlaceInTheList)
{
    for (std::size_t i = 0; i < kBauds.size(); ++i) {
        EXPECT_EQ(index_of(kBauds[i]), i);
        EXPECT_EQ(baud_of(static_cast<std::uint32_t>(kBauds[i])), kBauds[i]);
    }
    EXPECT_EQ(baud_of(115'200), std::nullopt);
    EXPECT_EQ(baud_of(0), std::nullopt);
}

TEST(Baud, IsSpelledAsInTheGsdKeywords)
{
    EXPECT_EQ(text(Baud::k9_6), "9.6");
    EXPECT_EQ(text(Baud::k19_2), "19.2");
    EXPECT_EQ(text(Baud::k45_45), "45.45");
    EXPECT_EQ(text(Baud::k93_75), "93.75");
    EXPECT_EQ(text(Baud::k187_5), "187.5");
    EXPECT_EQ(text(Baud::k500), "500");
    EXPECT_EQ(text(Baud::k1500), "1.5M");
}

} // namespace
