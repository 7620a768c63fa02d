// SPDX-License-Identifier: Apache-2.0
/// Who is on the bus, as a slave hears it: masters, other slaves, and addresses that nobody has.
#include "dp/bench.hpp"

#include "dpslave/dp/bus_members.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using namespace std::chrono_literals;
using namespace test;
using testing::ElementsAre;

namespace {

constexpr std::uint8_t kFirst = 0x6D;  ///< SRD high, the first request: FCV 0, FCB 1
constexpr std::uint8_t kFcb0 = 0x5D;   ///< SRD high, FCV 1, FCB 0
constexpr std::uint8_t kFcb1 = 0x7D;   ///< SRD high, FCV 1, FCB 1
constexpr std::uint8_t kStatus = 0x49; ///< FDL_Status
constexpr std::uint8_t kData = 0x08;   ///< reply with data, low

/// Slave 5 listens; slave 7 and masters 1 and 2 are others.
class BusMembers : public testing::Test {
protected:
    BusMembers() { station.listen(&members); }

    const dp::Member& member(std::uint8_t address) const { return members.table()[address]; }
    dp::Recurrence::Figures figures(std::uint8_t address) const
    {
        return member(address).recurrence.figures(bus.now());
    }
    void other_answers(const Octets& reply)
    {
        bus.breaks_in_after(duration_of(Tbit{40}, Baud::k187_5), reply);
    }
    void diagnosis_of_7(std::uint8_t first, std::uint8_t second)
    {
        bus.master_sends(sd2(7, 2, kFirst, Saps{60, 62}));
        other_answers(sd2(2, 7, kData, Saps{62, 60}, {first, second, 0, 2, 0x80, 0x21}));
    }
    std::vector<int> unanswered() const
    {
        std::vector<int> all;
        for (const dp::UnansweredAddress& one : members.unanswered())
            if (one.requests != 0) all.push_back(one.address);
        return all;
    }

    dp::BusMembers members;
    fdl::Layer2 station{fdl::Layer2Settings{}};
    Bus bus{station};
};

TEST_F(BusMembers, AreMastersIfTheyAskAndSlavesIfTheyAnswer)
{
    bus.master_sends(sd2(7, 2, kFirst, {0x12}));
    other_answers(sd2(2, 7, kData, {0x34}));

    EXPECT_TRUE(member(2).is_master);
    EXPECT_FALSE(member(2).is_slave);
    EXPECT_TRUE(member(7).is_slave);
    EXPECT_FALSE(member(7).is_master);
    EXPECT_FALSE(member(8).was_seen());
    EXPECT_EQ(member(7).last_heard, bus.now());
}

TEST_F(BusMembers, AreMastersIfTheyAnswerFdlStatusWithTheTypeOfAMaster)
{
    bus.master_sends(sd1(3, 2, kStatus));
    other_answers(sd1(2, 3, 0x20)); // ready for the ring

    EXPECT_TRUE(member(3).is_master);
    EXPECT_FALSE(member(3).is_slave);
    EXPECT_EQ(member(3).asked, 0U) << "FDL_Status is no request for data";
}

TEST_F(BusMembers, AreAskedWithoutAnswerAsOftenAsTheMasterAsks)
{
    for (int i = 0; i < 3; ++i) bus.master_sends(sd2(7, 2, kFirst, Saps{61, 62}, {0x88}));
    bus.master_sends(sd2(9, 1, kFirst, Saps{60, 62}));
    for (std::uint8_t free = 10; free < 100; ++free) bus.master_sends(sd1(free, 2, kStatus));

    EXPECT_THAT(unanswered(), ElementsAre(7, 9)) << "the most asked first, and no free address of a GAP";
    EXPECT_EQ(members.unanswered()[0].requests, 3U);
    EXPECT_EQ(members.unanswered()[0].master, 2);
    EXPECT_LT(members.unanswered()[0].last, members.unanswered()[1].last);
    EXPECT_FALSE(member(7).is_slave) << "it was never heard";
}

TEST_F(BusMembers, AreNoLongerWithoutAnswerOnceTheyAnswer)
{
    bus.master_sends(sd2(7, 2, kFirst, Saps{60, 62}));
    bus.master_sends(sd2(8, 2, kFirst, Saps{61, 62}, {0x88}));
    EXPECT_THAT(unanswered(), ElementsAre(7, 8));

    bus.master_sends(sd2(7, 2, kFirst, Saps{60, 62}));
    other_answers(sd2(2, 7, kData, Saps{62, 60}, {0, 0}));
    bus.master_sends(sd2(8, 2, kFirst, Saps{61, 62}, {0x88}));
    other_answers(sc());

    EXPECT_TRUE(unanswered().empty());
}

TEST_F(BusMembers, AreNotCreditedWithAnScThatAnotherTelegramSeparatesFromTheRequest)
{
    bus.master_sends(sd2(8, 2, kFirst, Saps{61, 62}, {0x88}));
    bus.master_sends(token(2, 2));
    other_answers(sc());

    EXPECT_FALSE(member(8).is_slave);
    EXPECT_THAT(unanswered(), ElementsAre(8));
}

TEST_F(BusMembers, HaveTheStateThatTheirDiagnosisSays)
{
    using State = dp::Member::State;
    EXPECT_EQ(member(7).state, State::unknown);
    diagnosis_of_7(0x02, 0x05);
    EXPECT_EQ(member(7).state, State::prm_required);
    diagnosis_of_7(0x42, 0x05);
    EXPECT_EQ(member(7).state, State::prm_fault);
    diagnosis_of_7(0x06, 0x05);
    EXPECT_EQ(member(7).state, State::cfg_fault);
    diagnosis_of_7(0x02, 0x04);
    EXPECT_EQ(member(7).state, State::not_ready);
    diagnosis_of_7(0x00, 0x0C);
    EXPECT_EQ(member(7).state, State::ready);
}

TEST_F(BusMembers, AreInDataExchangeWhenTheyAnswerItWithDataOrAnSc)
{
    bus.master_sends(sd2(7, 2, kFirst, {0x12}));
    other_answers(sd1(2, 7, 0x03)); // RS: the service is not active
    EXPECT_EQ(member(7).state, dp::Member::State::unknown);

    bus.master_sends(sd2(7, 2, kFcb0, {0x12}));
    other_answers(sd2(2, 7, 0x0A, {0x34}));
    EXPECT_EQ(member(7).state, dp::Member::State::exchange);

    bus.master_sends(sd2(8, 2, kFirst, {0x12}));
    other_answers(sc());
    EXPECT_EQ(member(8).state, dp::Member::State::exchange);
}

TEST_F(BusMembers, HaveTheIdentOfTheirDiagnosisOrOfASetPrmToThem)
{
    diagnosis_of_7(0x02, 0x05);
    EXPECT_EQ(member(7).ident, 0x8021);

    bus.master_sends(sd2(9, 2, kFirst, Saps{61, 62}, {0x88, 1, 10, 11, 0x05, 0x33, 0}));
    EXPECT_EQ(member(9).ident, 0x0533);
    EXPECT_FALSE(member(2).ident.has_value());
}

TEST_F(BusMembers, CountARequestThatIsRepeatedWithoutAnAnswerAsRetry)
{
    bus.master_sends(sd2(7, 2, kFcb0, {0x12}));
    bus.master_sends(sd2(7, 2, kFcb0, {0x12}));
    bus.master_sends(sd2(7, 2, kFcb0, {0x12}));
    other_answers(sd2(2, 7, kData, {0x34}));
    bus.master_sends(sd2(7, 2, kFcb1, {0x12}));
    other_answers(sd2(2, 7, kData, {0x34}));

    EXPECT_EQ(member(7).asked, 2U);
    EXPECT_EQ(member(7).retries, 2U);
    EXPECT_EQ(member(7).answers, 2U);
}

TEST_F(BusMembers, HaveACycleFromOneNewDataExchangeToTheNext)
{
    std::uint8_t fc = kFcb0;
    const auto exchanges_after = [&](std::chrono::nanoseconds pause) {
        bus.advance(pause);
        bus.master_sends(sd2(7, 2, fc, {0x12}));
        other_answers(sd2(2, 7, kData, {0x34}));
        fc = fc == kFcb0 ? kFcb1 : kFcb0;
    };
    exchanges_after(0ms);
    const Instant begin = bus.asked_at();
    exchanges_after(20ms);
    const Instant second = bus.asked_at();
    bus.master_sends(sd2(7, 2, kFirst, Saps{60, 62})); // no part of the cycle
    exchanges_after(50ms);
    const Instant third = bus.asked_at();

    EXPECT_EQ(figures(7).intervals, 2U);
    EXPECT_EQ(figures(7).min, second - begin);
    EXPECT_EQ(figures(7).max, third - second);
    EXPECT_EQ(figures(7).mean, (third - begin) / 2);
}

TEST_F(BusMembers, HaveTheRotationOfTheTokenFromOneTokenToTheNext)
{
    bus.master_sends(token(2, 1));
    const Instant begin = bus.asked_at();
    bus.master_sends(token(1, 2));
    bus.advance(30ms);
    bus.master_sends(token(2, 1));
    const Instant second = bus.asked_at();

    EXPECT_TRUE(member(1).is_master);
    EXPECT_TRUE(member(2).is_master);
    EXPECT_EQ(figures(2).intervals, 1U);
    EXPECT_EQ(figures(2).mean, second - begin);
    EXPECT_EQ(figures(1).intervals, 0U) << "it was given the token only once";
}

TEST_F(BusMembers, HaveTheOctetsThatTheySendInASecond)
{
    std::uint8_t fc = kFcb0;
    for (int i = 0; i < 110; ++i) {
        bus.advance(100ms);
        bus.master_sends(sd2(7, 2, fc, {0x12}));             // 10 octets
        other_answers(sd2(2, 7, kData, {1, 2, 3, 4, 5, 6})); // 15 octets
        fc = fc == kFcb0 ? kFcb1 : kFcb0;
    }

    EXPECT_NEAR(figures(2).octets_per_second, 100, 5);
    EXPECT_NEAR(figures(7).octets_per_second, 150, 7);
}

TEST_F(BusMembers, LoseTheirFiguresAfterTwoWindowsOfSilence)
{
    bus.master_sends(sd2(7, 2, kFcb0, {0x12}));
    bus.advance(20ms);
    bus.master_sends(sd2(7, 2, kFcb1, {0x12}));
    ASSERT_EQ(figures(7).intervals, 1U);

    bus.advance(2 * dp::Recurrence::kWindow);

    EXPECT_EQ(figures(7).intervals, 0U);
    EXPECT_EQ(figures(2).octets_per_second, 0);
    EXPECT_TRUE(member(7).was_seen());
}

} // namespace
