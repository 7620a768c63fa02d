// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/bytes.hpp"

#include <gtest/gtest.h>

#include <type_traits>

using namespace dpslave;

namespace {

TEST(Words, HaveTheirHighOctetFirst)
{
    const std::array<std::uint8_t, 4> octets{0x00, 0x47, 0x11, 0xFF};

    EXPECT_EQ(be16(octets, 1), 0x4711);
    EXPECT_EQ(be16(octets, 2), 0x11FF);
    EXPECT_EQ(high(0x4711), 0x47);
    EXPECT_EQ(low(0x4711), 0x11);
}

TEST(ByteBuffer, IsEmptyAtFirst)
{
    const ByteBuffer<4> buffer;

    EXPECT_TRUE(buffer.empty());
    EXPECT_EQ(buffer.size(), 0u);
    EXPECT_EQ(buffer.capacity(), 4u);
    EXPECT_TRUE(buffer.bytes().empty());
}

TEST(ByteBuffer, TakesAsManyOctetsAsItPromises)
{
    ByteBuffer<3> buffer;

    EXPECT_TRUE(buffer.push(1));
    EXPECT_TRUE(buffer.push(2));
    EXPECT_TRUE(buffer.push(3));
    EXPECT_FALSE(buffer.push(4));
    EXPECT_EQ(hex(buffer), "01 02 03");
}

TEST(ByteBuffer, RefusesAWordOfWhichOnlyOneOctetFits)
{
    ByteBuffer<3> buffer;

    EXPECT_TRUE(buffer.push16(0x4711));
    EXPECT_FALSE(buffer.push16(0x1234));
    EXPECT_EQ(hex(buffer), "47 11");
    EXPECT_TRUE(buffer.push(0x99));
}

TEST(ByteBuffer, RefusesWhatDoesNotFitWhole)
{
    const std::array<std::uint8_t, 3> three{1, 2, 3};
    ByteBuffer<5> buffer;

    EXPECT_TRUE(buffer.append(three));
    EXPECT_FALSE(buffer.append(three));
    EXPECT_EQ(hex(buffer), "01 02 03");
    EXPECT_TRUE(buffer.append(Bytes{three}.first(2)));
    EXPECT_EQ(hex(buffer), "01 02 03 01 02");
    EXPECT_TRUE(buffer.append({}));
}

TEST(ByteBuffer, KeepsItsContentsWhenAnAssignmentIsTooLong)
{
    const std::array<std::uint8_t, 3> three{1, 2, 3};
    ByteBuffer<2> buffer;
    buffer.push(7);

    EXPECT_FALSE(buffer.assign(three));
    EXPECT_EQ(hex(buffer), "07");
    EXPECT_TRUE(buffer.assign(Bytes{three}.last(2)));
    EXPECT_EQ(hex(buffer), "02 03");
}

TEST(ByteBuffer, CanBeFilledToItsBoundAndEmptied)
{
    const std::array<std::uint8_t, 255> all{};
    ByteBuffer<255> buffer;

    EXPECT_TRUE(buffer.assign(all));
    EXPECT_FALSE(buffer.push(0));
    buffer.clear();
    EXPECT_TRUE(buffer.empty());
    EXPECT_TRUE(buffer.push(1));
}

TEST(ByteBuffer, MayCrossBetweenThreads)
{
    EXPECT_TRUE(std::is_trivially_copyable_v<ByteBuffer<244>>);
}

TEST(Hex, HasTwoUpperCaseDigitsAnOctetAndOneBlankBetween)
{
    const std::array<std::uint8_t, 5> octets{0x68, 0x05, 0xAF, 0x00, 0xFF};

    EXPECT_EQ(hex(octets), "68 05 AF 00 FF");
    EXPECT_EQ(hex(Bytes{octets}.first(1)), "68");
    EXPECT_EQ(hex({}), "");
}

TEST(ByteBuffer, IsEqualByItsContentsWhateverStoodThereBefore)
{
    ByteBuffer<4> one;
    ByteBuffer<4> other;
    one.push16(0x4711);
    one.push16(0x1234);
    one.assign(std::array<std::uint8_t, 1>{0x04});
    other.push(0x04);

    EXPECT_EQ(one, other);
    other.push(0x00);
    EXPECT_NE(one, other); // a zero is an octet too
}

} // namespace
