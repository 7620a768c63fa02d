// SPDX-License-Identifier: Apache-2.0
// Slave_Diag, wire reference 5.1 and 5.3.
#include "dpsim/master/diagnosis.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Diagnosis, OfAFreeSlaveSaysNotReadyAndParametersRequired)
{
    const auto d = parse_diagnosis(wire("02 05 00 FF 05 33"));
    ASSERT_TRUE(d) << d.error();
    EXPECT_TRUE(d->has(kNotReady) && d->has(kPrmRequired));
    EXPECT_FALSE(d->has(kPrmFault) || d->has(kCfgFault) || d->has(kStatDiag));
    EXPECT_EQ(d->master, 0xFF);
    EXPECT_EQ(d->ident, 0x0533);
}

TEST(Diagnosis, DistinguishesTheFaultsOfStartUp)
{
    EXPECT_EQ(finding(*parse_diagnosis(wire("42 05 00 FF 05 33")), "prm-fault"), true);
    EXPECT_EQ(finding(*parse_diagnosis(wire("06 05 00 FF 05 33")), "cfg-fault"), true);
    EXPECT_EQ(finding(*parse_diagnosis(wire("12 05 00 FF 05 33")), "not-supported"), true);
    EXPECT_EQ(finding(*parse_diagnosis(wire("12 05 00 FF 05 33")), "prm-fault"), false);
    EXPECT_EQ(finding(*parse_diagnosis(wire("12 05 00 FF 05 33")), "no-such-thing"), std::nullopt);
}

TEST(Diagnosis, RefusesWhatASlaveNeverSends)
{
    EXPECT_FALSE(parse_diagnosis(wire("02 05 00 FF 05"))) << "five octets";
    EXPECT_FALSE(parse_diagnosis(wire("02 01 00 FF 05 33"))) << "octet 2 bit 2 is 0";
    EXPECT_FALSE(parse_diagnosis(wire("01 04 00 FF 05 33"))) << "Station_Non_Existent belongs to the master";
    EXPECT_FALSE(parse_diagnosis(wire("00 04 01 FF 05 33"))) << "a reserved bit";
}

TEST(Diagnosis, ExplainsEveryKindOfExtendedBlock)
{
    const auto d = parse_diagnosis(wire("08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7"));
    ASSERT_TRUE(d) << d.error();
    const auto lines = explain(*d);
    EXPECT_THAT(lines, Contains(HasSubstr("device-related diagnosis: E1 00 80")));
    EXPECT_THAT(lines, Contains(HasSubstr("identifiers with diagnosis: 0 12 18")));
    EXPECT_THAT(lines, Contains(HasSubstr("identifier 0, channel 2: error 4")));
    EXPECT_THAT(lines, Contains(HasSubstr("identifier 12, channel 6: error 7")));
}

TEST(Diagnosis, OfATechnologyBoxShowsTripCodeAndExtDiagnostic)
{
    const auto lines = explain(*parse_diagnosis(wire("00 0C 00 01 16 49 04 01 6A B5"))); // HA463561U002
    EXPECT_THAT(lines, Contains("device-related diagnosis: 01 6A B5"));
    EXPECT_THAT(lines, Contains("  of a technology box: trip code 1 (link overvolts), EXT DIAGNOSTIC 6AB5"));
    EXPECT_THAT(explain(*parse_diagnosis(wire("00 0C 00 01 16 49 04 1F 00 00"))),
                Contains(HasSubstr("trip code 31 (tripped)")));
    EXPECT_THAT(explain(*parse_diagnosis(wire("00 0C 00 01 16 49 04 0E 00 00"))),
                Contains(HasSubstr("trip code 14 (in no table)")));
}

TEST(Diagnosis, OfAControllerNamesTheBitsOfItsSummaryOutputStatus)
{
    const auto lines = explain(*parse_diagnosis(wire("00 0C 00 24 24 08 03 40 30"))); // handbook chapter 4
    EXPECT_THAT(lines, Contains("device-related diagnosis: 40 30"));
    EXPECT_THAT(lines, Contains("  of a 2408f/2404f: summary output status 4030, manual mode, sensor break, "
                                "IP1 fault"));
    EXPECT_THAT(explain(*parse_diagnosis(wire("00 0C 00 24 24 08 03 00 00"))),
                Contains(HasSubstr("status 0000, no bit")));
    EXPECT_THAT(explain(*parse_diagnosis(wire("00 0C 00 24 24 08 03 1F 01"))),
                Contains(HasSubstr("1F01, alarm 1, tune active, program complete, PV out of range, DC module "
                                   "fault, segment sync")));
}

TEST(Diagnosis, SaysWhereABlockIsLongerThanTheReply)
{
    EXPECT_THAT(explain(*parse_diagnosis(wire("08 0C 00 02 47 11 04 E1"))),
                Contains(HasSubstr("4 octets, but 2 are left")));
}

} // namespace
} // namespace dpslave::sim
