// SPDX-License-Identifier: Apache-2.0
// Telegrams and their services in words. They are those of the manuals and of the wire reference, by hand.
#include "control/lines.hpp"
#include "decode_bench.hpp"

#include <gmock/gmock.h>

namespace dpslave::dpctl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// ---------------------------------------------------------------- telegrams

TEST(DecodeTelegram, StartUpOfTheReferenceIsNamedTelegramByTelegram)
{
    const auto parts = decoded("10 05 02 49 50 16"
                               " 10 02 05 00 07 16"
                               " 68 05 05 68 85 82 6D 3C 3E EE 16"
                               " 68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16"
                               " 68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16"
                               " E5"
                               " 68 07 07 68 85 82 7D 3E 3E 11 21 32 16"
                               " 68 05 05 68 05 02 5D 00 00 64 16"
                               " 68 05 05 68 02 05 0A 12 34 57 16"
                               " 68 07 07 68 FF 82 46 3A 3E 00 00 3F 16"
                               " 10 02 05 03 0A 16"
                               " DC 04 02");

    std::vector<std::string> kinds;
    for (const Decoded& part : parts) {
        kinds.push_back(part.kind);
        EXPECT_THAT(part.faults, IsEmpty()) << part.kind;
    }
    EXPECT_THAT(kinds,
                ElementsAre("SD1: request, FDL status", "SD1: acknowledgement without data",
                            "SD2: Slave_Diag", "SD2: Slave_Diag, reply", "SD2: Set_Prm",
                            "SC: short acknowledge: accepted, nothing to return", "SD2: Chk_Cfg",
                            "SD2: Data_Exchange", "SD2: Data_Exchange, reply", "SD2: Global_Control",
                            "SD1: acknowledgement without data", "SD4: token from master 2 to master 4"));
}

TEST(DecodeTelegram, ShowsAddressesFunctionAndSaps)
{
    EXPECT_EQ(picture("68 05 05 68 85 82 6D 3C 3E EE 16"), test::lines(R"(
SD2: Slave_Diag
  octets      68 05 05 68 85 82 6D 3C 3E EE 16
  from, to    2 to 5
  FC          6D: request, SRD high: send and request data; FCB 1, FCV 0
  DSAP, SSAP  60 Slave_Diag, 62 of the master
)"));
    EXPECT_EQ(picture("10 02 05 03 0A 16"), test::lines(R"(
SD1: acknowledgement without data
  octets    10 02 05 03 0A 16
  from, to  5 to 2
  FC        03: reply of a slave, RS: service or SAP not activated
)"));
    EXPECT_THAT(picture("68 05 05 68 02 05 0A 12 34 57 16"),
                HasSubstr("  FC        0A: reply of a slave, DH: data, high priority (in Data_Exchange: a\n  "
                          "          diagnosis "
                          "waits)\n  inputs    12 34 (2 octets)\n"));
}

TEST(DecodeTelegram, ReadsSd3AsItReadsSd2)
{
    EXPECT_THAT(picture("A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16"),
                HasSubstr("SD3: Data_Exchange\n  octets    A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16\n"
                          "  from, to  2 to 5\n"));
    EXPECT_THAT(picture("68 0B 0B 68 05 02 7D 01 02 03 04 05 06 07 08 A8 16"),
                HasSubstr("  outputs   01 02 03 04 05 06 07 08 (8 octets)\n"));
}

TEST(DecodeTelegram, DecodesADamagedOneAsFarAsItGoes)
{
    EXPECT_EQ(picture("68 05 05 68 05 02 5D 00 00 65 16"), test::lines(R"(
SD2: Data_Exchange
  octets    68 05 05 68 05 02 5D 00 00 65 16
  from, to  2 to 5
  FC        5D: request, SRD high: send and request data; FCB 0, FCV 1
  outputs   00 00 (2 octets)
  wrong: FCS is 0x65 and should be 0x64
)"));
}

TEST(DecodeTelegram, AnSd1ThatLooksLikeADiagnosisIsATelegramWhenItIsSound)
{
    EXPECT_EQ(decoded("10 04 00 49 4D 16")[0].kind, "SD1: request, FDL status");
    EXPECT_EQ(decoded("10 05 00 FF 05 33")[0].kind, "Slave_Diag");
}

TEST(DecodeSetPrm, IsReadOctetByOctet)
{
    EXPECT_EQ(picture("68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16"), test::lines(R"(
SD2: Set_Prm
  octets      68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16
  from, to    2 to 5
  FC          5D: request, SRD high: send and request data; FCB 0, FCV 1
  DSAP, SSAP  61 Set_Prm, 62 of the master
  lock        Lock: the slave belongs to this master
  watchdog    200 ms
  OCTET  OFFSET  VALUE  MEANING
      1       0  0x88   Station_status: Lock_Req, WD_On
      2       1  0x14   WD_Fact_1: 20
      3       2  0x01   WD_Fact_2: 1
      4       3  0x0B   min T_SDR: 11 T_bit
      5       4  0x47   Ident_Number, high octet
      6       5  0x11   Ident_Number, low octet: 0x4711
      7       6  0x01   Group_Ident: groups 1
)"));
}

/// User_Prm_Data 00 00 00 01 0F 01 0D of HA463561U002 (its first two tags), ident 0x1649, master 1,
/// station 5.
constexpr const char* kBoxPrm = "68 13 13 68 85 81 5D 3D 3E 88 0A 0A 0B 16 49 00 00 00 00 01 0F 01 0D 02 16";

TEST(DecodeSetPrm, NamesTheTagsOfADevice)
{
    const profile::Profile box = technology_box();

    const auto parts = decoded(kBoxPrm, &box);

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_THAT(parts[0].faults, IsEmpty());
    EXPECT_EQ(meaning(parts[0], 8), "DPV1_Status_1: no bit set");
    EXPECT_EQ(meaning(parts[0], 11), "tag of parameter 1, high octet");
    EXPECT_EQ(meaning(parts[0], 12), "tag of parameter 1, low octet: 271 COMMS COMMAND");
    EXPECT_EQ(meaning(parts[0], 14), "tag of parameter 2, low octet: 269");
}

TEST(DecodeSetPrm, SaysWhatTheDeviceWouldRefuse)
{
    profile::Profile box = technology_box();
    box.ident = box.personality.ident = 0x0533;

    const auto parts = decoded(kBoxPrm, &box);

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_THAT(
        parts[0].faults,
        ElementsAre("profile box would refuse it: the Ident_Number is that of another device, "
                    "octet 5, expected Ident_Number 0x0533, got 0x1649; use the GSD of this device in the "
                    "master's project, or check that the master expects this device at this address"));
    box.ident.reset(); // the site's own: nothing to compare with
    EXPECT_THAT(decoded(kBoxPrm, &box)[0].faults, IsEmpty());
}

TEST(DecodeChkCfg, NamesIdentifiersAndLengths)
{
    const profile::Profile box = technology_box();

    EXPECT_EQ(picture("68 08 08 68 85 82 7D 3E 3E 73 50 70 33 16", &box), test::lines(R"(
SD2: Chk_Cfg
  octets      68 08 08 68 85 82 7D 3E 3E 73 50 70 33 16
  from, to    2 to 5
  FC          7D: request, SRD high: send and request data; FCB 1, FCV 1
  DSAP, SSAP  62 Chk_Cfg, 62 of the master
  lengths     12 octets in, 10 octets out
  OCTET  OFFSET  VALUE  MEANING
      1       0  0x73   Demand Data: 4 words in and 4 words out
      2       1  0x50   1 word in
      3       2  0x70   1 word in and 1 word out
)"));
}

TEST(DecodeChkCfg, ReadsGeneralAndSpecialFormats)
{
    // Get_Cfg reply with B7, 40 01, 80 C3, C0 00 01, 42 01 AA BB, 00 (wire reference 4.5).
    const auto parts = decoded("68 12 12 68 82 85 08 3E 3B B7 40 01 80 C3 C0 00 01 42 01 AA BB 00 2C 16");

    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].kind, "SD2: Get_Cfg, reply");
    EXPECT_THAT(parts[0].faults, IsEmpty());
    std::vector<std::string> meanings;
    for (const Decoded::Octet& octet : parts[0].octets) meanings.push_back(octet.meaning);
    EXPECT_THAT(meanings, ElementsAre("8 octets in and 8 octets out, consistent as a whole",
                                      "special format: inputs", "length: 2 octets in",
                                      "special format: outputs", "length: 4 words out, consistent as a whole",
                                      "special format: outputs and inputs", "length: 1 octet out",
                                      "length: 2 octets in", "special format: inputs, then 2 vendor octets",
                                      "length: 2 octets in", "vendor octet", "vendor octet",
                                      "special format, empty slot: no inputs or outputs"));
    EXPECT_EQ(parts[0].lines.back().value, "14 octets in, 17 octets out");
}

TEST(DecodeChkCfg, SaysWhatTheDeviceWouldRefuseAfterTheSetPrmBefore)
{
    const profile::Profile box = technology_box();

    const auto alone = decoded("68 06 06 68 85 81 7D 3E 3E 50 4F 16", &box);
    EXPECT_THAT(alone[0].faults, IsEmpty());
    const auto after = decoded(std::string{kBoxPrm} + " 68 06 06 68 85 81 7D 3E 3E 50 4F 16", &box);
    ASSERT_EQ(after.size(), 2u);
    EXPECT_THAT(after[1].faults, ElementsAre("profile box would refuse it: Cfg_Data has fewer identifiers "
                                             "than User_Prm_Data has tags, expected 2 "
                                             "identifiers for as many tags, got 1; add a module for each "
                                             "tag, or leave tags out"));
    const auto unknown = decoded("68 06 06 68 85 81 7D 3E 3E 51 50 16", &box);
    EXPECT_THAT(unknown[0].faults, ElementsAre(HasSubstr("an identifier is not legal here, octet 1")));
}

TEST(DecodeChkCfg, SaysThatOctetsOfAnIdentifierAreMissing)
{
    EXPECT_THAT(decoded("68 06 06 68 85 81 7D 3E 3E C0 BF 16")[0].faults,
                ElementsAre("an identifier announces octets that are not there"));
}

TEST(DecodeGlobalControl, NamesCommandsAndGroups)
{
    const auto sync = decoded("68 07 07 68 FF 82 46 3A 3E 20 01 60 16");
    EXPECT_EQ(meaning(sync[0], 1), "Control_Command: Sync");
    EXPECT_EQ(meaning(sync[0], 2), "Group_Select: groups 1");
    EXPECT_EQ(sync[0].lines[0].value, "2 to 127: all stations");
    EXPECT_EQ(meaning(decoded("68 07 07 68 FF 82 46 3A 3E 02 00 41 16")[0], 1),
              "Control_Command: Clear_Data");
    const auto operate = decoded("68 07 07 68 FF 82 44 3A 3E 00 00 3D 16");
    EXPECT_EQ(meaning(operate[0], 1), "Control_Command: Operate (no bit set)");
    EXPECT_EQ(meaning(operate[0], 2), "Group_Select: all slaves");
    EXPECT_THAT(operate[0].faults, IsEmpty());
}

TEST(DecodeSetSlaveAdd, NamesTheNewAddress)
{
    const auto parts = decoded("68 09 09 68 FE 82 6D 37 3E 05 47 11 00 BF 16");

    EXPECT_EQ(parts[0].kind, "SD2: Set_Slave_Add");
    EXPECT_EQ(meaning(parts[0], 1), "new address 5");
    EXPECT_EQ(meaning(parts[0], 3), "Ident_Number, low octet: 0x4711");
    EXPECT_EQ(meaning(parts[0], 4), "the address may be changed again");
    EXPECT_EQ(parts[0].lines[0].value, "2 to 126: a station without an address of its own");
}

TEST(Decode, ReplyOfThreeBlocksAndThatOfAnEt200sAreSound)
{
    const auto blocks =
        decoded("68 1A 1A 68 82 85 08 3E 3C 08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C "
                "06 A7 95 16");
    EXPECT_THAT(blocks[0].faults, IsEmpty());
    EXPECT_EQ(meaning(blocks[0], 21), "word, upper limit exceeded");
    const auto et200s =
        decoded("68 28 28 68 81 88 08 3E 3C 00 0C 00 01 80 E0 49 00 00 00 00 00 00 00 00 14 82 00 00 00 00 "
                "00 00 00 00 00 00 00 00 00 00 00 00 00 00 D7 16");
    EXPECT_THAT(et200s[0].faults, IsEmpty());
    EXPECT_EQ(meaning(et200s[0], 7), "identifier-related block of 9 octets");
    EXPECT_EQ(meaning(et200s[0], 16), "device-related block of 20 octets");
}

TEST(Decode, GivesTheSameAsJson)
{
    EXPECT_EQ(decoded_json(decoded("68 07 07 68 FF 82 46 3A 3E 02 00 40 16")), Json::parse(R"({"parts":[{
        "kind":"SD2: Global_Control","hex":"68 07 07 68 FF 82 46 3A 3E 02 00 40 16",
        "lines":[{"name":"from, to","value":"2 to 127: all stations"},
                 {"name":"FC","value":"46: request, SDN high: send data, no acknowledge; FCB 0, FCV 0"},
                 {"name":"DSAP, SSAP","value":"58 Global_Control, 62 of the master"}],
        "octets":[{"octet":1,"offset":0,"value":2,"meaning":"Control_Command: Clear_Data"},
                  {"octet":2,"offset":1,"value":0,"meaning":"Group_Select: all slaves"}],
        "faults":["FCS is 0x40 and should be 0x41"]}]})"));
}

/// No sequence of octets may bring it down.
TEST(Decode, SurvivesAnyOctets)
{
    const profile::Profile box = technology_box();
    std::uint32_t state = 1;
    const auto next = [&state] {
        return static_cast<std::uint8_t>((state = state * 1664525U + 1013904223U) >> 24);
    };
    constexpr std::uint8_t kDelimiters[] = {0x10, 0x68, 0xA2, 0xDC, 0xE5, 0x00};
    for (int round = 0; round < 5000; ++round) {
        std::vector<std::uint8_t> octets(1 + next() % 40);
        for (std::uint8_t& octet : octets) octet = next();
        octets[0] = kDelimiters[next() % 6];
        if (octets[0] == 0x68 &&
            octets.size() >= 11) { // mostly with a length that fits, so that services are reached
            octets[1] = octets[2] = static_cast<std::uint8_t>(octets.size() - 6);
            octets[3] = 0x68;
            octets[4] |= 0x80;
            octets[5] |= 0x80;
            octets[7] = static_cast<std::uint8_t>(55 + next() % 8);
            octets[8] = static_cast<std::uint8_t>(55 + next() % 8);
        }
        EXPECT_FALSE(
            render_decoded(decode_all(octets, {.device = round % 2 == 0 ? &box : nullptr, .tags = {}}), false)
                .empty());
    }
}

} // namespace
} // namespace dpslave::dpctl
