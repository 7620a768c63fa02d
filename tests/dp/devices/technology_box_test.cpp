// SPDX-License-Identifier: Apache-2.0
/// HA463561, "Configuring the PLC/SCADA Supervisor" (B-061 to B-073, X-14, X-33, X-44): how a master chooses
/// the parameters of a technology box.
#include "dp/bench.hpp"

namespace test {
namespace {

using dpslave::LayoutEntry;
using dpslave::dp::Refusal;
using dpslave::dp::RefusalDetail;
using dpslave::dp::State;

class TechnologyBox : public DpBench {
protected:
    TechnologyBox() : DpBench(technology_box()) {}
    static std::string prm(std::string_view user, std::string_view status = "88 14 01 0B")
    {
        return std::string{status} + " 16 49 01 " + std::string{user};
    }
};

TEST_F(TechnologyBox, TakesTheExampleOfTagsFromOctet3)
{
    start_up(prm("00 00 00 01 0F 01 0D 01 10 00 FF"), "60 60 50 50");

    const auto layout = seen().layout;
    EXPECT_EQ(layout.parameters[0], output(271));
    EXPECT_EQ(layout.parameters[1], output(269));
    EXPECT_EQ(layout.parameters[2], input(272));
    EXPECT_EQ(layout.parameters[3], input(255));
}

TEST_F(TechnologyBox, TakesTheFormOf63OctetsPaddedWithZeros)
{
    Octets user = octets("00 00 00 01 0F 01 0D 01 10 00 FF");
    user.resize(63);
    start_up(prm(show(user)), "60 60 50 50");

    EXPECT_EQ(seen().layout.count, 4);
}

TEST_F(TechnologyBox, OneIdentifierReadsAndWritesTheSameParameter)
{
    start_up(prm("00 00 00 00 10 00 20"), "70 50");
    inputs_are({0x1111, 0x2222});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("AA BB"), "DL 11 11 22 22");

    EXPECT_EQ(seen().outputs[0], 0xAABB);
    EXPECT_EQ(seen().layout.parameters[0], (LayoutEntry{16, true, true}));
}

TEST_F(TechnologyBox, NoUserPrmDataIsNoTags)
{
    start_up("88 14 01 0B 16 49 01", "73");

    EXPECT_EQ(seen().layout.count, 0);
}

TEST_F(TechnologyBox, RefusesAZeroBetweenTags)
{
    master.set_prm(prm("00 00 00 00 10 00 00 00 20"));

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_zero_tag, 13, 1, 0}));
}

TEST_F(TechnologyBox, RefusesAnOddLength)
{
    master.set_prm(prm("00 00 00 00 10 00"));

    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_length, 0, 5, 6}));
}

TEST_F(TechnologyBox, RefusesDpV1FunctionsAndSaysWhichOctet)
{
    master.set_prm(prm("80 00 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 8, 0x00, 0x80}));
    master.set_prm(prm("44 00 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 8, 0x04, 0x44}));
    master.set_prm(prm("00 01 00"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 9, 0x00, 0x01}));
    master.set_prm(prm("00 00 08"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, 10, 0x00, 0x08}));
}

TEST_F(TechnologyBox, RefusesEachDpV1BitAlone)
{
    for (std::size_t octet = 0; octet < 3; ++octet)
        for (unsigned bit = octet == 0 ? 3 : 0; bit < 8; ++bit) {
            Octets status(3);
            status[octet] = static_cast<std::uint8_t>(1u << bit);
            master.set_prm(prm(show(status)));
            EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_dpv1, static_cast<std::uint16_t>(8 + octet),
                                                     0, static_cast<std::uint16_t>(1u << bit)}));
        }
}

TEST_F(TechnologyBox, WdBaseMakesTheWatchdogCountMilliseconds)
{
    master.set_prm(prm("04 00 00"));

    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{20});
}

TEST_F(TechnologyBox, TheBitsOfTheAsicsStartAndStopCheckDoNoHarm)
{
    master.set_prm(prm("03 00 00"));

    EXPECT_EQ(state(), State::wait_cfg);
    EXPECT_EQ(seen().watchdog, std::chrono::milliseconds{200});
}

/// User_Prm_Data with the tags 101, 102 ...
std::string tags_from_101(std::size_t count)
{
    Octets user(3);
    for (std::size_t i = 0; i < count; ++i) {
        user.push_back(0);
        user.push_back(static_cast<std::uint8_t>(101 + i));
    }
    return show(user);
}

TEST_F(TechnologyBox, TakesEveryLengthOf3And2nUpTo30Tags)
{
    for (std::size_t n = 0; n <= 30; ++n) {
        SCOPED_TRACE(n);
        start_up(prm(tags_from_101(n)), "73 " + show(Octets(n, 0x50)));
        ASSERT_EQ(seen().layout.count, n);
        if (n != 0) {
            EXPECT_EQ(seen().layout.parameters[n - 1], input(static_cast<std::uint16_t>(100 + n)));
        }
        master.set_prm("40 00 00 00 16 49 00");
    }
}

TEST_F(TechnologyBox, RefusesEveryOtherLengthButNone)
{
    for (std::size_t length = 1; length <= 80; ++length) {
        if (length >= 3 && length <= 63 && length % 2 == 1) continue;
        master.set_prm(prm(show(Octets(length))));
        EXPECT_EQ(state(), State::wait_prm) << length;
        EXPECT_EQ(seen().refusal.why, Refusal::prm_length) << length;
        EXPECT_EQ(seen().refusal.got, length);
    }
    master.set_prm(prm(show(Octets(64))));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_length, 0, 63, 64}));
}

TEST_F(TechnologyBox, TakesZerosBehindTheTagsWhereverTheListEnds)
{
    start_up(prm("00 00 00 00 10 00 00 00 00"), "50");
    EXPECT_EQ(seen().layout.count, 1);
    master.set_prm("40 00 00 00 16 49 00");

    start_up(prm(show(Octets(63))), "73"); // the GSD's 63 zeros: no tags
    EXPECT_EQ(seen().layout.count, 0);
}

TEST_F(TechnologyBox, RefusesAZeroInFrontOfATagHoweverManyFollowIt)
{
    master.set_prm(prm("00 00 00 00 00 00 10")); // the very first
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_zero_tag, 11, 1, 0}));
    master.set_prm(prm("00 00 00 00 10 00 00 00 00 00 20"));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::prm_zero_tag, 13, 1, 0}));
    EXPECT_EQ(master.slave_diag(), "DL 42 05 00 FF 16 49 04 00 00 00");
}

TEST_F(TechnologyBox, TakesThirtyParametersWithDemandDataAndWithout)
{
    start_up(prm(tags_from_101(30)), show(Octets(30, 0x70)));
    EXPECT_EQ(seen().layout.parameters[29], (LayoutEntry{130, true, true}));
    EXPECT_EQ(master.data_exchange(Octets(60)), "DH " + show(Octets(60)));
    master.set_prm("40 00 00 00 16 49 00");

    start_up(prm(tags_from_101(30)), "73 " + show(Octets(30, 0x70)));
    EXPECT_EQ(seen().layout.count, 30);
    EXPECT_EQ(master.data_exchange(Octets(68)), "DH " + show(Octets(68)));
}

TEST_F(TechnologyBox, RefusesThirtyOneParameters)
{
    master.set_prm(prm(tags_from_101(30)));
    master.chk_cfg(show(Octets(31, 0x50)));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 31, 30, 31}));

    master.set_prm(prm(tags_from_101(30)));
    master.chk_cfg("73 " + show(Octets(31, 0x50)));
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 32, 31, 32}));
    EXPECT_EQ(master.slave_diag(), "DL 06 05 00 FF 16 49 04 00 00 00");
}

TEST_F(TechnologyBox, CountsTagsAndIdentifiersWithoutDemandData)
{
    master.set_prm(prm(tags_from_101(3)));
    master.chk_cfg("73 50 60");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_few, 0, 3, 2}));

    master.set_prm(prm(tags_from_101(3)));
    master.chk_cfg("73 50 60 70 50");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_many, 5, 3, 4}));

    start_up(prm(tags_from_101(3)), "73 50 60 70");
}

TEST_F(TechnologyBox, RefusesOtherIdentifiersAndDemandDataElsewhereThanFirst)
{
    for (const std::string_view octet : {"73", "51", "61", "71", "D0", "00", "FF"}) {
        master.set_prm(prm(tags_from_101(2)));
        master.chk_cfg("70 " + std::string{octet});
        EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_identifier, 2, 0x50, octets(octet)[0]}));
    }
}

TEST_F(TechnologyBox, MixesAllThreeIdentifiersInAnyOrderFromOctet0)
{
    start_up(prm(tags_from_101(5)), "60 70 50 60 70");
    inputs_are({0, 0x0202, 0x0303, 0, 0x0505});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("10 11 20 21 40 41 50 51"), "DL 02 02 03 03 05 05");

    const auto words = slave.take_outputs()->words;
    EXPECT_EQ(words[0], 0x1011);
    EXPECT_EQ(words[1], 0x2021);
    EXPECT_EQ(words[3], 0x4041);
    EXPECT_EQ(words[4], 0x5051);
    EXPECT_EQ(seen().layout.parameters[2], input(103));
    EXPECT_EQ(seen().layout.parameters[3], output(104));
}

TEST_F(TechnologyBox, MixesAllThreeIdentifiersInAnyOrderFromOctet8WithDemandData)
{
    start_up(prm(tags_from_101(3)), "73 70 60 50");
    inputs_are({0x0101, 0, 0x0303});
    diagnosis_is_read();

    EXPECT_EQ(master.data_exchange("00 00 00 00 00 00 00 00 10 11 20 21"),
              "DL 00 00 00 00 00 00 00 00 01 01 03 03");
    EXPECT_EQ(seen().outputs[0], 0x1011);
    EXPECT_EQ(seen().outputs[1], 0x2021);
}

TEST_F(TechnologyBox, AWordThatGoesBothWaysCountsTwice)
{
    personality.max_words = 3;
    master.set_prm(prm(tags_from_101(2)));
    master.chk_cfg("70 70");
    EXPECT_EQ(seen().refusal, (RefusalDetail{Refusal::cfg_too_long, 2, 1, 2}));

    start_up(prm(tags_from_101(2)), "70 60");
}

/// Sync and Freeze by device: HA389815 has them, HA463561 is silent and has them, the handbook refuses
///
TEST_F(TechnologyBox, HasSyncAndFreeze)
{
    start_up(prm(tags_from_101(2), "B8 14 01 0B"), "60 50");
    inputs_are({0, 1});
    diagnosis_is_read();
    master.control("28 00"); // Sync, Freeze
    inputs_are({0, 2});

    EXPECT_EQ(master.data_exchange("00 07"), "DL 00 01");
    EXPECT_EQ(seen().outputs[0], 0);
    master.control("14 00"); // Unsync, Unfreeze
    EXPECT_EQ(seen().outputs[0], 7);
    EXPECT_EQ(master.data_exchange("00 07"), "DL 00 02");
}

} // namespace
} // namespace test
