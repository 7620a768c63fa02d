// SPDX-License-Identifier: Apache-2.0
// Lines that carry more than telegrams.
#include "gateway.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <random>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

using Octets = std::vector<std::uint8_t>;

Octets random_octets(std::size_t count, unsigned seed)
{
    std::mt19937 random{seed};
    Octets octets(count);
    std::generate(octets.begin(), octets.end(), [&] { return static_cast<std::uint8_t>(random() & 0xFF); });
    return octets;
}

/// Telegrams to station 5, each with one bit inverted, one octet missing or one too many inside.
Octets spoilt_telegrams(std::size_t count, unsigned seed)
{
    const std::vector<Octets> whole{
        {0x10, 0x05, 0x02, 0x49, 0x50, 0x16},                                           // FDL status
        {0x68, 0x05, 0x05, 0x68, 0x85, 0x82, 0x6D, 0x3C, 0x3E, 0xEE, 0x16},             // Slave_Diag
        {0x68, 0x05, 0x05, 0x68, 0x05, 0x02, 0x5D, 0x00, 0x00, 0x64, 0x16},             // Data_Exchange
        {0x68, 0x07, 0x07, 0x68, 0xFF, 0x82, 0x46, 0x3A, 0x3E, 0x02, 0x00, 0x41, 0x16}, // Global_Control
    };
    std::mt19937 random{seed};
    Octets all;
    for (std::size_t i = 0; i < count; ++i) {
        Octets one = whole[random() % whole.size()];
        const auto at = one.begin() + 1 + static_cast<std::ptrdiff_t>(random() % (one.size() - 1));
        switch (random() % 3) {
            case 0: *at = static_cast<std::uint8_t>(*at ^ (1U << (random() % 8))); break;
            case 1: one.erase(at); break;
            default: one.insert(at, static_cast<std::uint8_t>(random() & 0xFF)); break;
        }
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

/// Another station at the bus, which breaks its rules.
class Intruder {
public:
    explicit Intruder(const Gateway& gateway)
        : fd_(::open(gateway.bus_end().c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC))
    {}
    ~Intruder() { ::close(fd_); }
    Intruder(const Intruder&) = delete;
    Intruder& operator=(const Intruder&) = delete;

    bool shouts(const Octets& octets) const
    {
        std::size_t done = 0;
        while (done < octets.size()) {
            const ssize_t put = ::write(fd_, octets.data() + done, octets.size() - done);
            if (put <= 0) return false;
            done += static_cast<std::size_t>(put);
        }
        return true;
    }

private:
    int fd_;
};

TEST(BusNoise, OfBitErrorsIsCountedAndTheExchangeGoesOn)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w", "--retries", "15"}};
    ASSERT_TRUE(master.does("start 30s"));
    const auto cycles = gateway.cycles();

    gateway.bus().send_line("errors 0.0005");
    EXPECT_TRUE(eventually([&] { return gateway.flaws() >= 10; }));
    for (const char* const value : {"1", "2", "3"}) {
        gateway.drive().send_line(std::string{"set 55 "} + value);
        EXPECT_TRUE(master.does(std::string{"wait 30s for in 1 = "} + value + "00"));
    }
    EXPECT_TRUE(eventually([&] { return gateway.cycles() > cycles + 100; }));
    gateway.bus().send_line("errors 0");
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    EXPECT_EQ(gateway.station().at("left_count"), 0);
    EXPECT_THAT(gateway.dpctl({"counters"}).out, HasSubstr("flaw: "));
}

TEST(BusNoise, OfRandomOctetsAndSpoiltTelegramsIsNotAnsweredAndServiceIsNormalRightAfter)
{
    Gateway gateway;
    const Octets random = random_octets(6000, 1), spoilt = spoilt_telegrams(400, 2);
    Intruder intruder{gateway};
    ASSERT_TRUE(intruder.shouts(random));
    ASSERT_TRUE(intruder.shouts(spoilt));
    EXPECT_TRUE(
        eventually([&] { return gateway.counter("bus", "octets") >= random.size() + spoilt.size(); }));
    EXPECT_EQ(gateway.spoken_on_the_bus(), "b to a: 0 octets");

    Master master{gateway, {"--tags", "55,56w", "--retries", "5"}};
    EXPECT_TRUE(master.does("start 30s"));
    for (unsigned seed = 3; seed < 8; ++seed) {
        ASSERT_TRUE(intruder.shouts(random_octets(300, seed)));
        EXPECT_TRUE(master.does("out 1 = " + std::to_string(seed * 100)));
        EXPECT_TRUE(gateway.drive().says("tag 56 written " + std::to_string(seed) + ".00"));
    }
    EXPECT_EQ(gateway.station().at("left_count"), 0);
}

class DriveNoise : public ::testing::TestWithParam<const char*> {};

TEST_P(DriveNoise, IsADriveThatDoesNotAnswerUntilTheLineIsGoodAgain)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 30s for in 1 = 1250"));

    gateway.drive().send_line(GetParam());
    gateway.drive().send_line("set 55 99.00");
    EXPECT_TRUE(gateway.daemon().says("unwinder: the drive does not answer"));
    EXPECT_TRUE(master.does("expect in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = 700"));
    gateway.drive().skip();
    gateway.drive().send_line("ok");
    EXPECT_TRUE(gateway.drive().says("tag 56 written 7.00"));
    EXPECT_TRUE(master.does("wait 30s for in 1 = 9900"));
    EXPECT_TRUE(eventually([&] { return gateway.station().at("drive").at("link") == "answers"; }));
}
INSTANTIATE_TEST_SUITE_P(OfEachKind, DriveNoise, ::testing::Values("garbage", "bad-bcc"),
                         [](const auto& one) {
                             return std::string{one.param} == "garbage" ? "Garbage" : "WrongBlockChecks";
                         });

} // namespace
} // namespace dpslave::test
