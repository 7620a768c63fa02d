// SPDX-License-Identifier: Apache-2.0
/// Who is answered with what, and what is met with silence (wire reference 2.2 to 2.5, 3).
#include "fdl/bench.hpp"

using namespace dpslave;
using namespace test;
using fdl::Answer;

namespace {

using Answers = FdlStation;

TEST_F(Answers, FdlStatusIsAnsweredByAPassiveStation)
{
    bus.master_sends(octets("10 05 02 49 50 16"));

    EXPECT_EQ(bus.reply(), octets("10 02 05 00 07 16"));
    EXPECT_TRUE(user.srds.empty());
}

TEST_F(Answers, FdlStatusIsASignOfLifeOfItsMaster)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    ASSERT_TRUE(bus.reply());
    ASSERT_EQ(user.heards.size(), 1u);
    EXPECT_EQ(user.heards[0].sa, kMaster);
}

TEST_F(Answers, SrdHandsItsDataToTheUserOfTheDefaultSap)
{
    bus.master_sends(octets("68 05 05 68 05 02 7D 12 34 CA 16"));

    ASSERT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(user.srds[0].sa, 2);
    EXPECT_EQ(user.srds[0].dsap, std::nullopt);
    EXPECT_EQ(user.srds[0].ssap, std::nullopt);
    EXPECT_EQ(user.srds[0].data, octets("12 34"));
    EXPECT_EQ(user.srds[0].at, bus.now());
}

TEST_F(Answers, SrdToASapSaysBothSaps)
{
    bus.master_sends(octets("68 07 07 68 85 82 7D 3E 3D 11 21 31 16"));

    ASSERT_EQ(user.srds.size(), 1u);
    EXPECT_EQ(user.srds[0].dsap, 62);
    EXPECT_EQ(user.srds[0].ssap, 61);
    EXPECT_EQ(user.srds[0].data, octets("11 21"));
}

TEST_F(Answers, Sd3IsHandedOnLikeTheSameSd2)
{
    bus.master_sends(octets("A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16"));
    ASSERT_TRUE(bus.reply());
    bus.master_sends(octets("A2 85 82 5D 3E 3E 10 10 11 20 20 21 72 16"));
    ASSERT_TRUE(bus.reply());

    ASSERT_EQ(user.srds.size(), 2u);
    EXPECT_EQ(user.srds[0].data, octets("01 02 03 04 05 06 07 08"));
    EXPECT_EQ(user.srds[1].dsap, 62);
    EXPECT_EQ(user.srds[1].data, octets("10 10 11 20 20 21"));
}

TEST_F(Answers, LowAndHighPriorityRequestsAreTreatedAlike)
{
    bus.master_sends(sd2(kUs, kMaster, 0x6C, {0x12, 0x34}));

    EXPECT_EQ(bus.reply(), octets("68 05 05 68 02 05 08 12 34 55 16"));
}

TEST_F(Answers, ResponseDataIsSentAsDl)
{
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, {0, 0}));

    EXPECT_EQ(bus.reply(), octets("68 05 05 68 02 05 08 12 34 55 16"));
}

TEST_F(Answers, PendingDiagnosisTurnsItIntoDh)
{
    user.answer = Answer::high;
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, {0, 0}));

    EXPECT_EQ(bus.reply(), octets("68 05 05 68 02 05 0A 12 34 57 16"));
}

TEST_F(Answers, DhWithoutDataIsAnSd1)
{
    user.answer = Answer::high;
    user.inputs = {};
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, {0, 0}));

    EXPECT_EQ(bus.reply(), octets("10 02 05 0A 11 16"));
}

TEST_F(Answers, AcceptedWithNothingToReturnIsTheShortAcknowledge)
{
    user.answer = Answer::sc;
    user.inputs = {};
    bus.master_sends(octets("68 07 07 68 85 82 7D 3E 3E 11 21 32 16"));

    EXPECT_EQ(bus.reply(), octets("E5"));
}

TEST_F(Answers, DlWithoutDataIsTheShortAcknowledge)
{
    user.inputs = {};
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, {1, 2}));

    EXPECT_EQ(bus.reply(), octets("E5"));
}

TEST_F(Answers, OneOctetOfDataIsAnSd2WithLe4)
{
    user.inputs = {0x77};
    bus.master_sends(sd1(kUs, kMaster, kSrdFirst));

    EXPECT_EQ(bus.reply(), octets("68 04 04 68 02 05 08 77 86 16"));
}

TEST_F(Answers, EightOctetsOfDataAreAnSd2AndNeverAnSd3)
{
    user.inputs = octets("01 02 03 04 05 06 07 08");
    bus.master_sends(sd1(kUs, kMaster, kSrdFirst));

    EXPECT_EQ(bus.reply(), sd2(kMaster, kUs, 0x08, user.inputs));
}

TEST_F(Answers, SapsAreSwappedAndBothExtensionBitsMirroredInTheReply)
{
    user.inputs = octets("02 05 00 FF 47 11");
    bus.master_sends(octets("68 05 05 68 85 82 6D 3C 3E EE 16"));

    EXPECT_EQ(bus.reply(), octets("68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16"));
}

TEST_F(Answers, LongestReplyHas244OctetsBesideTheSaps)
{
    user.inputs = Octets(244, 0xA5);
    bus.master_sends(sd2(kUs, kMaster, kSrdFirst, Saps{60, 62}));

    const auto reply = bus.reply();
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->size(), 255u);
    EXPECT_EQ(*reply, sd2(kMaster, kUs, 0x08, Saps{62, 60}, user.inputs));
}

struct Refusal {
    const char* name;
    Answer answer;
    const char* reply;

    friend void PrintTo(const Refusal& row, std::ostream* out) { *out << row.name; }
};
class Refused : public FdlStation, public testing::WithParamInterface<Refusal> {};

TEST_P(Refused, IsAnSd1WithoutSaps)
{
    user.answer = GetParam().answer;
    bus.master_sends(octets("68 05 05 68 85 82 6D 3C 3E EE 16"));

    EXPECT_EQ(bus.reply(), octets(GetParam().reply));
}

INSTANTIATE_TEST_SUITE_P(WireReference, Refused,
                         testing::Values(Refusal{"UserError", Answer::user_error, "10 02 05 01 08 16"},
                                         Refusal{"NoResource", Answer::no_resource, "10 02 05 02 09 16"},
                                         Refusal{"NotActivated", Answer::not_activated, "10 02 05 03 0A 16"}),
                         kNameOf);

struct Fc {
    const char* name;
    std::uint8_t fc;

    friend void PrintTo(const Fc& row, std::ostream* out) { *out << row.name; }
};
class NotOfDp : public FdlStation, public testing::WithParamInterface<Fc> {};

TEST_P(NotOfDp, IsAnsweredRsWithoutTheUser)
{
    bus.master_sends(sd1(kUs, kMaster, GetParam().fc));

    EXPECT_EQ(bus.reply(), octets("10 02 05 03 0A 16"));
    EXPECT_TRUE(user.srds.empty());
    EXPECT_EQ(user.heards.size(), 1u);
}

TEST_P(NotOfDp, IsAnsweredRsAtASapToo)
{
    bus.master_sends(sd2(kUs, kMaster, GetParam().fc, Saps{60, 62}, {1, 2}));

    EXPECT_EQ(bus.reply(), octets("10 02 05 03 0A 16"));
    EXPECT_TRUE(user.srds.empty());
}

INSTANTIATE_TEST_SUITE_P(WireReference, NotOfDp,
                         testing::Values(Fc{"SdaLow", 0x43}, Fc{"SdaHigh", 0x45}, Fc{"SdaLowCounted", 0x73},
                                         Fc{"Ident", 0x4E}, Fc{"LsapStatus", 0x4F}, Fc{"Msrd47", 0x47},
                                         Fc{"Msrd57", 0x57}, Fc{"Msrd67", 0x67}, Fc{"Msrd77", 0x77}),
                         kNameOf);

class WithoutAnswer : public FdlStation, public testing::WithParamInterface<Fc> {};

TEST_P(WithoutAnswer, IsMetWithSilence)
{
    bus.master_sends(sd1(kUs, kMaster, GetParam().fc));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(kUs, kMaster, GetParam().fc, Saps{60, 62}, {1, 2}));
    EXPECT_FALSE(bus.reply());

    EXPECT_TRUE(user.srds.empty());
    EXPECT_TRUE(user.sdns.empty());
    EXPECT_TRUE(user.heards.empty());
}

INSTANTIATE_TEST_SUITE_P(WireReference, WithoutAnswer,
                         testing::Values(Fc{"TimeEvent", 0x40}, Fc{"Reserved1", 0x41}, Fc{"Reserved2", 0x42},
                                         Fc{"Reserved8", 0x48}, Fc{"ReservedA", 0x4A}, Fc{"ReservedB", 0x4B},
                                         Fc{"ClockValue", 0xC0}, Fc{"SecondCodeTable", 0xCD},
                                         Fc{"ResponseDl", 0x08}, Fc{"ResponseOk", 0x00},
                                         Fc{"ResponseThatLooksLikeSrd", 0x3D}),
                         kNameOf);

TEST_F(Answers, OnlyOneExtensionBitIsAnsweredRs)
{
    bus.master_sends(octets("68 04 04 68 85 02 6D 3C 30 16")); // DSAP without SSAP
    EXPECT_EQ(bus.reply(), octets("10 02 05 03 0A 16"));
    bus.master_sends(octets("68 04 04 68 05 82 6D 3E 32 16")); // SSAP without DSAP
    EXPECT_EQ(bus.reply(), octets("10 02 05 03 0A 16"));

    EXPECT_TRUE(user.srds.empty());
}

TEST_F(Answers, SdnIsHandedOnAndNeverAnswered)
{
    bus.master_sends(sd2(kUs, kMaster, kSdnHigh, Saps{58, 62}, {0x08, 0x00}));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(kUs, kMaster, 0x44, Saps{58, 62}, {0x04, 0x00}));
    EXPECT_FALSE(bus.reply());

    ASSERT_EQ(user.sdns.size(), 2u);
    EXPECT_EQ(user.sdns[0].dsap, 58);
    EXPECT_EQ(user.sdns[0].ssap, 62);
    EXPECT_EQ(user.sdns[0].data, octets("08 00"));
    EXPECT_EQ(user.sdns[1].data, octets("04 00"));
}

TEST_F(Answers, SdnToAllIsHandedOnAndNeverAnswered)
{
    bus.master_sends(octets("68 07 07 68 FF 82 46 3A 3E 02 00 41 16"));

    EXPECT_FALSE(bus.reply());
    ASSERT_EQ(user.sdns.size(), 1u);
    EXPECT_EQ(user.sdns[0].data, octets("02 00"));
}

TEST_F(Answers, RequestsToAllThatAskForAReplyAreIgnored)
{
    bus.master_sends(sd1(127, kMaster, kFdlStatus));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(127, kMaster, kSrdFirst, Saps{60, 62}));
    EXPECT_FALSE(bus.reply());

    EXPECT_TRUE(user.srds.empty());
    EXPECT_EQ(station.counters().requests, 0u);
}

TEST_F(Answers, RequestsToOthersAreIgnored)
{
    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sd2(kOther, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}));
    EXPECT_FALSE(bus.reply());

    EXPECT_TRUE(user.sdns.empty());
    EXPECT_EQ(station.counters().telegrams, 2u);
    EXPECT_EQ(station.counters().requests, 0u);
}

TEST_F(Answers, TokenAndShortAcknowledgeAreIgnored)
{
    bus.master_sends(token(kUs, kMaster));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(sc());
    EXPECT_FALSE(bus.reply());

    EXPECT_EQ(station.counters().telegrams, 2u);
}

TEST_F(Answers, OwnAddressAsSenderIsAConflictThatIsCountedAndNotAnswered)
{
    bus.master_sends(sd1(kUs, kUs, kFdlStatus));
    EXPECT_FALSE(bus.reply());
    bus.master_sends(octets("68 05 05 68 02 05 08 12 34 55 16")); // another station answers as slave 5

    EXPECT_EQ(station.counters().own_address, 2u);
    EXPECT_EQ(station.counters().came_back, 0u);
    EXPECT_TRUE(user.heards.empty());
}

TEST_F(Answers, OwnReplyThatComesBackIsDistinguishedFromAnotherStationOfTheSameAddress)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    const auto reply = bus.reply();
    ASSERT_TRUE(reply);
    bus.breaks_in_after(bus.bits(100), *reply); // an echo
    bus.breaks_in_after(bus.bits(100), *reply); // each reply has one at most
    EXPECT_EQ(station.counters().own_address, 2u);
    EXPECT_EQ(station.counters().came_back, 1u);

    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());
    bus.breaks_in_after(bus.bits(100), sd2(kMaster, kUs, 0x08, {1})); // no reply of ours
    EXPECT_EQ(station.counters().own_address, 3u);
    EXPECT_EQ(station.counters().came_back, 1u);
}

TEST_F(Answers, MasterAt126IsAnswered)
{
    bus.master_sends(sd1(kUs, 126, kFdlStatus));

    EXPECT_EQ(bus.reply(), octets("10 7E 05 00 83 16"));
}

TEST_F(Answers, CalledUsersAreReportedToTheEdgeOnce)
{
    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
    EXPECT_TRUE(station.take_touched().none());
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    EXPECT_EQ(station.take_touched(), std::bitset<128>{}.set(kUs));
    EXPECT_TRUE(station.take_touched().none());
}

TEST_F(Answers, CountersCountEachCause)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(bus.reply());
    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));
    bus.master_sends(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0, 0}));

    EXPECT_EQ(station.counters().octets, 6u + 6u + 13u);
    EXPECT_EQ(station.counters().telegrams, 3u);
    EXPECT_EQ(station.counters().requests, 2u);
    EXPECT_EQ(station.counters().replies, 1u);
}

} // namespace
