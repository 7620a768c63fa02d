// SPDX-License-Identifier: Apache-2.0
/// Every telegram printed in the wire reference, with what it says. Written by hand from the reference: no
/// encoder.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <ostream>

namespace test {

struct Golden {
    const char* name;
    const char* octets;
    std::uint8_t da;
    std::uint8_t sa;
    std::uint8_t fc;
    std::optional<std::uint8_t> dsap;
    std::optional<std::uint8_t> ssap;
    const char* data;

    friend void PrintTo(const Golden& row, std::ostream* out) { *out << row.name; }
};

// clang-format off
inline constexpr auto none = std::nullopt;
inline constexpr auto kGolden = std::to_array<Golden>({
    {"FdlStatusRequest", "10 05 02 49 50 16",
     5, 2, 0x49, none, none, ""},
    {"FdlStatusReply", "10 02 05 00 07 16",
     2, 5, 0x00, none, none, ""},
    {"SlaveDiagFirstRequest", "68 05 05 68 85 82 6D 3C 3E EE 16",
     5, 2, 0x6D, 60, 62, ""},
    {"EightOutputsAsSd2", "68 0B 0B 68 05 02 7D 01 02 03 04 05 06 07 08 A8 16",
     5, 2, 0x7D, none, none, "01 02 03 04 05 06 07 08"},
    {"EightOutputsAsSd3", "A2 05 02 7D 01 02 03 04 05 06 07 08 A8 16",
     5, 2, 0x7D, none, none, "01 02 03 04 05 06 07 08"},
    {"ChkCfgOfSixAsSd3", "A2 85 82 5D 3E 3E 10 10 11 20 20 21 72 16",
     5, 2, 0x5D, 62, 62, "10 10 11 20 20 21"},
    {"UserError", "10 02 05 01 08 16",
     2, 5, 0x01, none, none, ""},
    {"NoResource", "10 02 05 02 09 16",
     2, 5, 0x02, none, none, ""},
    {"NotActivated", "10 02 05 03 0A 16",
     2, 5, 0x03, none, none, ""},
    {"NoResponseData", "10 02 05 09 10 16",
     2, 5, 0x09, none, none, ""},
    {"HighWithoutData", "10 02 05 0A 11 16",
     2, 5, 0x0A, none, none, ""},
    {"Outputs1234", "68 05 05 68 05 02 7D 12 34 CA 16",
     5, 2, 0x7D, none, none, "12 34"},
    {"InputsAA55", "68 05 05 68 02 05 08 AA 55 0E 16",
     2, 5, 0x08, none, none, "AA 55"},
    {"Outputs1235", "68 05 05 68 05 02 5D 12 35 AB 16",
     5, 2, 0x5D, none, none, "12 35"},
    {"InputsAA56", "68 05 05 68 02 05 08 AA 56 0F 16",
     2, 5, 0x08, none, none, "AA 56"},
    {"DiagNotReady", "68 0B 0B 68 82 85 08 3E 3C 02 05 00 FF 47 11 E7 16",
     2, 5, 0x08, 62, 60, "02 05 00 FF 47 11"},
    {"SetPrm", "68 0C 0C 68 85 82 5D 3D 3E 88 14 01 0B 47 11 01 E0 16",
     5, 2, 0x5D, 61, 62, "88 14 01 0B 47 11 01"},
    {"ChkCfg", "68 07 07 68 85 82 7D 3E 3E 11 21 32 16",
     5, 2, 0x7D, 62, 62, "11 21"},
    {"SlaveDiagFcb0", "68 05 05 68 85 82 5D 3C 3E DE 16",
     5, 2, 0x5D, 60, 62, ""},
    {"DiagStatic", "68 0B 0B 68 82 85 08 3E 3C 00 0E 00 02 47 11 F1 16",
     2, 5, 0x08, 62, 60, "00 0E 00 02 47 11"},
    {"SlaveDiagFcb1", "68 05 05 68 85 82 7D 3C 3E FE 16",
     5, 2, 0x7D, 60, 62, ""},
    {"DiagReady", "68 0B 0B 68 82 85 08 3E 3C 00 0C 00 02 47 11 EF 16",
     2, 5, 0x08, 62, 60, "00 0C 00 02 47 11"},
    {"DataExchangeZeros", "68 05 05 68 05 02 5D 00 00 64 16",
     5, 2, 0x5D, none, none, "00 00"},
    {"InputsLow", "68 05 05 68 02 05 08 12 34 55 16",
     2, 5, 0x08, none, none, "12 34"},
    {"GlobalControlOperate", "68 07 07 68 FF 82 46 3A 3E 00 00 3F 16",
     127, 2, 0x46, 58, 62, "00 00"},
    {"DataExchangeA501", "68 05 05 68 05 02 7D A5 01 2A 16",
     5, 2, 0x7D, none, none, "A5 01"},
    {"InputsHigh", "68 05 05 68 02 05 0A 12 34 57 16",
     2, 5, 0x0A, none, none, "12 34"},
    {"DiagExtended", "68 0D 0D 68 82 85 08 3E 3C 08 0C 00 02 47 11 02 01 FA 16",
     2, 5, 0x08, 62, 60, "08 0C 00 02 47 11 02 01"},
    {"CapturedGlobalControl", "68 07 07 68 FF 81 46 3A 3E 00 00 3E 16",
     127, 1, 0x46, 58, 62, "00 00"},
    {"CapturedSlaveDiag", "68 05 05 68 88 81 6D 3C 3E F0 16",
     8, 1, 0x6D, 60, 62, ""},
    {"CapturedDiagnosis", "68 0B 0B 68 81 88 08 3E 3C 02 05 00 FF 80 E0 F1 16",
     1, 8, 0x08, 62, 60, "02 05 00 FF 80 E0"},
    {"CapturedGetCfg", "68 05 05 68 88 81 5D 3B 3E DF 16",
     8, 1, 0x5D, 59, 62, ""},
    {"CapturedConfiguration", "68 08 08 68 81 88 08 3E 3B 00 10 10 AA 16",
     1, 8, 0x08, 62, 59, "00 10 10"},
    {"CapturedChkCfg", "68 08 08 68 88 81 5D 3E 3E 00 10 10 02 16",
     8, 1, 0x5D, 62, 62, "00 10 10"},
    {"GetCfg", "68 05 05 68 85 82 5D 3B 3E DD 16",
     5, 2, 0x5D, 59, 62, ""},
    {"Configuration", "68 07 07 68 82 85 08 3E 3B 11 21 BA 16",
     2, 5, 0x08, 62, 59, "11 21"},
    {"DataExchangeWithoutOutputs", "10 05 02 7D 84 16",
     5, 2, 0x7D, none, none, ""},
    {"DataExchangeWithoutInputs", "68 05 05 68 05 02 5D 01 02 67 16",
     5, 2, 0x5D, none, none, "01 02"},
    {"FailSafeClear", "10 05 02 5D 64 16",
     5, 2, 0x5D, none, none, ""},
    {"DataExchangeZerosFcb1", "68 05 05 68 05 02 7D 00 00 84 16",
     5, 2, 0x7D, none, none, "00 00"},
    {"RdInp", "68 05 05 68 85 89 6D 38 3E F1 16",
     5, 9, 0x6D, 56, 62, ""},
    {"RdInpResponse", "68 07 07 68 89 85 08 3E 38 12 34 D2 16",
     9, 5, 0x08, 62, 56, "12 34"},
    {"RdOutp", "68 05 05 68 85 89 5D 39 3E E2 16",
     5, 9, 0x5D, 57, 62, ""},
    {"RdOutpResponse", "68 07 07 68 89 85 08 3E 39 A5 01 33 16",
     9, 5, 0x08, 62, 57, "A5 01"},
    {"SetSlaveAdd", "68 09 09 68 FE 82 6D 37 3E 05 47 11 00 BF 16",
     126, 2, 0x6D, 55, 62, "05 47 11 00"},
    {"ClearAll", "68 07 07 68 FF 82 46 3A 3E 02 00 41 16",
     127, 2, 0x46, 58, 62, "02 00"},
    {"SyncGroup1", "68 07 07 68 FF 82 46 3A 3E 20 01 60 16",
     127, 2, 0x46, 58, 62, "20 01"},
    {"UnsyncGroup1", "68 07 07 68 FF 82 46 3A 3E 10 01 50 16",
     127, 2, 0x46, 58, 62, "10 01"},
    {"FreezeAll", "68 07 07 68 FF 82 46 3A 3E 08 00 47 16",
     127, 2, 0x46, 58, 62, "08 00"},
    {"UnfreezeAll", "68 07 07 68 FF 82 46 3A 3E 04 00 43 16",
     127, 2, 0x46, 58, 62, "04 00"},
    {"OperateAsSdnLow", "68 07 07 68 FF 82 44 3A 3E 00 00 3D 16",
     127, 2, 0x44, 58, 62, "00 00"},
    {"DiagOfAllBlocks", "68 1A 1A 68 82 85 08 3E 3C 08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7 95 16",
     2, 5, 0x08, 62, 60, "08 0C 00 02 47 11 04 E1 00 80 45 01 10 04 00 80 02 24 8C 06 A7"},
    {"CapturedDiagnosisInExchange", "68 28 28 68 81 88 08 3E 3C 00 0C 00 01 80 E0 49 00 00 00 00 00 00 00 00 14 82 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 D7 16",
     1, 8, 0x08, 62, 60, "00 0C 00 01 80 E0 49 00 00 00 00 00 00 00 00 14 82 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"},
    {"Ms1Read", "68 09 09 68 85 82 5C 33 33 5E 01 02 0A 34 16",
     5, 2, 0x5C, 51, 51, "5E 01 02 0A"},
    {"Ms1Poll", "68 05 05 68 85 82 7C 33 33 E9 16",
     5, 2, 0x7C, 51, 51, ""},
    {"Ms1PollAgain", "68 05 05 68 85 82 5C 33 33 C9 16",
     5, 2, 0x5C, 51, 51, ""},
    {"Ms1ReadResponse", "68 0D 0D 68 82 85 08 33 33 5E 01 02 04 DE AD BE EF 12 16",
     2, 5, 0x08, 51, 51, "5E 01 02 04 DE AD BE EF"},
    {"Ms1ReadRefused", "68 09 09 68 82 85 08 33 33 DE 80 B2 00 85 16",
     2, 5, 0x08, 51, 51, "DE 80 B2 00"},
    {"Ms1WriteResponse", "68 09 09 68 82 85 08 33 33 5F 01 03 02 DA 16",
     2, 5, 0x08, 51, 51, "5F 01 03 02"},
});
// clang-format on

} // namespace test
