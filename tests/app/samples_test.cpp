// SPDX-License-Identifier: Apache-2.0
// The samples of a drive line: which moments a drive thread keeps, and what GetSamples makes of them.
#include "app/calls/samples.hpp"
#include "app/line/sampler.hpp"
#include "control/interface.hpp"

#include <gmock/gmock.h>

namespace dpslave::app {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr Instant kFirst{1000s};
constexpr std::chrono::nanoseconds kUnixStart = 1'700'000'000s; ///< the same moment

Layout layout_of(Generation generation, std::initializer_list<LayoutEntry> parameters)
{
    Layout layout;
    layout.generation = generation;
    for (const LayoutEntry& one : parameters) layout.parameters[layout.count++] = one;
    return layout;
}

drive::Tag tag(std::uint16_t number, const char* name, std::uint8_t decimals)
{
    drive::Tag one;
    one.number = number;
    one.name = name;
    one.decimals = decimals;
    return one;
}

/// Station "unwinder", number 3, with the tags 55 SPEED (two decimals) and 56 DEMAND (none). The master reads
/// 55 and writes 56.
class SamplesOfALine : public testing::Test {
protected:
    SamplesOfALine()
    {
        auto config = std::make_shared<config::StationConfig>();
        config->name = "unwinder";
        config->tags = std::make_shared<const drive::TagTable>(
            std::vector<drive::Tag>{tag(55, "SPEED", 2), tag(56, "DEMAND", 0)});
        station.config = config;
        station.number = 3;
        choose(layout_of(1, {{55, true, false}, {56, false, true}}));
        drive.answers = true;
        drive.states.fill(WordState::good);
        now_is(kFirst);
    }
    void choose(const Layout& layout)
    {
        sampler.set_layout(layout);
        station.bus.layout = layout;
        drive.generation = layout.generation;
    }
    void now_is(Instant at)
    {
        now = at;
        sampler.sample(station.number, drive, ended, ring, now);
    }
    /// A round over the parameters is over, and these words are known.
    void refreshed(std::uint16_t speed, std::uint16_t demand = 0)
    {
        drive.words[0] = speed;
        drive.words[1] = demand;
        drive.refresh_ms.add(10);
        now_is(now + 100ms);
    }
    report::GetSamplesReply asked(SampleQuestion question)
    {
        const auto reply = samples_of(station, ring, question, now, kUnixStart + (now - kFirst));
        EXPECT_EQ(control::reply_mismatch("GetSamples", report::json_of(reply)), std::nullopt);
        return reply;
    }
    std::vector<std::string> values(SampleQuestion question)
    {
        std::vector<std::string> all;
        for (const report::Sample& one : asked(question).samples)
            all.push_back(one.value + (one.state == "good" ? "" : " " + one.state));
        return all;
    }

    trace::Ring ring{64 * 1024};
    Sampler sampler;
    drive::DriveSnapshot drive;
    Generation ended = 0;
    Station station;
    Instant now = kFirst;
};

TEST_F(SamplesOfALine, AreOneForEachRefresh)
{
    refreshed(1250, 7);
    now_is(now + 2ms); // the thread looks more often than that
    refreshed(1251, 7);
    refreshed(1251, 8);

    EXPECT_THAT(values({.tag = 55}), ElementsAre("12.50", "12.51", "12.51"));
    EXPECT_THAT(values({.tag = 56}), ElementsAre("7", "7", "8"));
}

TEST_F(SamplesOfALine, HaveTimeScaleAndDirection)
{
    refreshed(0xFB1E); // -1250

    const report::GetSamplesReply reply = asked({.tag = 55});

    EXPECT_EQ(reply.station, "unwinder");
    EXPECT_EQ(reply.name, "SPEED");
    EXPECT_EQ(reply.direction, "in");
    EXPECT_EQ(reply.now_unix_ms, 1'700'000'000'100);
    ASSERT_EQ(reply.samples.size(), 1U);
    EXPECT_EQ(reply.samples[0].unix_ms, 1'700'000'000'100);
    EXPECT_EQ(reply.samples[0].raw, 0xFB1E);
    EXPECT_DOUBLE_EQ(reply.samples[0].scaled, -12.5);
    EXPECT_EQ(asked({.tag = 56}).direction, "out");
    EXPECT_EQ(reply.lost, 0);
    EXPECT_FALSE(reply.more);
}

TEST_F(SamplesOfALine, SayWhatIsHeldAndWhatIsRefused)
{
    refreshed(1250);
    drive.states[0] = WordState::stale;
    drive.states[1] = WordState::read_only;
    refreshed(1250, 9);

    EXPECT_THAT(values({.tag = 55}), ElementsAre("12.50", "12.50 stale"));
    EXPECT_THAT(values({.tag = 56}), ElementsAre("0", "9 read_only"));
}

TEST_F(SamplesOfALine, HaveTheMomentAtWhichTheDriveIsLost)
{
    refreshed(1250);
    drive.answers = false;
    drive.states[0] = WordState::stale;
    now_is(now + 1s);
    now_is(now + 1s); // no refresh, no sample

    EXPECT_THAT(values({.tag = 55}), ElementsAre("12.50", "12.50 stale"));
}

TEST_F(SamplesOfALine, EndWhereAnotherLayoutDoesNotHaveTheTag)
{
    refreshed(1250);
    choose(layout_of(2, {{56, true, false}}));
    now_is(now + 1s);
    refreshed(77);
    choose(layout_of(3, {{56, true, false}, {55, true, false}}));
    now_is(now + 1s);
    refreshed(78, 1300);

    EXPECT_THAT(values({.tag = 55}), ElementsAre("12.50", " none", "13.00"))
        << "no word of another tag is among them";
    EXPECT_THAT(values({.tag = 56}), ElementsAre("0", " none", "77", " none", "78"));
}

TEST_F(SamplesOfALine, OfAnOutputEndWithTheLayoutAndThoseOfAnInputDoNot)
{
    refreshed(1250, 7);
    ended = 1;
    now_is(now + 10ms);
    refreshed(1251, 7);

    EXPECT_THAT(values({.tag = 56}), ElementsAre("7", " none"));
    EXPECT_THAT(values({.tag = 55}), ElementsAre("12.50", "12.50", "12.51"));
}

TEST_F(SamplesOfALine, OfALayoutWithoutInputsComeWithEachWrite)
{
    choose(layout_of(2, {{56, false, true}}));
    now_is(now + 1s);
    drive.words[0] = 5;
    ++drive.writes;
    now_is(now + 1s);

    EXPECT_THAT(values({.tag = 56}), ElementsAre("5"));
}

TEST_F(SamplesOfALine, OfOtherStationsAreNotMixed)
{
    refreshed(1250);
    station.number = 4;

    EXPECT_THAT(values({.tag = 55}), IsEmpty());
}

TEST_F(SamplesOfALine, OfATagThatIsNotInTheLayoutAreNone)
{
    refreshed(1250);

    const report::GetSamplesReply reply = asked({.tag = 99});
    EXPECT_THAT(reply.samples, IsEmpty());
    EXPECT_EQ(reply.direction, std::nullopt);
    EXPECT_EQ(reply.name, std::nullopt);
}

TEST_F(SamplesOfALine, BeginWithTheOneThatStoodWhenTheTimeBegan)
{
    refreshed(1);
    refreshed(2);
    refreshed(3);
    now_is(kFirst + 10s);

    EXPECT_THAT(values({.tag = 55, .within = 1s}), ElementsAre("0.03")) << "it stands still";
    now = kFirst + 1250ms;
    EXPECT_THAT(values({.tag = 55, .within = 1s}), ElementsAre("0.02", "0.03"));
}

TEST_F(SamplesOfALine, ComeInPartsThatMakeTheWhole)
{
    trace::Ring large{1024 * 1024};
    Sampler other;
    other.set_layout(station.bus.layout);
    other.sample(station.number, drive, ended, large, now);
    constexpr int kAll = 4500;
    for (int i = 0; i < kAll; ++i) {
        drive.words[0] = static_cast<std::uint16_t>(i);
        drive.refresh_ms.add(1);
        now += 1ms;
        other.sample(station.number, drive, ended, large, now);
    }
    int expected = 0, parts = 0;
    SampleQuestion question{.tag = 55};
    for (bool more = true; more; ++parts) {
        const auto reply = samples_of(station, large, question, now, kUnixStart);
        EXPECT_EQ(reply.lost, 0);
        for (const report::Sample& one : reply.samples) EXPECT_EQ(one.raw, expected++);
        more = reply.more;
        question.after = static_cast<std::uint64_t>(reply.newest);
    }
    EXPECT_EQ(expected, kAll);
    EXPECT_EQ(parts, 3);
}

TEST_F(SamplesOfALine, ThatMadeRoomAreCountedAndTheOthersAreWholeAgain)
{
    for (std::uint16_t i = 0; i < 5000; ++i) refreshed(i);

    const report::GetSamplesReply reply = asked({.tag = 55});
    EXPECT_GT(reply.lost, 1000);
    ASSERT_FALSE(reply.samples.empty());
    EXPECT_EQ(reply.samples.back().raw, 4999);
    std::int64_t expected = reply.samples.front().raw;
    for (const report::Sample& one : reply.samples) EXPECT_EQ(one.raw, expected++);
    EXPECT_GT(reply.oldest_unix_ms.value_or(0), 1'700'000'000'000);
    const auto next = asked({.tag = 55, .after = static_cast<std::uint64_t>(reply.newest)});
    EXPECT_THAT(next.samples, IsEmpty());
    EXPECT_EQ(next.lost, 0) << "nothing behind it was lost";
}

} // namespace
} // namespace dpslave::app
