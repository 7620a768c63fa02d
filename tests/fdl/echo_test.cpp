// SPDX-License-Identifier: Apache-2.0
/// What we send comes back, and has to be gone before layer 2 sees it (wire reference 11.7). All telegrams by
/// hand.
#include "support/wire.hpp"

#include "dpslave/fdl/echo.hpp"

#include <gtest/gtest.h>

using namespace dpslave;
using fdl::Echo;
using std::chrono::microseconds;
using test::Octets;

namespace {

/// Station 5 answers master 2 with three octets; then master 2 asks again.
const Octets kReply{0x68, 0x06, 0x06, 0x68, 0x02, 0x05, 0x08, 0x11, 0x22, 0x33, 0x75, 0x16};
const Octets kRequest{0x68, 0x06, 0x06, 0x68, 0x05, 0x02, 0x5D, 0x00, 0x00, 0x00, 0x64, 0x16};
const Octets kShort{0xE5};

constexpr Instant kStart{std::chrono::seconds{9}};
constexpr Instant kQuiet = kStart + microseconds{330}; // until here no other station may send
constexpr Instant kUntil = kStart + microseconds{5000};

struct EchoedLine {
    explicit EchoedLine(EchoMode mode) : echo(mode) {}

    void send(const Octets& telegram = kReply) { echo.sent(telegram, kQuiet, kUntil); }
    /// What layer 2 gets of this.
    Octets hears(const Octets& octets, Instant at = kStart + microseconds{200})
    {
        const auto foreign = echo.remove(octets, at);
        Octets all(foreign.withheld.begin(), foreign.withheld.end());
        all.insert(all.end(), foreign.octets.begin(), foreign.octets.end());
        return all;
    }
    void exchange_with_echo()
    {
        send();
        EXPECT_EQ(hears(kReply), Octets{});
        EXPECT_EQ(hears(kRequest, kUntil), kRequest);
    }
    void exchange_without_echo()
    {
        send();
        EXPECT_EQ(hears(kRequest, kQuiet + microseconds{400}), kRequest);
    }

    Echo echo;
};

Octets part(const Octets& octets, std::size_t from, std::size_t to)
{
    return {octets.begin() + static_cast<std::ptrdiff_t>(from),
            octets.begin() + static_cast<std::ptrdiff_t>(to)};
}

Octets operator+(Octets a, const Octets& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(Echo, IsNotLookedForWhereItIsOff)
{
    EchoedLine line(EchoMode::off);
    line.send();

    EXPECT_EQ(line.hears(kReply), kReply);
    EXPECT_FALSE(line.echo.is_heard());
    EXPECT_FALSE(line.echo.is_open());
    EXPECT_EQ(line.echo.removed() + line.echo.broken() + line.echo.missing(), 0u);
}

TEST(Echo, IsRemovedWhole)
{
    EchoedLine line(EchoMode::on);
    line.send();

    EXPECT_EQ(line.hears(kReply), Octets{});
    EXPECT_EQ(line.echo.removed(), 1u);
    EXPECT_TRUE(line.echo.is_heard());
}

TEST(Echo, IsRemovedOctetByOctet)
{
    EchoedLine line(EchoMode::on);
    line.send();
    for (const std::uint8_t octet : kReply) EXPECT_EQ(line.hears({octet}), Octets{});

    EXPECT_EQ(line.echo.removed(), 1u);
    EXPECT_EQ(line.hears({kReply[0]}), (Octets{kReply[0]})); // only once
}

TEST(Echo, IsRemovedInTwoPiecesCutAnywhere)
{
    for (std::size_t cut = 1; cut < kReply.size(); ++cut) {
        EchoedLine line(EchoMode::on);
        line.send();
        EXPECT_EQ(line.hears(part(kReply, 0, cut)), Octets{});
        EXPECT_EQ(line.hears(part(kReply, cut, kReply.size())), Octets{});
        EXPECT_EQ(line.echo.removed(), 1u) << cut;
    }
}

TEST(Echo, OfAShortAcknowledgeIsRemoved)
{
    EchoedLine line(EchoMode::on);
    line.send(kShort);

    EXPECT_EQ(line.hears(kShort), Octets{});
    EXPECT_EQ(line.hears(kShort), kShort); // another slave's
    EXPECT_EQ(line.echo.removed(), 1u);
}

TEST(Echo, OfTheLongestTelegramIsRemoved)
{
    Octets longest(255, 0xA5);
    EchoedLine line(EchoMode::on);
    line.send(longest);

    EXPECT_EQ(line.hears(longest), Octets{});
    EXPECT_EQ(line.echo.removed(), 1u);
}

TEST(Echo, LeavesWhatFollowsItRightAway)
{
    for (std::size_t cut = 0; cut <= kReply.size(); ++cut) {
        EchoedLine line(EchoMode::on);
        line.send();
        EXPECT_EQ(line.hears(part(kReply, 0, cut)), Octets{});
        EXPECT_EQ(line.hears(part(kReply, cut, kReply.size()) + kRequest), kRequest) << cut;
        EXPECT_EQ(line.echo.removed(), 1u);
        EXPECT_EQ(line.echo.broken(), 0u);
    }
}

TEST(Echo, ThatIsLongerLeavesWhatIsTooMuch)
{
    EchoedLine line(EchoMode::on);
    line.send();

    EXPECT_EQ(line.hears(kReply + Octets{0x00}), (Octets{0x00}));
    EXPECT_EQ(line.echo.removed(), 1u);
}

TEST(Echo, ThatDiffersInOneOctetIsGivenBackWholeAndCounted)
{
    for (std::size_t bad = 0; bad < kReply.size(); ++bad)
        for (std::size_t cut = 0; cut < kReply.size(); ++cut) {
            Octets heard = kReply;
            heard[bad] ^= 0x40;
            EchoedLine line(EchoMode::on);
            line.send();
            const Octets all = line.hears(part(heard, 0, cut)) + line.hears(part(heard, cut, heard.size()));

            EXPECT_EQ(all, heard) << bad << " cut at " << cut; // in order, nothing lost, nothing twice
            EXPECT_EQ(line.echo.broken(), 1u);
            EXPECT_EQ(line.echo.removed() + line.echo.missing(), 0u);
        }
}

TEST(Echo, ThatBrokeIsNotExpectedAnyMore)
{
    EchoedLine line(EchoMode::on);
    line.send();
    line.hears({0x00});

    EXPECT_EQ(line.hears(kReply), kReply);
    EXPECT_EQ(line.echo.broken(), 1u);
}

TEST(Echo, WithABadCharacterIsGivenBackInFrontOfIt)
{
    EchoedLine line(EchoMode::on);
    line.send();
    EXPECT_EQ(line.hears(part(kReply, 0, 4)), Octets{});
    const Bytes withheld = line.echo.on_character_error(kStart + microseconds{200});

    EXPECT_EQ(Octets(withheld.begin(), withheld.end()), part(kReply, 0, 4));
    EXPECT_EQ(line.hears(part(kReply, 5, kReply.size())), part(kReply, 5, kReply.size()));
    EXPECT_EQ(line.echo.broken(), 1u);
}

TEST(Echo, IsNotConcernedByABadCharacterOutsideIt)
{
    EchoedLine line(EchoMode::on);
    EXPECT_TRUE(line.echo.on_character_error(kStart).empty()); // nothing was sent
    line.exchange_with_echo();
    EXPECT_TRUE(line.echo.on_character_error(kUntil).empty()); // it is through

    EXPECT_EQ(line.echo.broken(), 0u);
}

TEST(Echo, ThatDoesNotComeIsCountedAndCostsNoRequest)
{
    EchoedLine line(EchoMode::on);
    line.exchange_without_echo();

    EXPECT_EQ(line.echo.missing(), 1u);
    EXPECT_EQ(line.echo.broken(), 0u);
}

TEST(Echo, ThatDoesNotComeCostsNoRequestThatComesInPieces)
{
    for (std::size_t cut = 1; cut < kRequest.size(); ++cut) {
        EchoedLine line(EchoMode::on);
        line.send();
        const Instant at = kQuiet + microseconds{300};
        EXPECT_EQ(line.hears(part(kRequest, 0, cut), at) +
                      line.hears(part(kRequest, cut, kRequest.size()), at + microseconds{100}),
                  kRequest)
            << cut;
        EXPECT_EQ(line.echo.missing(), 1u);
    }
}

TEST(Echo, IsBrokenUntilOthersMaySpeakAgainAndFromThenOnMissing)
{
    EchoedLine line(EchoMode::on);
    line.send();
    line.hears(kRequest, kQuiet - std::chrono::nanoseconds{1});
    EXPECT_EQ(line.echo.broken(), 1u);
    line.send();
    line.hears(kRequest, kQuiet);

    EXPECT_EQ(line.echo.broken(), 1u);
    EXPECT_EQ(line.echo.missing(), 1u);
}

TEST(Echo, ThatIsDueAndNeverCameIsMissingWhenTheNextReplyGoesOut)
{
    EchoedLine line(EchoMode::on);
    line.send();
    line.send();

    EXPECT_EQ(line.echo.missing(), 1u);
    EXPECT_EQ(line.hears(kReply), Octets{}); // of the second one
}

TEST(Echo, ThatWasTornIsNoPartOfTheNextRequest)
{
    EchoedLine line(EchoMode::on);
    line.send();
    EXPECT_EQ(line.hears(part(kReply, 0, 5)), Octets{});

    EXPECT_EQ(line.hears(kRequest, kUntil + microseconds{1}), kRequest); // its first five octets were ours
    EXPECT_EQ(line.echo.broken(), 1u);
}

TEST(Echo, ThatComesAfterItsTimeIsNoEcho)
{
    EchoedLine line(EchoMode::on);
    line.send();

    EXPECT_EQ(line.hears(kReply, kUntil + microseconds{1}), kReply);
    EXPECT_EQ(line.echo.missing(), 1u);
}

TEST(AutomaticEcho, IsRemovedFromTheFirstTelegramOn)
{
    EchoedLine line(EchoMode::automatic);
    EXPECT_TRUE(line.echo.is_open());
    line.send();

    EXPECT_EQ(line.hears(kReply), Octets{});
    EXPECT_TRUE(line.echo.is_open()); // one swallow makes no summer
    EXPECT_FALSE(line.echo.is_heard());
}

TEST(AutomaticEcho, IsFoundOutWithThreeTelegrams)
{
    EchoedLine with(EchoMode::automatic), without(EchoMode::automatic);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(with.echo.is_open());
        EXPECT_TRUE(without.echo.is_open());
        with.exchange_with_echo();
        without.exchange_without_echo();
        without.hears(kRequest, kUntil + microseconds{1});
    }

    EXPECT_TRUE(with.echo.is_heard());
    EXPECT_FALSE(with.echo.is_open());
    EXPECT_FALSE(without.echo.is_heard());
    EXPECT_FALSE(without.echo.is_open());
}

TEST(AutomaticEcho, CountsNoMissingOneWhereThereIsNone)
{
    EchoedLine line(EchoMode::automatic);
    for (int i = 0; i < 20; ++i) line.exchange_without_echo();

    EXPECT_EQ(line.echo.missing() + line.echo.broken(), 0u);
}

TEST(AutomaticEcho, HealsAFalseNo)
{
    EchoedLine line(EchoMode::automatic);
    for (int i = 0; i < 5; ++i) line.exchange_without_echo(); // the receiver was off for a while
    ASSERT_FALSE(line.echo.is_heard());

    for (int i = 0; i < 3; ++i) line.exchange_with_echo(); // removed at once, believed after three
    EXPECT_TRUE(line.echo.is_heard());
    EXPECT_EQ(line.echo.removed(), 3u);
}

TEST(AutomaticEcho, HealsAFalseYes)
{
    EchoedLine line(EchoMode::automatic);
    for (int i = 0; i < 5; ++i) line.exchange_with_echo();
    ASSERT_TRUE(line.echo.is_heard());

    for (int i = 0; i < 3; ++i) line.exchange_without_echo(); // not one request is lost
    EXPECT_FALSE(line.echo.is_heard());
    EXPECT_EQ(line.echo.missing(), 2u); // the third one settled it
}

TEST(AutomaticEcho, StaysFoundWhenOneIsBroken)
{
    EchoedLine line(EchoMode::automatic);
    for (int i = 0; i < 3; ++i) line.exchange_with_echo();
    line.send();
    line.hears({0x68, 0x00});

    EXPECT_TRUE(line.echo.is_heard());
    EXPECT_EQ(line.echo.broken(), 1u);
    line.exchange_with_echo();
    EXPECT_TRUE(line.echo.is_heard());
}

} // namespace
