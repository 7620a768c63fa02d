// SPDX-License-Identifier: Apache-2.0
/// The reply path allocates nothing.
#include "support/allocations.hpp"
#include "support/bus.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>

using namespace dpslave;
using namespace ::test;

namespace {

/// Answers in every way there is, in turn.
class TurningUser final : public fdl::SapUser {
public:
    fdl::Answer srd(const fdl::Indication& request, fdl::ReplyData& reply) override
    {
        reply.append(Bytes{inputs_}.first(request.data.size() % inputs_.size()));
        deadline_ = request.at + std::chrono::milliseconds{3};
        return static_cast<fdl::Answer>(++calls_ % 6);
    }
    void sdn(const fdl::Indication&) override { ++calls_; }
    void heard(std::uint8_t, Instant) override { ++calls_; }
    Tbit min_tsdr() const override { return 11_tbit; }
    fdl::Supervision supervision() const override { return static_cast<fdl::Supervision>(calls_ % 3); }
    void on_time(Instant) override { deadline_ = kNever; }
    Instant next_deadline() const override { return deadline_; }
    std::size_t calls() const { return calls_; }

private:
    std::array<std::uint8_t, 244> inputs_{};
    std::size_t calls_ = 0;
    Instant deadline_ = kNever;
};

TEST(ReplyPath, AllocatesNothingIn10000RequestsOfAllKinds)
{
    const auto station = std::make_unique<fdl::Layer2>(fdl::Layer2Settings{
        .baud = Baud::k1500, .search = fdl::BaudSearchSettings{}, .start_up_latency = {}});
    std::array<TurningUser, 3> users;
    for (std::uint8_t a = 0; a < 3; ++a)
        station->attach(static_cast<std::uint8_t>(5 + a), users[a], kClassMaxTsdr);
    const std::vector<Octets> heard{
        sd1(5, 2, 0x49),
        sd2(5, 2, 0x6D, Saps{60, 62}),
        sd2(6, 2, 0x5D, Octets(12, 1)),
        sd2(6, 2, 0x5D, Octets(12, 1)), // a retry
        sd2(7, 2, 0x7D, Saps{61, 62}, Octets(240, 2)),
        sd3(7, 2, 0x5D, Octets(8, 3)),
        sd2(127, 2, 0x46, Saps{58, 62}, {0, 0}),
        sd1(5, 2, 0x4E),
        sd2(5, 2, 0x75, {1}),
        sd2(2, 9, 0x08, Octets(200, 0x68)), // another slave
        token(3, 2),
        {0x68, 0x05, 0x06, 0x16, 0xFF},             // noise
        joined({sd1(5, 2, 0x49), sd1(9, 2, 0x49)}), // overtaken
        {0x10, 0x05, 0x02, 0x49, 0x51, 0x16},       // checksum
    };
    Instant now{std::chrono::seconds{1}};
    std::size_t octets_sent = 0;

    std::optional<dpslave::test::CountAllocations> counting{std::in_place};
    for (std::size_t i = 0; i < 10'000; ++i) {
        now += std::chrono::milliseconds{1};
        station->on_bytes(heard[i % heard.size()], now);
        if (i % 97 == 0) station->on_character_error(now);
        station->on_time(now);
        now += std::chrono::microseconds{30};
        station->on_time(now);
        if (const auto transmit = station->take_transmit()) octets_sent += transmit->size();
        station->take_touched();
        station->take_baud_change();
        static_cast<void>(station->next_deadline());
    }
    counting.reset();

    EXPECT_EQ(dpslave::test::allocations(), 0u);
    EXPECT_GT(octets_sent, 10'000u); // it did answer,
    EXPECT_GT(users[0].calls() + users[1].calls() + users[2].calls(), 5'000u);
    EXPECT_GT(station->counters().retries, 100u);
    EXPECT_GT(station->counters().overtaken, 100u);
}

TEST(ReplyPath, CountsAllocations)
{
    const dpslave::test::CountAllocations counting;
    const auto something = std::make_unique<int>(1);

    EXPECT_GT(dpslave::test::allocations(), 0u); // the counter works
    EXPECT_EQ(*something, 1);
}

} // namespace
