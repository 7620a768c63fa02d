// SPDX-License-Identifier: Apache-2.0
/// A request of which an octet was lost, spoilt or one too many costs only itself: its first retry is
/// answered (wire reference 1.5).
#include "bench.hpp"

#include <algorithm>
#include <array>

using namespace dpslave;
using namespace test;

namespace {

constexpr std::array<std::size_t, 3> kSizes{2, 8, 32}; // of the data

/// `size` octets of data, all but the last `fill`, that give an SRD to us this checksum.
Octets data_with_checksum(std::size_t size, std::uint8_t fill, std::uint8_t checksum)
{
    Octets data(size, fill);
    const unsigned before = kUs + kMaster + kSrdFcb1 + static_cast<unsigned>(size - 1) * fill;
    data.back() = static_cast<std::uint8_t>(checksum - before);
    return data;
}

class LostOctet : public testing::TestWithParam<Baud> {
protected:
    /// Wherever an octet of `request` is lost, and however it is read: the retry is answered, and at once.
    static void costs_only_the_request(const Octets& request)
    {
        for (const std::size_t bunch : kBunches) {
            for (std::size_t lost = 0; lost < request.size(); ++lost) {
                Line line{GetParam()};
                line.bus.arrives_in_bunches(without(request, lost), bunch);
                EXPECT_FALSE(line.bus.reply());
                line.bus.arrives_in_bunches(request, bunch);
                EXPECT_TRUE(line.bus.reply())
                    << show(request) << "\nwithout octet " << lost << ", in bunches of " << bunch;
                EXPECT_EQ(line.user.srds.size() + line.user.heards.size(), 1u);
            }
        }
    }
};

TEST_P(LostOctet, OfARequestWithDataCostsNoRetry)
{
    for (const std::size_t size : kSizes)
        for (const std::uint8_t checksum : octets("DC 10 68 A2 E5 16 00 7F"))
            for (const std::uint8_t fill : octets("00 11"))
                costs_only_the_request(sd2(kUs, kMaster, kSrdFcb1, data_with_checksum(size, fill, checksum)));
}

TEST_P(LostOctet, OfARequestWhoseDataLookLikeDelimitersCostsNoRetry)
{
    for (const std::size_t size : kSizes)
        for (const std::uint8_t checksum : octets("DC 10 68 A2"))
            for (const std::uint8_t fill : octets("68 10 A2 DC E5 16 05"))
                costs_only_the_request(sd2(kUs, kMaster, kSrdFcb1, data_with_checksum(size, fill, checksum)));
}

/// Without its first octet the data are all that looks like a beginning, and it announces what never comes.
TEST_P(LostOctet, OfARequestWhoseDataLookLikeALongHeaderCostsNoRetry)
{
    costs_only_the_request(sd2(kUs, kMaster, kSrdFcb1, octets("01 68 F9 F9 68 05 02 7D")));
    costs_only_the_request(sd2(kUs, kMaster, kSrdFcb1, octets("68 F9 F9 68 68 05 05 68 05 02")));
}

/// A2 10 16 and the retry are an SD3 with a good checksum: only what stands at a boundary may begin one
/// there.
TEST_P(LostOctet, OfARequestWhoseRestAndItsRetryAreATelegramByChanceCostsNoRetry)
{
    costs_only_the_request(sd2(kUs, kMaster, kSrdFcb1, octets("A2 EA")));
}

TEST_P(LostOctet, OfATelegramOfFixedLengthCostsNoRetry)
{
    costs_only_the_request(sd1(kUs, kMaster, kFdlStatus));
    costs_only_the_request(sd1(kUs, kMaster, kSrdFcb1));
    costs_only_the_request(sd3(kUs, kMaster, kSrdFcb1, octets("01 02 03 04 05 06 07 08")));
    costs_only_the_request(sd3(kUs, kMaster, kSrdFcb1, octets("10 68 A2 DC E5 16 05 02")));
}

INSTANTIATE_TEST_SUITE_P(AtEachRate, LostOctet, testing::ValuesIn(kBauds));

/// Retries of these come behind requests that were heard with a flaw somewhere.
class FlawInARequest : public testing::TestWithParam<const char*> {
protected:
    template <class Hear>
    void costs_no_retry(Hear hear_wrong)
    {
        const Octets request = sd2(kUs, kMaster, kSrdFcb1, octets(GetParam()));
        for (const std::size_t bunch : kBunches) {
            for (std::size_t place = 0; place < request.size(); ++place) {
                Line line{Baud::k187_5};
                hear_wrong(line.bus, request, place, bunch);
                line.bus.reply(); // what was one octet too many may stand in front of it
                line.bus.arrives_in_bunches(request, bunch);
                EXPECT_TRUE(line.bus.reply())
                    << show(request) << "\nwith a flaw at " << place << ", in bunches of " << bunch;
                EXPECT_EQ(line.user.srds.size(), 1u);
            }
        }
    }
};

TEST_P(FlawInARequest, ThatIsABadCharacterCostsNoRetry)
{
    costs_no_retry([](Bus& bus, const Octets& request, std::size_t place, std::size_t) {
        bus.arrives_with_bad_character(request, place);
    });
}

TEST_P(FlawInARequest, ThatIsABadCharacterWhereAnOctetIsLostTooCostsNoRetry)
{
    for (std::size_t lost = 0; lost < sd2(kUs, kMaster, kSrdFcb1, octets(GetParam())).size(); ++lost)
        costs_no_retry([lost](Bus& bus, const Octets& request, std::size_t place, std::size_t) {
            bus.arrives_with_bad_character(without(request, lost), std::min(place, request.size() - 2));
        });
}

TEST_P(FlawInARequest, ThatIsAnOctetTooManyCostsNoRetry)
{
    for (const std::uint8_t noise : octets("68 10 A2 DC E5 16 00 FF"))
        costs_no_retry([noise](Bus& bus, const Octets& request, std::size_t place, std::size_t bunch) {
            Octets wrong = request;
            wrong.insert(wrong.begin() + static_cast<std::ptrdiff_t>(place) + 1, noise);
            bus.arrives_in_bunches(wrong, bunch);
        });
}

TEST_P(FlawInARequest, ThatIsItsEndMissingCostsNoRetry)
{
    costs_no_retry([](Bus& bus, const Octets& request, std::size_t place, std::size_t bunch) {
        bus.arrives_in_bunches({request.begin(), request.begin() + static_cast<std::ptrdiff_t>(place) + 1},
                               bunch);
    });
}

TEST_P(FlawInARequest, ThatIsItsBeginningMissingCostsNoRetry)
{
    costs_no_retry([](Bus& bus, const Octets& request, std::size_t place, std::size_t bunch) {
        bus.arrives_in_bunches({request.begin() + static_cast<std::ptrdiff_t>(place), request.end()}, bunch);
    });
}

// Three octets of data and not two: A2 10 16 in front of the latter is an SD3 with a good checksum (above).
INSTANTIATE_TEST_SUITE_P(
    WireReference, FlawInARequest,
    testing::Values("00 00 8C", "00 00 1E", "00 A2 EA", "00 00 58", "00 00 E4", "68 68 68",
                    "10 10 10 10 10 10 10 10",
                    "01 02 03 04 05 06 07 08 09 0A 0B 0C 0D 0E 0F 10 11 12 13 14 15 16"));

class Stump : public testing::TestWithParam<const char*> {
protected:
    Line line{Baud::k187_5};
    const Octets ask = sd2(kUs, kMaster, kSrdFcb1, {0xAA, 0xBB});
};

/// What is left of a telegram when its beginning was lost, or its end.
TEST_P(Stump, IsNoPartOfTheRequestBehindThePause)
{
    for (const std::size_t bunch : kBunches) {
        line.bus.master_sends(octets(GetParam()));
        line.bus.arrives_in_bunches(ask, bunch);
        EXPECT_TRUE(line.bus.reply()) << "in bunches of " << bunch;
    }
}

/// The bus is shared: what came before was not ours, and a cycle of others lies between.
TEST_P(Stump, IsNoPartOfTheTelegramsOfOthersBehindThePause)
{
    line.bus.master_sends(octets(GetParam()));
    line.bus.arrives_in_one_read({sd2(kOther, kMaster, kSrdFcb1, {1, 2}), sd2(kMaster, kOther, 0x08, {3})});
    line.bus.master_sends(ask);

    EXPECT_TRUE(line.bus.reply());
}

TEST_P(Stump, DoesNotCostABroadcast)
{
    line.bus.master_sends(octets(GetParam()));
    line.bus.master_sends(sd2(127, kMaster, kSdnHigh, Saps{58, 62}, {0x20, 0x00}));
    line.bus.master_sends(ask);

    EXPECT_TRUE(line.bus.reply());
    EXPECT_EQ(line.user.sdns.size(), 1u);
}

TEST_P(Stump, InTheMiddleOfABunchOfTelegramsCostsOnlyItself)
{
    line.bus.arrives_in_one_read({sd2(kOther, kMaster, kSrdFcb1, {1}), octets(GetParam())});
    line.bus.master_sends(ask);

    EXPECT_TRUE(line.bus.reply());
}

INSTANTIATE_TEST_SUITE_P(WireReference, Stump,
                         testing::Values("DC", "DC 16", "10", "10 16", "10 05 02 49 50", "A2", "A2 16",
                                         "A2 05 02 7D 01 02 03 04 05 06 07 08 A8", "68", "68 16", "68 05",
                                         "68 05 05", "68 05 05 68", "68 F9 F9 68", "68 05 05 68 05 02 7D 01",
                                         "68 23 23 68 05 02 7D 01 02 03 04 05 06 07 08 09 10 68"));

} // namespace
