// SPDX-License-Identifier: Apache-2.0
// Bit errors on the lines of the real programs: what the operator is told. That no damaged telegram counts is
// judged bit by bit on the simulated clock (tests/dp/bus, tests/drive_line).
// Only here: counters that a running daemon has made, in the words of the doctor.
#include "fault_row.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Ge;
using ::testing::Le;

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

/// Values in both directions while a line inverts bits, and when it does so no more.
class RowOfNoise : public RowOfADrive {
protected:
    void goes_through(Process& line, const char* rule)
    {
        const std::size_t before = taken().size();
        line.send_line("errors 0.0005");
        int value = 1;
        for (int change = 0; change < 8; ++change) both_ways(++value);
        EXPECT_TRUE(doctor_names(rule));
        EXPECT_TRUE(master_stays_in_data_exchange());

        line.send_line("errors 0");
        fault_ends();
        both_ways(++value);
        recovered();
        EXPECT_THAT(taken(before), Each(AllOf(Ge(1), Le(value)))) << "or nobody sent it";
        EXPECT_TRUE(never_an_older_one(taken()));
        EXPECT_TRUE(never_an_older_one(seen()));
    }

private:
    void both_ways(int value)
    {
        drive_shows(value);
        EXPECT_TRUE(master_wants(value));
        EXPECT_TRUE(drive_takes(value));
        EXPECT_TRUE(master_sees(value));
    }
};

TEST_P(RowOfNoise, F08_OnTheBusIsNamedByTheDoctor)
{
    begins(wiring_of(GetParam()), master_of(GetParam(), {"--retries", "15"}));
    goes_through(gateway->bus(), "bus.flaws");
}

TEST_P(RowOfNoise, F09_OnTheLineOfADriveIsNamedByTheDoctor)
{
    begins(GetParam());
    goes_through(gateway->drive_line(), "drive.damaged");
}

INSTANTIATE_TEST_SUITE_P(Over, RowOfNoise, ::testing::Values("ei-ascii", "modbus-rtu"));

TEST_F(FaultRow, F08_OfRandomOctetsAndSpoiltTelegramsIsNotAnsweredAndServiceIsNormalRightAfter)
{
    installs({});
    const Octets random = random_octets(6000, 1), spoilt = spoilt_telegrams(400, 2);
    Intruder intruder{*gateway};
    ASSERT_TRUE(intruder.shouts(random));
    ASSERT_TRUE(intruder.shouts(spoilt));
    EXPECT_TRUE(
        eventually([&] { return gateway->counter("bus", "octets") >= random.size() + spoilt.size(); }));
    EXPECT_EQ(gateway->spoken_on_the_bus(), "b to a: 0 octets");

    master.emplace(*gateway, Arguments{"--tags", "55,56w", "--retries", "5"});
    EXPECT_TRUE(master->does("start 30s"));
    for (unsigned seed = 3; seed < 8; ++seed) {
        ASSERT_TRUE(intruder.shouts(random_octets(300, seed)));
        EXPECT_TRUE(master->does("out 1 = " + std::to_string(seed * 100)));
        EXPECT_TRUE(gateway->drive().says("tag 56 written " + std::to_string(seed) + ".00"));
    }
    EXPECT_EQ(gateway->station().at("left_count"), 0);
}

} // namespace
} // namespace dpslave::test
