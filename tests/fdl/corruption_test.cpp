// SPDX-License-Identifier: Apache-2.0
/// C-03: each octet of each printed request corrupted by one bit, dropped, doubled: silence, no change of
/// state, and the next good request is answered.
#include "bench.hpp"
#include "golden.hpp"

using namespace dpslave;
using namespace test;

namespace {

/// Every printed request to slave 5 that asks for an answer.
std::vector<Golden> requests_to_us()
{
    std::vector<Golden> out;
    for (const Golden& golden : kGolden)
        if ((golden.fc & 0x40) != 0 && golden.da == kUs) out.push_back(golden);
    return out;
}

class Corrupted : public FdlStation, public testing::WithParamInterface<Golden> {
protected:
    /// The station must not answer, must not call its user, and must be itself again afterwards.
    void expect_silence(const Octets& wrong)
    {
        bus.master_sends(wrong);
        EXPECT_FALSE(bus.reply()) << show(wrong);
        EXPECT_TRUE(user.srds.empty() && user.sdns.empty() && user.heards.empty()) << show(wrong);
        bus.line_is_idle_for(bus.bits(33) + std::chrono::milliseconds{5});
    }
    void expect_normal_service()
    {
        bus.master_sends(good);
        EXPECT_TRUE(bus.reply());
        EXPECT_EQ(user.srds.size() + user.heards.size(), 1u);
        user.srds.clear();
        user.heards.clear();
    }

    const Octets good = octets(GetParam().octets);
};

TEST_P(Corrupted, OneWrongBitAnywhereIsMetWithSilence)
{
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            Octets wrong = good;
            wrong[i] = static_cast<std::uint8_t>(wrong[i] ^ (1u << bit));
            expect_silence(wrong);
        }
    }
    expect_normal_service();
}

TEST_P(Corrupted, OneOctetMissingAnywhereIsMetWithSilence)
{
    for (std::size_t i = 0; i < good.size(); ++i) {
        Octets wrong = good;
        wrong.erase(wrong.begin() + static_cast<std::ptrdiff_t>(i));
        expect_silence(wrong);
    }
    expect_normal_service();
}

TEST_P(Corrupted, OneOctetDoubledAnywhereIsMetWithSilence)
{
    for (std::size_t i = 0; i < good.size(); ++i) {
        Octets wrong = good;
        wrong.insert(wrong.begin() + static_cast<std::ptrdiff_t>(i), good[i]);
        // A doubled SD2 is one octet of noise before a telegram that is whole: that one is answered.
        if (i == 0 && good[0] == 0x68) continue;
        expect_silence(wrong);
    }
    expect_normal_service();
}

TEST_P(Corrupted, NextGoodRequestIsAnsweredAfterEachCorruption)
{
    for (std::size_t i = 0; i < good.size(); ++i) {
        Octets wrong = good;
        wrong[i] ^= 0x04;
        expect_silence(wrong);
        const Octets next = sd1(kUs, kOtherMaster, kFdlStatus);
        bus.master_sends(next);
        EXPECT_EQ(bus.reply(), octets("10 03 05 00 08 16")) << show(wrong);
        user.heards.clear();
    }
}

INSTANTIATE_TEST_SUITE_P(C03, Corrupted, testing::ValuesIn(requests_to_us()), kNameOf);

} // namespace
