// SPDX-License-Identifier: Apache-2.0
// The rate of the bus, found by listening to a real master on a line where another rate is garbage.
// Only here: the rate of a tty that is switched while a program waits for it.
#include "gateway.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

#include <chrono>

namespace dpslave::test {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

/// A loaded machine repeats what came too late; the rate that is heard is the same.
const Arguments kPatientMaster{"--tags", "55,56w"};

/// A gateway on a line of `line_baud`, its configuration with another rate: "auto", or a number.
class GatewayAt : public Gateway {
public:
    GatewayAt(unsigned line_baud, const std::string& baud)
        : Gateway({.bus_baud = line_baud, .started = false})
    {
        std::string text = config_text();
        const std::string from = "baud = " + std::to_string(line_baud) + "\n";
        text.replace(text.find(from), from.size(), "baud = " + baud + "\n");
        write_file(config(), text);
    }

    Json bus_status() const { return json({"status"}).at("bus"); }
    bool is_searching() const { return bus_status().at("baud_state") == "Baud_Search"; }
    bool has_found() const
    {
        const Json state = bus_status().at("baud_state");
        return state == "Baud_Control" || state == "DP_Control";
    }
};

/// How long the wrong rates before `baud` are listened to (wire reference 7.2).
milliseconds dwells_before(unsigned baud)
{
    milliseconds sum{0};
    for (const unsigned wrong : {1'500'000U, 500'000U, 187'500U, 93'750U, 19'200U, 9'600U}) {
        if (wrong == baud) break;
        sum += wrong >= 93'750 ? seconds{2} : seconds{4};
    }
    return sum;
}

class SearchedRate : public ::testing::TestWithParam<unsigned> {};

TEST_P(SearchedRate, IsFoundAndThenDataAreExchanged)
{
    GatewayAt gateway{GetParam(), "\"auto\""};
    Master master{gateway, kPatientMaster};
    master.send_line("start 50s");
    const auto before = steady_clock::now();
    gateway.start_daemon();

    ASSERT_TRUE(eventually([&] { return gateway.has_found(); }));
    const auto found = duration_cast<milliseconds>(steady_clock::now() - before);
    // How late it may be found is proven on the simulated bus.
    EXPECT_GE(found, dwells_before(GetParam())) << "at a wrong rate nothing may be found";

    ASSERT_TRUE(master.does("wait 60s for state data-exchange"));
    EXPECT_EQ(gateway.bus_status().at("baud"), GetParam());
    EXPECT_TRUE(eventually([&] { return gateway.bus_status().at("baud_state") == "DP_Control"; }));
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.does("out 1 = -300"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written -3.00"));
}
INSTANTIATE_TEST_SUITE_P(A006, SearchedRate, ::testing::Values(19'200U, 500'000U),
                         [](const auto& one) { return "At" + std::to_string(one.param); });

TEST(SearchedRateOfTheMaster, ThatChangesIsFoundAgain)
{
    GatewayAt gateway{187'500, "\"auto\""};
    gateway.start_daemon();
    {
        Master master{gateway, {"--tags", "55,56w", "--watchdog", "1s"}};
        ASSERT_TRUE(master.does("start 50s"));
        EXPECT_EQ(gateway.bus_status().at("baud"), 187'500);
        EXPECT_TRUE(master.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
    }
    EXPECT_TRUE(gateway.drive().says("tag 56 written 0.00")) << "the watchdog comes first";
    EXPECT_TRUE(eventually([&] { return gateway.is_searching(); }));

    gateway.bus().send_line("baud 93750");
    Process other{{program_path("dpsim"), "master", "--port", gateway.bus_end(), "--baud", "93750", "--slave",
                   "5", "--watchdog", "5s", "--tags", "55,56w"}};
    other.send_line("start 50s");
    other.send_line("out 1 = 600");
    EXPECT_TRUE(gateway.drive().says("tag 56 written 6.00", 2 * kLimit));
    EXPECT_EQ(gateway.bus_status().at("baud"), 93'750);
}

TEST(FixedRate, Of45450IsServedAlthoughItIsNeverSearched)
{
    GatewayAt gateway{45'450, "45450"};
    gateway.start_daemon();
    Master master{gateway, kPatientMaster};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_EQ(gateway.bus_status().at("baud"), 45'450);
    EXPECT_EQ(gateway.bus_status().at("baud_state"), "fixed");
    EXPECT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
}

TEST(FixedRate, ThatIsNotTheMastersHearsGarbage)
{
    GatewayAt gateway{187'500, "500000"};
    gateway.start_daemon();
    Master master{gateway, {"--tags", "55,56w"}};
    master.send_line("start 1s");

    EXPECT_TRUE(eventually([&] { return gateway.counter("bus", "octets") > 100; }));
    EXPECT_EQ(gateway.counter("bus", "telegrams"), 0U);
    EXPECT_EQ(gateway.bus_status().at("baud_state"), "fixed");
}

} // namespace
} // namespace dpslave::test
