// SPDX-License-Identifier: Apache-2.0
// Octets, diagnoses and what is wrong with them. They are those of the manuals and of the wire reference, by
// hand.
#include "control/lines.hpp"
#include "decode_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---------------------------------------------------------------- octets as they are typed

TEST(DecodeOctets, AreReadInEveryUsualForm)
{
    const std::vector<std::uint8_t> octets = {0x10, 0x05, 0xAB};
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"10", "05", "AB"},
                                                                                       {"1005ab"},
                                                                                       {"10 05 AB"},
                                                                                       {"0x10,0x05,0xAB"},
                                                                                       {"10-05-AB"},
                                                                                       {"10:5:ab"},
                                                                                       {"16#10", "05AB"}}) {
        const auto read = read_octets(words);
        ASSERT_TRUE(read) << words[0];
        EXPECT_EQ(*read, octets) << words[0];
    }
}

TEST(DecodeOctets, SayWhatIsNone)
{
    EXPECT_EQ(read_octets({"10", "0G"}).error(), "'0G' is not hexadecimal");
    EXPECT_EQ(read_octets({"123"}).error(), "'123' has an odd number of digits: two are an octet");
    EXPECT_EQ(read_octets({" , "}).error(), "there is no octet");
}

// ---------------------------------------------------------------- diagnosis

TEST(DecodeDiagnosis, OfTheTechnologyBoxExampleIsALinkOvervoltsTripAndItsEvent)
{
    const profile::Profile box = technology_box();

    EXPECT_EQ(picture("00 0C 00 01 16 49 04 01 6A B5", &box), test::lines(R"(
Slave_Diag
  octets         00 0C 00 01 16 49 04 01 6A B5
  says           WD_On: watchdog on
  extended part  a status message (Ext_Diag is 0)
  OCTET  OFFSET  VALUE  MEANING
      1       0  0x00   Station_status_1: no bit set
      2       1  0x0C   Station_status_2: WD_On
      3       2  0x00   Station_status_3: no bit set
      4       3  0x01   Master_Add: owned by master 1
      5       4  0x16   Ident_Number, high octet
      6       5  0x49   Ident_Number, low octet: 0x1649
      7       6  0x04   device-related block of 4 octets
      8       7  0x01   trip code 1: LINK OVERVOLTS
      9       8  0x6A   EXT DIAGNOSTIC, high octet
     10       9  0xB5   EXT DIAGNOSTIC, low octet: >6AB5
)"));
}

TEST(DecodeDiagnosis, OfATechnologyBoxTakesTheTripFromBits0To4Only)
{
    const profile::Profile box = technology_box();

    EXPECT_EQ(meaning(decoded("00 0C 00 01 16 49 04 21 00 00", &box)[0], 8), "trip code 1: LINK OVERVOLTS");
    EXPECT_EQ(meaning(decoded("00 0C 00 01 16 49 04 1F 00 00", &box)[0], 8), "trip code 31: TRIPPED");
}

TEST(DecodeDiagnosis, WithoutADeviceItsBlockIsOnlyOctets)
{
    const auto parts = decoded("00 0C 00 01 16 49 04 01 6A B5");

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(meaning(parts[0], 8), "device-related, octet 1");
    EXPECT_THAT(parts[0].faults, IsEmpty());
}

TEST(DecodeDiagnosis, OfTheControllerExampleIsManualSensorBreakAndIp1Fault)
{
    const profile::Profile instrument = controller();

    const auto parts = decoded("00 0C 00 24 AB CD 03 40 30", &instrument);

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(meaning(parts[0], 4), "Master_Add: owned by master 36");
    EXPECT_EQ(meaning(parts[0], 8), "status word, high octet");
    EXPECT_THAT(meaning(parts[0], 9), HasSubstr("Manual, Sensor break, IP1 fault"));
    EXPECT_THAT(parts[0].faults, IsEmpty());
}

TEST(DecodeDiagnosis, MayBeTheExtendedPartAlone)
{
    const profile::Profile instrument = controller();
    const auto word = decoded("03 40 30", &instrument);
    ASSERT_EQ(word.size(), 1u);
    EXPECT_EQ(word[0].kind, "extended diagnosis");
    EXPECT_THAT(meaning(word[0], 3), HasSubstr("Manual, Sensor break, IP1 fault"));

    EXPECT_EQ(picture("04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7"), test::lines(R"(
extended diagnosis
  octets  04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7
  OCTET  OFFSET  VALUE  MEANING
      1       0  0x04   device-related block of 4 octets
      2       1  0xE1   device-related, octet 1
      3       2  0x00   device-related, octet 2
      4       3  0x80   device-related, octet 3
      5       4  0x45   identifier-related block of 5 octets
      6       5  0x01   identifiers with diagnosis: 0
      7       6  0x10   identifiers with diagnosis: 12
      8       7  0x04   identifiers with diagnosis: 18
      9       8  0x00   identifiers with diagnosis: none
     10       9  0x80   channel-related block: identifier 0
     11      10  0x02   channel 2
     12      11  0x24   bit, overload
     13      12  0x8C   channel-related block: identifier 12
     14      13  0x06   channel 6
     15      14  0xA7   word, upper limit exceeded
)"));
}

TEST(DecodeDiagnosis, NamesEveryBitOfTheStationStatus)
{
    const auto parts = decoded("FF BF 80 FF 05 33");

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(meaning(parts[0], 1),
              "Station_status_1: Station_Non_Existent, Station_Not_Ready, Cfg_Fault, Ext_Diag, "
              "Not_Supported, Invalid_Slave_Response, Prm_Fault, Master_Lock");
    EXPECT_EQ(meaning(parts[0], 2),
              "Station_status_2: Prm_Req, Stat_Diag, WD_On, Freeze_Mode, Sync_Mode, Deactivated");
    EXPECT_EQ(meaning(parts[0], 3), "Station_status_3: Ext_Diag_Overflow");
    EXPECT_EQ(meaning(parts[0], 4), "Master_Add: none, not parameterised");
    EXPECT_EQ(meaning(parts[0], 6), "Ident_Number, low octet: 0x0533");
}

TEST(DecodeAs, TakesTheOctetsThatDiagPrintsWithoutATelegram)
{
    const std::vector<std::uint8_t> prm{0x88, 0x01, 0x0A, 0x0B, 0x05, 0x33, 0x00}, cfg{0x73, 0x50},
        diag{0x00, 0x0C, 0x00, 0x01, 0x05, 0x33};
    EXPECT_EQ(decode_as(Form::set_prm, prm, {}).kind, "Set_Prm");
    EXPECT_GE(decode_as(Form::set_prm, prm, {}).octets.size(), 7U);
    EXPECT_THAT(decode_as(Form::set_prm, prm, {}).faults, testing::IsEmpty());
    EXPECT_EQ(decode_as(Form::chk_cfg, cfg, {}).octets.size(), 2U);
    EXPECT_EQ(decode_as(Form::slave_diag, diag, {}).kind, "Slave_Diag");
    EXPECT_EQ(form_called("prm"), Form::set_prm);
    EXPECT_EQ(form_called("telegram"), std::nullopt);
}

struct Flawed {
    const char* name;
    const char* octets;
    const char* fault;
};
class DecodeFault : public testing::TestWithParam<Flawed> {};

TEST_P(DecodeFault, IsSaidInASentence)
{
    const profile::Profile box = technology_box();
    const auto parts = decoded(GetParam().octets, &box);

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_THAT(parts[0].faults, ElementsAre(GetParam().fault));
}

INSTANTIATE_TEST_SUITE_P(
    Diagnosis, DecodeFault,
    testing::Values(
        Flawed{"TooShort", "00 0C 00 01", "a diagnosis has at least 6 octets, here are 4"},
        Flawed{"AlwaysOne", "00 08 00 01 16 49", "bit 2 of octet 2 is 0: a slave always sends 1"},
        Flawed{"Reserved", "00 0C 01 01 16 49", "a reserved bit of octet 2 or 3 is set"},
        Flawed{"OddMaster", "00 0C 00 C8 16 49", "Master_Add is 200: 0 to 126, or 255 for none"},
        Flawed{"BlockTooLong", "00 0C 00 01 16 49 05 01 6A B5",
               "octet 7: the header promises 5 octets, 4 are left"},
        Flawed{"EmptyBlock", "00 0C 00 01 16 49 00 01 6A B5", "octet 7: a block of 0 octets cannot be"},
        Flawed{"ExtDiagWithoutBlock", "08 0C 00 01 16 49", "Ext_Diag is 1, but there is no extended part"},
        Flawed{"OtherDevice", "00 0C 00 01 05 33 04 00 00 00",
               "the Ident_Number of profile box is 0x1649, here is 0x0533"},
        Flawed{"LongerThanTheDevice", "00 0C 00 01 16 49 05 01 6A B5 00",
               "it has 11 octets, profile box has 10 at most"}),
    [](const auto& row) { return row.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Telegram, DecodeFault,
    testing::Values(
        Flawed{"Fcs", "10 05 02 49 51 16", "FCS is 0x51 and should be 0x50"},
        Flawed{"EndDelimiter", "10 05 02 49 50 17",
               "the last octet is 0x17 and should be the end delimiter 0x16"},
        Flawed{"Unfinished", "68 05 05 68 85 82 6D 3C", "it has 8 octets and should have 11"},
        Flawed{"OnlyTheHead", "68 05", "it ends after 2 octets: LE, LEr and 0x68 are missing"},
        Flawed{"LengthsDiffer", "68 05 06 68 85 82 6D 3C 3E EE 16",
               "LE is 0x05, LEr 0x06, the fourth octet 0x68: LE and LEr must be equal and 0x68 must follow"},
        Flawed{"LengthRange", "68 03 03 68 05 02 5D 64 16", "LE is 3: 4 to 249 are legal"},
        Flawed{"MissingSap", "10 85 02 49 D0 16", "an address announces a SAP, but no octet is left for it"},
        Flawed{"WrongMasterSap", "68 05 05 68 85 82 6D 3C 3D ED 16",
               "the master's SAP of this service is 62, here is 61: a DP slave answers RS"},
        Flawed{"ToAllWithAnswer", "10 7F 02 49 CA 16", "127 is only for telegrams without an answer (SDN)"},
        Flawed{"ToItself", "10 05 05 49 53 16", "sender and receiver are both 5: no station talks to itself"},
        Flawed{"ReservedFunction", "10 05 02 41 48 16", "the function code 1 of FC 0x41 is reserved"},
        Flawed{"Bit7OfFc", "10 05 02 C9 D0 16",
               "bit 7 of FC 0xC9 is set: no DP telegram has it, a slave is silent"},
        Flawed{"SetPrmTooShort", "68 08 08 68 85 82 5D 3D 3E 88 14 01 7C 16",
               "Set_Prm has at least 7 octets, here are 3: slaves discard it"},
        Flawed{"GlobalControlTooLong", "68 08 08 68 FF 82 46 3A 3E 00 00 00 3F 16",
               "Global_Control has 2 octets, here are 3: slaves ignore it"},
        Flawed{"RequestWithData", "68 06 06 68 85 82 6D 3C 3E 01 EF 16",
               "a request Slave_Diag has no data, here are 1 octets"}),
    [](const auto& row) { return row.param.name; });

} // namespace
} // namespace dpslave::dpctl
