// SPDX-License-Identifier: Apache-2.0
/// Octets of a Modbus RTU line become frames. The checksums are those of a second hand (scripted_slave).
#include "modbus/frame_receiver.hpp"
#include "scripted_slave.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::modbus::test {
namespace {

using testing::ElementsAre;
using Found = FrameReceiver::Found;

class ModbusFrameReceiver : public testing::Test {
protected:
    /// What was found with each octet in turn, without the nothings.
    std::vector<Found> hears(const Octets& octets)
    {
        std::vector<Found> found;
        for (const std::uint8_t octet : octets)
            if (const Found one = receiver.feed(octet); one != Found::nothing) found.push_back(one);
        return found;
    }
    std::vector<std::uint8_t> frame() const { return {receiver.frame().begin(), receiver.frame().end()}; }

    FrameReceiver receiver;
};

TEST_F(ModbusFrameReceiver, GivesAFrameWithItsLastOctetAndWithoutItsCheckSum)
{
    EXPECT_THAT(hears(framed("01 03 02 12 34")), ElementsAre(Found::frame));
    EXPECT_THAT(frame(), ElementsAre(0x01, 0x03, 0x02, 0x12, 0x34));
    EXPECT_FALSE(receiver.in_frame());
}

TEST_F(ModbusFrameReceiver, RecognisesEveryAnswerByItsLength)
{
    for (const char* answer : {"01 03 04 11 11 22 22", "01 04 02 11 11", "01 06 00 02 00 05",
                               "01 10 00 02 00 03", "01 08 00 00 12 34", "01 83 02"})
        EXPECT_THAT(hears(framed(answer)), ElementsAre(Found::frame)) << answer;
}

TEST_F(ModbusFrameReceiver, FindsTwoFramesThatFollowEachOtherWithoutSilence)
{
    Octets both = framed("01 03 02 11 11");
    for (const std::uint8_t octet : framed("02 03 02 22 22")) both.push_back(octet);

    EXPECT_THAT(hears(both), ElementsAre(Found::frame, Found::frame));
    EXPECT_EQ(frame()[0], 0x02);
}

TEST_F(ModbusFrameReceiver, GivesNoFrameWithAWrongCheckSum)
{
    Octets wrong = framed("01 03 02 12 34");
    wrong.back() ^= 0x01;

    EXPECT_THAT(hears(wrong), ElementsAre());
    EXPECT_EQ(receiver.silence(), Found::broken);
}

TEST_F(ModbusFrameReceiver, GivesNoFrameWithAParityFaultInIt)
{
    const Octets good = framed("01 03 02 12 34");
    hears({good.begin(), good.begin() + 3});
    EXPECT_EQ(receiver.fault(), Found::broken);
    EXPECT_THAT(hears({good.begin() + 3, good.end()}), ElementsAre());
    EXPECT_THAT(hears(good), ElementsAre()) << "nothing counts until the line was silent";

    EXPECT_EQ(receiver.silence(), Found::rest) << "it was reported as broken already";
    EXPECT_EQ(receiver.piece().size(), 2 * good.size() - 3) << "all that was skipped";
    EXPECT_THAT(hears(good), ElementsAre(Found::frame));
}

TEST_F(ModbusFrameReceiver, GivesNoFrameWhoseRestComesBehindASilence)
{
    const Octets good = framed("01 03 02 12 34");
    hears({good.begin(), good.begin() + 4});
    EXPECT_TRUE(receiver.in_frame());
    EXPECT_EQ(receiver.silence(), Found::broken);
    EXPECT_THAT(hears({good.begin() + 4, good.end()}), ElementsAre());
}

TEST_F(ModbusFrameReceiver, TakesTheEchoOfARequestForAFrame)
{
    const Octets request = framed("01 03 00 07 00 02");
    EXPECT_THAT(hears(request), ElementsAre()) << "it has the length of no answer";
    receiver.silence();

    receiver.sent(0x01, octets("03 00 07 00 02"));
    EXPECT_THAT(hears(request), ElementsAre(Found::frame));
    EXPECT_THAT(frame(), ElementsAre(0x01, 0x03, 0x00, 0x07, 0x00, 0x02));
}

TEST_F(ModbusFrameReceiver, GivesUpALineThatIsNeverSilent)
{
    EXPECT_THAT(hears(Octets(600, 0x55)), ElementsAre(Found::broken));
}

TEST_F(ModbusFrameReceiver, KnowsTheCheckSumOfTheProtocol)
{
    EXPECT_EQ(crc16(octets("02 07")), 0x1241); // MODBUS over Serial Line V1.02, 6.2.2
    EXPECT_EQ(crc16({}), 0xFFFF);
}

TEST_F(ModbusFrameReceiver, GivesNothingThatHasTheLengthOfNoAnswer)
{
    for (const char* other : {"01 03 04 12 34", "01 83 02 00", "01 06 00 02 00", "01 10 00 02 00 03 00",
                              "01 08 00 00", "01 05 00 02 FF 00", "01 03", "01 86", "01 00 00"}) {
        EXPECT_THAT(hears(framed(other)), ElementsAre()) << other;
        receiver.silence();
    }
}

TEST_F(ModbusFrameReceiver, GivesBackAllThatWasOnTheWireAndSaysWhatWasWrong)
{
    const Octets good = framed("01 03 02 12 34");
    hears(good);
    EXPECT_THAT(receiver.piece(), testing::ElementsAreArray(good));

    Octets wrong = good;
    wrong.back() ^= 0x01;
    hears(wrong);
    EXPECT_EQ(receiver.silence(), Found::broken);
    EXPECT_EQ(receiver.flaw(), drive::Judgement::bad_checksum);
    EXPECT_THAT(receiver.piece(), testing::ElementsAreArray(wrong));

    hears(octets("01 03 02"));
    EXPECT_EQ(receiver.silence(), Found::broken);
    EXPECT_EQ(receiver.flaw(), drive::Judgement::truncated);
    EXPECT_THAT(receiver.piece(), ElementsAre(0x01, 0x03, 0x02));
    EXPECT_EQ(receiver.silence(), Found::nothing);
    EXPECT_FALSE(receiver.in_frame());
}

TEST_F(ModbusFrameReceiver, ShowsABadCharacterAsZeroAlsoInTheRest)
{
    hears(octets("01 03"));
    EXPECT_EQ(receiver.fault(), Found::broken);
    EXPECT_EQ(receiver.flaw(), drive::Judgement::bad_character);
    EXPECT_THAT(receiver.piece(), ElementsAre(0x01, 0x03, 0x00));
    EXPECT_TRUE(receiver.in_frame()) << "until the line was silent";
    hears(octets("11"));
    EXPECT_EQ(receiver.fault(), Found::nothing);
    hears(octets("22"));

    EXPECT_EQ(receiver.silence(), Found::rest);
    EXPECT_THAT(receiver.piece(), ElementsAre(0x11, 0x00, 0x22));
    EXPECT_FALSE(receiver.in_frame());
}

TEST_F(ModbusFrameReceiver, GivesUpAtTheLongestFrameAndKeepsAsMuchOfTheRest)
{
    EXPECT_THAT(hears(Octets(255, 0x55)), ElementsAre());
    EXPECT_THAT(hears(octets("55")), ElementsAre(Found::broken));
    EXPECT_EQ(receiver.flaw(), drive::Judgement::no_frame);
    EXPECT_EQ(receiver.piece().size(), 256u);
    hears(Octets(300, 0x66));

    EXPECT_EQ(receiver.silence(), Found::rest);
    EXPECT_THAT(receiver.piece(), testing::ElementsAreArray(Octets(256, 0x66)));
}

TEST_F(ModbusFrameReceiver, TakesTheEchoOfTheLastRequestOnly)
{
    receiver.sent(0x01, octets("03 00 07 00 02"));
    receiver.sent(0x01, octets("03 00 08 00 02"));

    EXPECT_THAT(hears(framed("01 03 00 07 00 02")), ElementsAre());
    receiver.silence();
    EXPECT_THAT(hears(framed("01 03 00 08 00 02")), ElementsAre(Found::frame));
}

} // namespace
} // namespace dpslave::modbus::test
