// SPDX-License-Identifier: Apache-2.0
#include "capture.hpp"
#include "dpsim/replay/replay.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

constexpr Instant kStart{std::chrono::seconds{100}};

/// A replay on a simulated clock, with a gateway whose answers the test gives.
class ReplayTest : public testing::Test {
protected:
    void begin(std::vector<pcapng::Packet> packets, const ReplaySettings& settings = {})
    {
        script_ = script(std::move(packets));
        replay_.emplace(script_, DriveSide::unknown, settings, kStart);
    }

    /// The next telegram; the clock moves on until it comes, or to the end.
    std::optional<Octets> next()
    {
        while (!replay_->done()) {
            if (auto telegram = replay_->take_transmit(now_)) return telegram;
            now_ = std::max(now_, replay_->next_deadline());
            replay_->on_time(now_);
        }
        return std::nullopt;
    }
    /// The gateway answers after this time.
    void answer(std::chrono::nanoseconds after, const std::string& octets)
    {
        now_ += after;
        replay_->on_bytes(wire(octets), now_);
    }
    Instant::duration passed() const { return now_ - kStart; }
    const ReplayCounters& counters() const { return replay_->counters(); }
    std::vector<std::string> lines() { return replay_->take_lines(); }

    ReplayScript script_;
    std::optional<Replay> replay_;
    Instant now_ = kStart;
};

TEST_F(ReplayTest, SendsWhatWasHeardAndFindsNoDifferenceInEqualAnswers)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(2, kOperate), bus_in(3, kDiagRequest),
           bus_out(4, kDiagReady)});

    EXPECT_EQ(next(), wire(kFdlStatus));
    answer(1ms, kFdlStatusOk);
    EXPECT_EQ(next(), wire(kOperate));
    EXPECT_EQ(next(), wire(kDiagRequest));
    answer(1ms, kDiagReady);
    EXPECT_EQ(next(), std::nullopt);

    EXPECT_THAT(lines(), IsEmpty());
    EXPECT_EQ(counters().sent, 3U);
    EXPECT_EQ(counters().compared, 2U);
    EXPECT_EQ(counters().differences, 0U);
}

TEST_F(ReplayTest, KeepsThePausesOfTheCapture)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(501, kFdlStatus),
           bus_out(502, kFdlStatusOk)});

    next();
    answer(3ms, kFdlStatusOk);
    next();

    EXPECT_EQ(passed(), 503ms);
}

TEST_F(ReplayTest, WithoutThemGoesOnWhenTheBusMay)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(501, kFdlStatus),
           bus_out(502, kFdlStatusOk)},
          {.in_time = false});

    next();
    answer(3ms, kFdlStatusOk);
    next();

    EXPECT_EQ(passed(), 3ms + duration_of(Tbit{37}, Baud::k187_5));
}

TEST_F(ReplayTest, AnAnswerThatDiffersIsNamedWithBothForms)
{
    begin({bus_in(0, kChkCfg), bus_out(1, "E5"), bus_in(2, kOperate)});

    next();
    answer(1ms, "10 02 05 03 0A 16");
    next();

    EXPECT_THAT(
        lines(),
        ElementsAre("packet 2: the answer to Chk_Cfg request 2 to 5 differs: it has 6 octets, there 1",
                    "  in the capture  E5", "  now             10 02 05 03 0A 16"));
    EXPECT_EQ(counters().differences, 1U);
}

TEST_F(ReplayTest, ATelegramWithoutAnswerIsRepeatedThenReported)
{
    begin({bus_in(0, kDiagRequest), bus_out(1, kDiagReady)}, {.retries = 2});

    EXPECT_EQ(next(), wire(kDiagRequest));
    EXPECT_EQ(next(), wire(kDiagRequest));
    EXPECT_EQ(next(), wire(kDiagRequest));
    EXPECT_EQ(next(), std::nullopt);

    EXPECT_THAT(lines(), ElementsAre("packet 1: Slave_Diag request 2 to 5 is not answered",
                                     StartsWith("  in the capture  68 0B")));
    EXPECT_EQ(counters().retries, 2U);
    EXPECT_EQ(counters().sent, 1U);
    EXPECT_EQ(counters().differences, 1U);
}

TEST_F(ReplayTest, ALateAnswerToARepetitionIsNoDifference)
{
    begin({bus_in(0, kDiagRequest), bus_out(1, kDiagReady)});

    next();
    next();
    answer(1ms, kDiagReady);

    EXPECT_EQ(next(), std::nullopt);
    EXPECT_EQ(counters().differences, 0U);
}

TEST_F(ReplayTest, AnAnswerMayComeInPieces)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk)});

    next();
    answer(1ms, "10 02 05");
    answer(1ms, "00 07 16");

    EXPECT_EQ(next(), std::nullopt);
    EXPECT_EQ(counters().compared, 1U);
    EXPECT_EQ(counters().differences, 0U);
}

TEST_F(ReplayTest, WhatIsNoTelegramIsNoAnswer)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk)}, {.retries = 0});

    next();
    answer(1ms, "FF FF");
    EXPECT_EQ(next(), std::nullopt);

    EXPECT_THAT(lines(), ElementsAre("packet 1: FDL status request 2 to 5 is not answered with a telegram",
                                     StartsWith("  in the capture"), "  now             FF FF"));
}

TEST_F(ReplayTest, AnAnswerThatTheCaptureDoesNotHaveIsADifference)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk), bus_in(2, kOperate)});

    next();
    answer(1ms, kFdlStatusOk);
    next();
    answer(1ms, "E5");
    EXPECT_EQ(next(), std::nullopt);

    EXPECT_THAT(lines(),
                ElementsAre(HasSubstr("packet 3: octets that were not asked for, after Global_Control"),
                            "  now             E5"));
    EXPECT_EQ(counters().differences, 1U);
}

TEST_F(ReplayTest, OctetsBehindAnAnswerAreADifference)
{
    begin({bus_in(0, kFdlStatus), bus_out(1, kFdlStatusOk)});

    next();
    answer(1ms, kFdlStatusOk + " E5");

    EXPECT_EQ(counters().differences, 1U);
}

TEST_F(ReplayTest, AtTheEndSaysWhatWasCompared)
{
    EXPECT_EQ(in_words({.sent = 5, .compared = 4, .masked = 1, .retries = 0, .differences = 0}),
              "5 telegrams sent, 4 answers compared, 1 of them without what depends on the drive, 0 retries: "
              "no difference");
    EXPECT_THAT(in_words({.differences = 2}), HasSubstr("0 retries: 2 differences"));
    EXPECT_THAT(in_words({.retries = 1, .differences = 1}), EndsWith("1 retry: 1 difference"));
}

} // namespace
} // namespace dpslave::sim
