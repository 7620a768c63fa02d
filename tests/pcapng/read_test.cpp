// SPDX-License-Identifier: Apache-2.0
#include "dpslave/pcapng/pcapng.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace dpslave::pcapng;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

/// A file word by word, in one byte order or the other.
struct File {
    bool big_endian = false;
    Octets octets{};

    File& w(std::initializer_list<std::uint32_t> words)
    {
        for (const std::uint32_t word : words)
            for (int i = 0; i < 4; ++i)
                octets.push_back(static_cast<std::uint8_t>(word >> (big_endian ? 24 - 8 * i : 8 * i)));
        return *this;
    }
    File& section() { return w({0x0A0D0D0A, 28, 0x1A2B3C4D, version(), 0xFFFFFFFF, 0xFFFFFFFF, 28}); }
    /// One option of one octet, in its place in the word.
    File& interface(std::uint16_t link_type, std::uint8_t resolution)
    {
        const auto two = [this](std::uint32_t first, std::uint32_t second) {
            return big_endian ? first << 16 | second : second << 16 | first;
        };
        const std::uint32_t value = big_endian ? std::uint32_t{resolution} << 24 : resolution;
        return w({1, 28, two(link_type, 0), 0, two(9, 1), value, 28});
    }
    File& packet(std::uint32_t interface, std::uint64_t time, std::uint8_t octet)
    {
        const std::uint32_t value = big_endian ? std::uint32_t{octet} << 24 : octet;
        return w({6, 36, interface, static_cast<std::uint32_t>(time >> 32), static_cast<std::uint32_t>(time),
                  1, 1, value, 36});
    }
    std::uint32_t version() const { return big_endian ? 0x00010000 : 0x00000001; }
};

TEST(PcapngReader, ReadsBothByteOrders)
{
    for (const bool big_endian : {false, true}) {
        const File file = File{big_endian}.section().interface(257, 9).packet(0, 0x100000002, 0xDC);

        const auto capture = read(file.octets);

        ASSERT_TRUE(capture) << capture.error();
        EXPECT_EQ(capture->interfaces.at(0).link_type, 257);
        EXPECT_EQ(capture->packets.at(0).unix_ns, 0x100000002);
        EXPECT_THAT(capture->packets.at(0).octets, ElementsAre(0xDC));
    }
}

TEST(PcapngReader, TimeStampsHaveTheResolutionOfTheirInterface)
{
    struct Case {
        std::uint8_t resolution;
        std::uint64_t units;
        std::int64_t ns;
    };
    for (const Case& one :
         {Case{6, 1'500'000, 1'500'000'000}, Case{0, 7, 7'000'000'000}, Case{9, 5, 5},
          Case{12, 5'000'999, 5'000}, Case{0x80 | 1, 3, 1'500'000'000},
          Case{0x80 | 40, 3ULL << 39, 1'500'000'000}, Case{0x80 | 127, 3, 0}, Case{127, 3, 0}}) {
        const auto capture =
            read(File{}.section().interface(257, one.resolution).packet(0, one.units, 0).octets);

        ASSERT_TRUE(capture) << capture.error();
        EXPECT_EQ(capture->packets.at(0).unix_ns, one.ns) << int{one.resolution};
    }
}

TEST(PcapngReader, ASecondSectionCountsItsInterfacesAnew)
{
    const auto capture = read(File{}
                                  .section()
                                  .interface(257, 9)
                                  .packet(0, 1, 1)
                                  .section()
                                  .interface(148, 9)
                                  .packet(0, 2, 2)
                                  .octets);

    ASSERT_TRUE(capture) << capture.error();
    EXPECT_EQ(capture->packets.at(0).interface, 0U);
    EXPECT_EQ(capture->packets.at(1).interface, 1U);
    EXPECT_EQ(capture->interfaces.at(1).link_type, 148);
}

TEST(PcapngReader, BlocksOfOtherKindsArePassedOver)
{
    const auto capture = read(File{}.section().w({0x0BAD, 16, 0x12345678, 16}).interface(257, 9).octets);

    ASSERT_TRUE(capture) << capture.error();
    EXPECT_EQ(capture->interfaces.size(), 1U);
}

TEST(PcapngReader, AFileWhoseWriterWasKilledGivesAllThatIsWhole)
{
    Octets octets = File{}.section().interface(257, 9).packet(0, 1, 1).packet(0, 2, 2).octets;
    for (std::size_t cut_off = 1; cut_off < 36; ++cut_off) {
        octets.pop_back();
        bool cut = false;

        const auto capture = read(octets, &cut);

        ASSERT_TRUE(capture) << capture.error();
        EXPECT_TRUE(cut);
        EXPECT_EQ(capture->packets.size(), 1U);
    }
}

TEST(PcapngReader, RefusesWhatIsNoFileOfThisFormOrContradictsItself)
{
    const auto why = [](const Octets& octets) {
        const auto capture = read(octets);
        return capture ? std::string{} : capture.error();
    };

    EXPECT_THAT(why(Octets(100, 0xFF)), HasSubstr("no capture"));
    EXPECT_THAT(why(File{}.section().packet(0, 1, 1).octets),
                HasSubstr("interface 0, which no block describes"));
    EXPECT_THAT(why(File{}.section().interface(257, 9).w({6, 36, 0, 0, 0, 5, 5, 1, 36}).octets),
                HasSubstr("longer than its block"));
    EXPECT_THAT(why(File{}.section().w({1, 12, 12}).octets), HasSubstr("octet 28"));
    EXPECT_THAT(why(File{}.section().w({6, 13, 0, 0}).octets), HasSubstr("length"));
    EXPECT_THAT(why(File{}.section().w({0x0BAD, 16, 0, 20}).octets),
                HasSubstr("octet 28: its two lengths differ"));
    EXPECT_THAT(why(File{}.section().w({0x0A0D0D0A, 28, 0x11223344, 1, 0, 0, 28}).octets),
                HasSubstr("byte order"));
    EXPECT_THAT(why(File{}.section().w({0x0A0D0D0A, 16, 0x1A2B3C4D, 16}).octets), HasSubstr("too short"));
}

} // namespace
