// SPDX-License-Identifier: Apache-2.0
/// The judge is judged: the simulated bus must fail a test in which its rules are broken.
#include "bench.hpp"

#include <gtest/gtest-spi.h>

using namespace dpslave;
using namespace test;

namespace {

class Judge : public FdlStation {};

TEST_F(Judge, SeesAReplyBeforeMinTsdr)
{
    bus.set_min_tsdr(12_tbit); // the slave keeps 11
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));

    EXPECT_NONFATAL_FAILURE(bus.reply(), "reply before min T_SDR");
}

TEST_F(Judge, SeesAReplyAfterTheDeadline)
{
    fdl::Layer2 slow{fdl::Layer2Settings{}};
    slow.attach(kUs, user, {100_tbit, 100_tbit, 100_tbit, 100_tbit, 100_tbit, 100_tbit, 100_tbit});
    Bus line{slow}; // where 60 are allowed
    line.edge_is_late_by(line.bits(60));
    line.master_sends(sd1(kUs, kMaster, kFdlStatus));

    EXPECT_NONFATAL_FAILURE(line.advance(line.bits(90)), "reply after the deadline");
}

TEST_F(Judge, SeesAMasterThatDoesNotWaitForTsyn)
{
    bus.master_sends(sd1(kOther, kMaster, kFdlStatus));

    EXPECT_NONFATAL_FAILURE(bus.master_sends_after(bus.bits(32), sd1(kOther, kMaster, kFdlStatus)),
                            "before T_SYN");
}

TEST_F(Judge, SeesTwoStationsThatSendAtOnce)
{
    bus.master_sends(sd1(kUs, kMaster, kFdlStatus));
    bus.advance(bus.bits(12)); // the reply has begun

    EXPECT_NONFATAL_FAILURE(bus.breaks_in_after(-bus.bits(30), sd1(kOther, kMaster, kFdlStatus)),
                            "two talk at once");
}

TEST(SecondHand, RefusesWhatIsNoTelegram)
{
    for (const char* wrong :
         {"", "16", "10 05 02 49 51 16", "10 05 02 49 50 17", "10 05 02 49 50", "68 03 03 68 05 02 7D 84 16",
          "68 05 06 68 85 82 6D 3C 3E EE 16", "10 85 02 49 D0 16", "10 05 7F 49 CD 16", "DC 04", "E5 E5"})
        EXPECT_FALSE(heard(octets(wrong))) << wrong;
}

TEST(SecondHand, RecognisesWhatAsksForAnAnswer)
{
    EXPECT_TRUE(ends_with_answerable_request(octets("10 05 02 49 50 16")));
    EXPECT_TRUE(ends_with_answerable_request(octets("E5 00 68 05 05 68 85 82 6D 3C 3E EE 16")));
    EXPECT_FALSE(ends_with_answerable_request(octets("10 05 02 49 50 16 00")));
    EXPECT_FALSE(ends_with_answerable_request(octets("10 7F 02 49 CA 16")));
    EXPECT_FALSE(ends_with_answerable_request(octets("10 02 05 00 07 16")));
    EXPECT_FALSE(ends_with_answerable_request(octets("68 07 07 68 85 82 46 3A 3E 00 00 C5 16")));
    EXPECT_FALSE(ends_with_answerable_request(octets("10 05 02 4A 51 16")));
}

TEST(SecondHand, BuildsThePrintedTelegrams)
{
    EXPECT_EQ(sd1(5, 2, 0x49), octets("10 05 02 49 50 16"));
    EXPECT_EQ(sd2(5, 2, 0x7D, {0x12, 0x34}), octets("68 05 05 68 05 02 7D 12 34 CA 16"));
    EXPECT_EQ(sd2(5, 2, 0x6D, Saps{60, 62}), octets("68 05 05 68 85 82 6D 3C 3E EE 16"));
    EXPECT_EQ(sd3(5, 2, 0x7D, octets("01 02 03 04 05 06 07 08")),
              octets("A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16"));
    EXPECT_EQ(sd3(5, 2, 0x5D, Saps{62, 62}, octets("10 10 11 20 20 21")),
              octets("A2 85 82 5D 3E 3E 10 10 11 20 20 21 72 16"));
    EXPECT_EQ(token(4, 2), octets("DC 04 02"));
    EXPECT_EQ(sc(), octets("E5"));
}

} // namespace
