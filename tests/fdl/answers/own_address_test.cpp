// SPDX-License-Identifier: Apache-2.0
/// A telegram with one of our addresses as sender: the reply that was sent last, or another station.
#include "fdl/bench.hpp"

using namespace dpslave;
using namespace test;

namespace {

struct Sent {
    const char* name;
    Octets octets;
    friend void PrintTo(const Sent& row, std::ostream* out) { *out << row.name; }
};

constexpr std::uint8_t kAlsoUs = 6;
/// With two SAPs as many as SD3 carries.
const Octets kSixOfThem{1, 2, 3, 4, 5, 6};

class OwnAddress : public FdlStation {
protected:
    OwnAddress()
    {
        station.attach(kAlsoUs, also_us, kClassMaxTsdr);
        bus.advance({});
    }
    /// Another station sends this right after the reply to `request`.
    void expect_no_echo(const Octets& request, const Octets& reply, const Octets& sent)
    {
        ASSERT_EQ(bus.ask(request), reply);
        bus.breaks_in_after(bus.bits(100), sent);
        EXPECT_EQ(station.counters().own_address, 1u);
        EXPECT_EQ(station.counters().came_back, 0u);
        EXPECT_TRUE(station.take_unanswered());
    }
    RecordingUser also_us;
};

class SentByAnother : public OwnAddress, public testing::WithParamInterface<Sent> {};

TEST_P(SentByAnother, ThatIsNotTheReplyInOnePlaceIsNoEcho)
{
    user.inputs = kSixOfThem;
    expect_no_echo(sd2(kUs, kMaster, kSrdFirst, Saps{60, 62}),
                   sd2(kMaster, kUs, 0x08, Saps{62, 60}, kSixOfThem), GetParam().octets);
}

INSTANTIATE_TEST_SUITE_P(
    Conflicts, SentByAnother,
    testing::Values(Sent{"Delimiter", sd3(kMaster, kUs, 0x08, Saps{62, 60}, kSixOfThem)},
                    Sent{"Receiver", sd2(kOtherMaster, kUs, 0x08, Saps{62, 60}, kSixOfThem)},
                    Sent{"Sender", sd2(kMaster, kAlsoUs, 0x08, Saps{62, 60}, kSixOfThem)},
                    Sent{"Function", sd2(kMaster, kUs, 0x0A, Saps{62, 60}, kSixOfThem)},
                    Sent{"Dsap", sd2(kMaster, kUs, 0x08, Saps{61, 60}, kSixOfThem)},
                    Sent{"Ssap", sd2(kMaster, kUs, 0x08, Saps{62, 61}, kSixOfThem)},
                    Sent{"Octet", sd2(kMaster, kUs, 0x08, Saps{62, 60}, {1, 2, 3, 4, 5, 7})},
                    Sent{"Length", sd2(kMaster, kUs, 0x08, Saps{62, 60}, {1, 2, 3, 4, 5})}),
    kNameOf);

TEST_F(OwnAddress, OfTheReplyThatComesBackIsNoRequestWithoutAReply)
{
    const auto reply = bus.ask(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(reply);

    bus.breaks_in_after(bus.bits(100), *reply);

    EXPECT_EQ(station.counters().came_back, 1u);
    EXPECT_FALSE(station.take_unanswered());
}

TEST_F(OwnAddress, OfAReplyFromBeforeTheLastRequestIsNoEcho)
{
    const auto reply = bus.ask(sd1(kUs, kMaster, kFdlStatus));
    ASSERT_TRUE(reply);
    bus.arrives_in_one_read({sd1(kUs, kMaster, kFdlStatus), sd1(kOther, kMaster, kFdlStatus)});

    bus.breaks_in_after(bus.bits(100), *reply);

    EXPECT_EQ(station.counters().own_address, 1u);
    EXPECT_EQ(station.counters().came_back, 0u);
}

TEST_F(OwnAddress, BehindAShortAcknowledgeIsNoEcho)
{
    user.answer = fdl::Answer::sc;
    expect_no_echo(sd2(kUs, kMaster, kSrdFirst, {1}), sc(), sd1(kMaster, kUs, 0x00));
}

} // namespace
