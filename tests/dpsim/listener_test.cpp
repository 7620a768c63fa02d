// SPDX-License-Identifier: Apache-2.0
// A UART at the wrong rate. The expectations were found on paper: bit times of the sender on squared paper,
// and a look at the middle of each bit time of the listener.
#include "dpsim/line/listener.hpp"
#include "octets.hpp"

#include <gtest/gtest.h>

namespace dpslave::sim {
namespace {

constexpr unsigned kEven = 11;

Octets heard(unsigned bits, std::uint32_t sent_at, std::uint32_t heard_at, const Octets& octets)
{
    Listener uart{bits, sent_at, heard_at};
    Octets all = uart.hear(octets);
    const Octets last = uart.rest();
    all.insert(all.end(), last.begin(), last.end());
    return all;
}

TEST(Listener, AtTheRateOfTheSenderHearsWhatWasSent)
{
    Octets every(256);
    for (unsigned i = 0; i < 256; ++i) every[i] = static_cast<std::uint8_t>(i);

    EXPECT_EQ(heard(kEven, 9'600, 9'600, every), every);
    EXPECT_EQ(heard(10, 9'600, 9'600, every), every);
}

TEST(Listener, ThatIsOnePercentOffHearsItToo)
{
    const Octets octets{0x00, 0x55, 0xAA, 0xFF, 0x68};

    EXPECT_EQ(heard(kEven, 100'000, 101'000, octets), octets);
    EXPECT_EQ(heard(kEven, 101'000, 100'000, octets), octets);
}

/// Sent 0 0000'0000 0 1: twenty bit times of zero, of which eleven are a character without stop bit.
TEST(Listener, TwiceAsFastTakesALongZeroForOneBrokenCharacter)
{
    EXPECT_EQ(heard(kEven, 9'600, 19'200, {0x00}), Octets{0x00});
}

/// Sent 0 1111'1111 0 1: two bit times of zero, of which the second is data; sixteen ones follow, and with
/// seven of them the data bits are 1111'1110. Seven ones want the parity 1, and the ninth one is it. Then the
/// parity bit of the sender: two zeros, then ones: again 1111'1110.
TEST(Listener, TwiceAsFastHearsTwoCharactersInOne)
{
    EXPECT_EQ(heard(kEven, 9'600, 19'200, {0xFF}), (Octets{0xFE, 0xFE}));
}

/// Sent 0 1010'1010 1 (55 without parity, lowest bit first): every zero is followed by a one, in which the
/// listener looks for the middle of its start bit. With parity, a zero, the last two bits before the stop bit
/// are zeros: a start bit with eight ones and a wrong parity behind it.
TEST(Listener, HalfAsFastSeesNoStartBitThatIsTooShort)
{
    EXPECT_EQ(heard(10, 19'200, 9'600, {0x55}), Octets{});
    EXPECT_EQ(heard(kEven, 19'200, 9'600, {0x55}), Octets{0x00});
}

/// 00 and then FF: 0 0000'0000 0 1, 0 1111'1111 0 1. The middles lie at 1 (start), 3, 5, 7, 9 (zeros), 11
/// (the next start bit: a zero), 13, 15, 17 (ones), 19 (parity, a one, as three ones want it) and 21 (stop).
/// Without parity 9 is the stop bit of the first one: 0001'1111.
TEST(Listener, HalfAsFastMakesOneCharacterOfTwo)
{
    EXPECT_EQ(heard(kEven, 19'200, 9'600, {0x00, 0xFF}), Octets{0xE0});
    EXPECT_EQ(heard(10, 19'200, 9'600, {0x00, 0xFF}), Octets{0xF8});
}

TEST(Listener, MuchSlowerHearsAWholeTelegramAsNextToNothing)
{
    const Octets telegram{0x10, 0x05, 0x02, 0x49, 0x50, 0x16};

    EXPECT_LE(heard(kEven, 1'500'000, 9'600, telegram).size(), 1U); // 66 bit times are half a bit
    EXPECT_NE(heard(kEven, 1'500'000, 93'750, telegram), telegram);
}

TEST(Listener, MuchFasterHearsManyBrokenCharacters)
{
    const Octets telegram{0x10, 0x05, 0x02, 0x49, 0x50, 0x16};
    const Octets came = heard(kEven, 9'600, 1'500'000, telegram);

    EXPECT_GT(came.size(), telegram.size());
    for (const std::uint8_t octet : came) EXPECT_EQ(octet, 0) << "no stop bit within a bit of the sender";
}

TEST(Listener, HearsThePiecesOfATelegramAsTheWhole)
{
    const Octets telegram{0x68, 0x05, 0x05, 0x68, 0x05, 0x02, 0x5D, 0xAA, 0xBB, 0xC9, 0x16};
    for (const std::uint32_t rate : {9'600U, 45'450U, 93'750U, 500'000U}) {
        Listener uart{kEven, 187'500, rate};
        Octets all;
        for (const std::uint8_t octet : telegram) {
            const Octets part = uart.hear(Octets{octet});
            all.insert(all.end(), part.begin(), part.end());
        }
        const Octets last = uart.rest();
        all.insert(all.end(), last.begin(), last.end());

        EXPECT_EQ(all, heard(kEven, 187'500, rate, telegram)) << rate;
    }
}

TEST(Listener, BeginsAnewAfterTheLineHasRested)
{
    Listener uart{kEven, 19'200, 9'600};
    static_cast<void>(uart.hear(Octets{0x00}));
    static_cast<void>(uart.rest());

    Octets again = uart.hear(Octets{0x00, 0xFF});
    const Octets last = uart.rest();
    again.insert(again.end(), last.begin(), last.end());
    EXPECT_EQ(again, Octets{0xE0});
}

} // namespace
} // namespace dpslave::sim
