// SPDX-License-Identifier: Apache-2.0
/// Broken telegrams: what is wrong is said, counted, and answered by silence (wire reference 2.7).
#include "bench.hpp"

#include "dpslave/fdl/telegram.hpp"

#include <set>

using namespace dpslave;
using namespace test;
using fdl::Flaw;

namespace {

struct Broken {
    const char* name;
    const char* octets;
    Flaw flaw;

    friend void PrintTo(const Broken& row, std::ostream* out) { *out << row.name; }
};

// clang-format off
constexpr auto kBroken = std::to_array<Broken>({
    {"NoStartDelimiter",            "16",                                        Flaw::start_delimiter},
    {"LeRepeatedWrongly",           "68 05 06 68 85 82 6D 3C 3E EE 16",          Flaw::length_mismatch},
    {"SecondStartDelimiterWrong",   "68 05 05 69 85 82 6D 3C 3E EE 16",          Flaw::length_mismatch},
    {"LengthZero",                  "68 00 00 68 00 16",                         Flaw::length_range},
    {"LengthThree",                 "68 03 03 68 05 02 7D 84 16",                Flaw::length_range},
    {"Length250",                   "68 FA FA 68 05 02 7D",                      Flaw::length_range},
    {"Sd1ChecksumTooLarge",         "10 05 02 49 51 16",                         Flaw::checksum},
    {"Sd2ChecksumTooSmall",         "68 05 05 68 85 82 6D 3C 3E ED 16",          Flaw::checksum},
    {"Sd3ChecksumWrong",            "A2 05 02 7D 01 02 03 04 05 06 07 08 A9 16", Flaw::checksum},
    {"Sd1EndDelimiterWrong",        "10 05 02 49 50 10",                         Flaw::end_delimiter},
    {"Sd2EndDelimiterWrong",        "68 05 05 68 85 82 6D 3C 3E EE 17",          Flaw::end_delimiter},
    {"Sd3EndDelimiterWrong",        "A2 05 02 7D 01 02 03 04 05 06 07 08 A8 00", Flaw::end_delimiter},
    {"DsapInAnSd1",                 "10 85 02 49 D0 16",                         Flaw::missing_sap},
    {"SsapInAnSd1",                 "10 05 82 49 D0 16",                         Flaw::missing_sap},
    {"DsapWithoutItsSsap",          "68 04 04 68 85 82 6D 3C B0 16",             Flaw::missing_sap},
    {"DsapIsARegion",               "68 05 05 68 85 82 6D 7C 3E 2E 16",          Flaw::extension},
    {"DsapIs64",                    "68 05 05 68 85 82 6D 40 3E F2 16",          Flaw::extension},
    {"SsapIs64",                    "68 05 05 68 85 82 6D 3C 40 F0 16",          Flaw::extension},
    {"SsapIsExtendedOnceMore",      "68 05 05 68 85 82 6D 3C BE 6E 16",          Flaw::extension},
    {"SenderIsTheBroadcastAddress", "10 05 7F 49 CD 16",                         Flaw::source_address},
    {"SenderIsTheBroadcastAddressWithSap", "68 05 05 68 85 FF 6D 3C 3E 6B 16",   Flaw::source_address},
});
// clang-format on

class BrokenTelegram : public FdlStation, public testing::WithParamInterface<Broken> {};

TEST_P(BrokenTelegram, IsNamedByItsFlaw)
{
    const Octets frame = octets(GetParam().octets);

    const auto length = fdl::frame_length(frame);
    if (!length) {
        EXPECT_EQ(length.error(), GetParam().flaw);
        return;
    }
    ASSERT_EQ(*length, frame.size());
    const auto telegram = fdl::decode(frame);
    ASSERT_FALSE(telegram);
    EXPECT_EQ(telegram.error(), GetParam().flaw);
}

TEST_P(BrokenTelegram, IsMetWithSilenceAndCounted)
{
    bus.master_sends(octets(GetParam().octets));

    EXPECT_FALSE(bus.reply());
    EXPECT_TRUE(user.srds.empty());
    EXPECT_TRUE(user.heards.empty());
    EXPECT_GE(station.counters().flaws[static_cast<std::size_t>(GetParam().flaw)], 1u);
    EXPECT_EQ(station.counters().requests, 0u);
}

TEST_P(BrokenTelegram, DoesNotSpoilTheNextRequest)
{
    bus.master_sends(octets(GetParam().octets));
    bus.line_is_idle_for(bus.bits(33) + std::chrono::milliseconds{5});
    bus.master_sends(octets("10 05 02 49 50 16"));

    EXPECT_EQ(bus.reply(), octets("10 02 05 00 07 16"));
}

INSTANTIATE_TEST_SUITE_P(WireReference, BrokenTelegram, testing::ValuesIn(kBroken), kNameOf);

TEST(Flaws, HaveDistinctNames)
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < fdl::kFlaws; ++i) names.insert(fdl::text(static_cast<Flaw>(i)));

    EXPECT_EQ(names.size(), fdl::kFlaws);
    EXPECT_EQ(names.count("?"), 0u);
}

} // namespace
