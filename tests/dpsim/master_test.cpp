// SPDX-License-Identifier: Apache-2.0
// The DP master against a slave of hand-written octets (wire reference 4.2, 2.6, 4.10, 6.4).
#include "dpsim/common/bus_times.hpp"
#include "master_bench.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace dpslave::sim {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

class MasterTest : public MasterBench {};

TEST_F(MasterTest, StartsUpWithTheTelegramsOfTheReference)
{
    master.start();
    expect("10 05 02 49 50 16", "10 02 05 00 07 16");
    expect("68 05 05 68 85 82 6D 3C 3E EE 16", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
    expect("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "E5");
    expect("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "E5");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16");
    expect("68 05 05 68 85 82 7D 3C 3E FE 16", "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16");
    expect("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16", "");
    expect("68 05 05 68 05 02 5D 00 00 64 16", "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(master.state(), MasterState::data_exchange);
    EXPECT_EQ(hex(master.inputs()), "12 34");
    EXPECT_TRUE(violations().empty());
}

TEST_F(MasterTest, ReadsTheDiagnosisWhenTheAnswerIsOfHighPriority)
{
    exchanging();
    master.outputs() = wire("A5 01");
    expect("68 05 05 68 05 02 7D A5 01 2A 16", "68 05 05 68 02 05 0A 12 34 57 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 01 FA 16");
    expect("68 05 05 68 05 02 7D A5 01 2A 16", "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(hex(master.diagnosis()->octets), "08 0C 00 02 47 11 02 01");
    EXPECT_EQ(master.counters().diagnosis_pending, 1U);
}

TEST_F(MasterTest, ReportsAChangedDiagnosisOnce)
{
    exchanging();
    const auto diagnoses = [&] {
        collect();
        return std::count_if(events.begin(), events.end(),
                             [](const MasterEvent& e) { return e.kind == MasterEvent::Kind::diagnosis; });
    };
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 0A 12 34 57 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 01 FA 16");
    EXPECT_EQ(diagnoses(), 1);
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 0A 12 34 57 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 01 FA 16");
    EXPECT_EQ(diagnoses(), 1) << "it is the same one";
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 0A 12 34 57 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 00 F9 16");
    EXPECT_EQ(diagnoses(), 2);
}

TEST_F(MasterTest, RepeatsARequestWithoutAnswerOctetForOctet)
{
    exchanging();
    master.outputs() = wire("12 34");
    expect("68 05 05 68 05 02 7D 12 34 CA 16", "");
    expect("68 05 05 68 05 02 7D 12 34 CA 16", "68 05 05 68 02 05 08 AA 55 0E 16");
    master.outputs() = wire("12 35");
    expect("68 05 05 68 05 02 5D 12 35 AB 16", "68 05 05 68 02 05 08 AA 56 0F 16");
    EXPECT_EQ(master.counters().retries, 1U);
    EXPECT_EQ(master.counters().missing, 0U);
}

TEST_F(MasterTest, RepeatsARequestWhoseAnswerIsBroken)
{
    exchanging();
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 08 12 34 54 16");
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_EQ(master.counters().invalid, 1U);
    EXPECT_THAT(violations(), HasSubstr("FCS"));
}

TEST_F(MasterTest, WaitsTheSlotTimeAndTheAllowanceForAnAnswer)
{
    exchanging();
    const auto telegram = next();
    ASSERT_TRUE(telegram);
    // 11 octets, the slot time of 100 bit times, the character that ends it; 20 ms for the host: 232 bit
    // times at 187500
    EXPECT_EQ(master.next_deadline() - sent_at,
              duration_of(Tbit{11 * 11 + 100 + 11}, Baud::k187_5) + std::chrono::milliseconds{20});
}

TEST_F(MasterTest, SearchesAgainWhenTheSlaveIsGoneAndStartsUpWhenItIsBack)
{
    exchanging();
    expect("68 05 05 68 05 02 7D 00 00 84 16", "");
    expect("68 05 05 68 05 02 7D 00 00 84 16", "");
    expect("10 05 02 49 50 16", "");
    EXPECT_EQ(master.state(), MasterState::searching);
    EXPECT_EQ(master.counters().exchanges_lost, 1U);
    EXPECT_TRUE(master.inputs().empty()) << "old values must not pass for present ones";
    expect("10 05 02 49 50 16", "10 02 05 00 07 16");
    expect("68 05 05 68 85 82 6D 3C 3E EE 16", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
    EXPECT_EQ(master.state(), MasterState::parameterising);
}

TEST_F(MasterTest, ParameterisesAgainWhenTheSlaveHasLeftDataExchange)
{
    exchanging();
    expect("68 05 05 68 05 02 7D 00 00 84 16", "10 02 05 03 0A 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16");
    EXPECT_EQ(master.state(), MasterState::parameterising);
    EXPECT_EQ(master.counters().refused, 1U);
}

TEST_F(MasterTest, SaysThatSetPrmWasRefusedAfterChkCfgIsAnsweredWithRs)
{
    to_set_prm();
    expect("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "E5");
    expect("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "10 02 05 03 0A 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 42 05 00 FF 47 11 27 16");
    EXPECT_THAT(refusal(), HasSubstr("does not take User_Prm_Data"));
    EXPECT_NE(master.state(), MasterState::data_exchange);
}

TEST_F(MasterTest, SaysThatTheIdentIsAnotherOne)
{
    to_set_prm();
    expect("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "E5");
    expect("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "10 02 05 03 0A 16");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 42 05 00 FF 05 33 07 16");
    EXPECT_THAT(refusal(), HasSubstr("its ident is 0x4711, the slave's is 0x0533"));
}

TEST_F(MasterTest, SaysThatTheConfigurationDoesNotFit)
{
    to_set_prm();
    expect("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16", "E5");
    expect("68 07 07 68 85 82 7D 3E 3E 11 21 32 16", "E5");
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "68 0B 0B 68 82 85 08 3E 3C 06 05 00 FF 47 11 EB 16");
    EXPECT_THAT(refusal(), HasSubstr("Chk_Cfg was refused: Cfg_Data 11 21"));
}

TEST_F(MasterTest, LeavesASlaveOfAnotherMasterAlone)
{
    master.start();
    expect("10 05 02 49 50 16", "10 02 05 00 07 16");
    expect("68 05 05 68 85 82 6D 3C 3E EE 16", "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 09 47 11 F6 16");
    EXPECT_THAT(refusal(), HasSubstr("belongs to master 9"));
    expect("68 05 05 68 85 82 5D 3C 3E DE 16", "");
}

TEST_F(MasterTest, SendsZerosInClearAndSaysSo)
{
    exchanging();
    master.outputs() = wire("A5 01");
    master.clear(true);
    expect("68 07 07 68 FF 82 46 3A 3E 02 00 41 16", "");
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 08 12 34 55 16");
    master.clear(false);
    expect("68 07 07 68 FF 82 46 3A 3E 00 00 3F 16", "");
    expect("68 05 05 68 05 02 5D A5 01 0A 16", "68 05 05 68 02 05 08 12 34 55 16");
}

TEST_F(MasterTest, ReportsAnAnswerFromAnotherStation)
{
    exchanging();
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 06 08 12 34 56 16");
    expect("68 05 05 68 05 02 7D 00 00 84 16", "68 05 05 68 02 05 08 12 34 55 16");
    EXPECT_THAT(violations(), HasSubstr("comes from station 6"));
}

TEST_F(MasterTest, ReportsTheStationTypeOfAMaster)
{
    master.start();
    expect("10 05 02 49 50 16", "10 02 05 20 27 16");
    idle_out();
    EXPECT_THAT(violations(), HasSubstr("station type"));
    EXPECT_EQ(master.state(), MasterState::searching);
}

TEST_F(MasterTest, ReportsInputsOfAnotherLength)
{
    exchanging();
    expect("68 05 05 68 05 02 7D 00 00 84 16", "E5");
    EXPECT_NE(master.state(), MasterState::data_exchange);
    EXPECT_THAT(losses(), HasSubstr("should bring 2 octets"));
}

TEST_F(MasterTest, ReportsOctetsWithoutARequest)
{
    exchanging();
    master.on_bytes(wire("E5"), now);
    EXPECT_THAT(violations(), HasSubstr("not asked for"));
    EXPECT_EQ(master.counters().unasked_octets, 1U);
}

TEST_F(MasterTest, TakesAnAnswerThatComesInPieces)
{
    exchanging();
    ASSERT_TRUE(next());
    for (const std::uint8_t octet : wire("68 05 05 68 02 05 08 12 34 55 16")) {
        now += std::chrono::microseconds{60};
        master.on_bytes(Octets{octet}, now);
    }
    EXPECT_EQ(master.counters().cycles, 2U);
}

TEST_F(MasterTest, PausesAtLeast37BitTimesBeforeTheNextRequest)
{
    exchanging();
    master.order({Service::slave_diag, {}});
    EXPECT_EQ(master.next_deadline() - now, duration_of(Tbit{37}, Baud::k187_5));
}

TEST_F(MasterTest, ReportsAnOrderWithoutAnAnswer)
{
    master.order({Service::slave_diag, {}});
    expect("68 05 05 68 85 82 6D 3C 3E EE 16", "");
    expect("68 05 05 68 85 82 6D 3C 3E EE 16", "");
    idle_out();
    EXPECT_EQ(answer_words(), "no answer");
}

TEST_F(MasterTest, SendsRawOctetsAsTheyAreAndReportsWhatComes)
{
    master.order({Service::raw, wire("10 05 02 49 50 16")});
    expect("10 05 02 49 50 16", "10 02 05 00 07 16");
    EXPECT_THAT(answer_words(), HasSubstr("OK"));
}

TEST_F(MasterTest, FallsSilentWhenItStops)
{
    exchanging();
    master.stop();
    EXPECT_EQ(master.next_deadline(), kNever);
    EXPECT_FALSE(next());
}

TEST(MasterSettingsTest, MakeTheDataUnitOfSetPrm)
{
    MasterSettings s;
    s.user_prm = wire("00 37 00 38 01 20 00 00");
    EXPECT_EQ(hex(set_prm_unit(s)), "B8 64 01 0B 05 33 01 00 37 00 38 01 20 00 00");
    s.watchdog = std::chrono::milliseconds{0};
    s.sync = s.freeze = false;
    EXPECT_EQ(hex(set_prm_unit(s)), "80 01 01 0B 05 33 01 00 37 00 38 01 20 00 00");
}

TEST(MasterSettingsTest, NeverMakeTheWatchdogShorterThanAsked)
{
    for (const int ms : {10, 15, 990, 2560, 3333, 10'010, 650'250}) {
        MasterSettings s;
        s.watchdog = std::chrono::milliseconds{ms};
        const Octets unit = set_prm_unit(s);
        const int got = unit[1] * unit[2] * 10;
        EXPECT_GE(got, ms);
        EXPECT_LE(got, ms + ms / 20 + 10) << ms;
    }
}

/// A master that is not alone on its bus.
class MasterOfABusyBus : public MasterBench {
protected:
    MasterOfABusyBus() : MasterBench(settings()) {}
    static MasterSettings settings()
    {
        MasterSettings s = reference_settings();
        s.others = 2;
        return s;
    }
};

TEST_F(MasterOfABusyBus, SendsTheTelegramsOfTheOthersBeforeEachRequestNeverTheSameTwice)
{
    master.start();

    const std::string first = hex(*next());
    EXPECT_TRUE(
        first.starts_with("68 0B 0B 68 5A 02 5D 00 00 00 00 00 00 00 00 B9 16 68 23 23 68 02 5A 08 00"));
    EXPECT_NE(first.find("68 0B 0B 68 5B 02 7D 00 00 00 01 00 00 00 00 DB 16"), std::string::npos);
    EXPECT_TRUE(first.ends_with(" 10 05 02 49 50 16"));
    idle_out();
    EXPECT_NE(hex(*next()).find("68 0B 0B 68 5A 02 5D 00 00 00 02 00 00 00 00 BB 16"), std::string::npos);
}

TEST_F(MasterOfABusyBus, WaitsForAnAnswerUntilTheTelegramsOfTheOthersAreOnTheLine)
{
    master.start();
    const std::size_t octets = next()->size();

    EXPECT_GE(master.next_deadline(), now + duration_of(characters(octets), Baud::k187_5));
}

struct CfgCase {
    const char* octets;
    std::size_t inputs, outputs;
};
class CfgLengthsOf : public testing::TestWithParam<CfgCase> {};
TEST_P(CfgLengthsOf, AddUpAsTheReferenceSays)
{
    const auto lengths = cfg_lengths(wire(GetParam().octets));
    ASSERT_TRUE(lengths) << lengths.error();
    EXPECT_EQ(lengths->inputs, GetParam().inputs);
    EXPECT_EQ(lengths->outputs, GetParam().outputs);
}
INSTANTIATE_TEST_SUITE_P(WireReference45, CfgLengthsOf,
                         testing::Values(CfgCase{"10", 1, 0}, CfgCase{"11", 2, 0}, CfgCase{"20", 0, 1},
                                         CfgCase{"30", 1, 1}, CfgCase{"50", 2, 0}, CfgCase{"60", 0, 2},
                                         CfgCase{"D3", 8, 0}, CfgCase{"B7", 8, 8}, CfgCase{"FF", 32, 32},
                                         CfgCase{"73", 8, 8}, CfgCase{"40 01", 2, 0}, CfgCase{"80 C3", 0, 8},
                                         CfgCase{"C0 00 01", 2, 1}, CfgCase{"42 01 AA BB", 2, 0},
                                         CfgCase{"01 0A", 0, 0}, CfgCase{"00 10 10", 2, 0},
                                         CfgCase{"73 50 60 50", 12, 10}));

TEST(CfgLengthsTest, RefuseWhatIsIncompleteOrTooLong)
{
    EXPECT_FALSE(cfg_lengths(wire("40")));
    EXPECT_FALSE(cfg_lengths(wire("42 01 AA")));
    EXPECT_FALSE(cfg_lengths(wire("FF FF FF FF FF FF FF FF")));
}

} // namespace
} // namespace dpslave::sim
