// SPDX-License-Identifier: Apache-2.0
// The control socket under attack by a user without rights.
// Only here: a thousand descriptors of other processes.
#include "fault_row.hpp"
#include "service_manager.hpp"
#include "support/paths.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

class RowOfTheSocket : public FaultRow {
protected:
    /// Data exchange goes on, operators are served and the service manager has its signs of life, while the
    /// attack runs and until `enough`.
    void is_attacked(const std::string& attack, const std::function<void(Process& attacker)>& enough)
    {
        if (::geteuid() != 0) GTEST_SKIP() << "only root can be an operator and another user at once";
        ServiceManager manager{folder / "notify"};
        Wiring wiring = wiring_of("ei-ascii");
        wiring.environment = {{"NOTIFY_SOCKET", folder / "notify"}, {"WATCHDOG_USEC", "1000000"}};
        begins(std::move(wiring), master_of("ei-ascii"));
        std::filesystem::permissions(gateway->socket().parent_path(), std::filesystem::perms{0755});
        const std::string program = source_path("tests/system/attacker.py");
        Process attacker{{"/usr/bin/python3", program, gateway->socket(), std::to_string(kStranger), attack}};
        ASSERT_TRUE(attacker.says("attacking"));
        for (int value = 2; value <= 5; ++value) {
            EXPECT_TRUE(master_wants(value));
            EXPECT_TRUE(drive_takes(value));
            EXPECT_EQ(gateway->dpctl({"write", "58", std::to_string(value)}).status, 0);
            EXPECT_THAT(gateway->dpctl({"read", "58"}).out, HasSubstr("is " + std::to_string(value)));
        }
        enough(attacker);
        EXPECT_TRUE(master_stays_in_data_exchange());

        attacker.end(SIGKILL);
        fault_ends();
        EXPECT_EQ(gateway->dpctl({"status"}).status, 0);
        recovered();
        EXPECT_LT(manager.longest_silence(), std::chrono::seconds{5}) << "WatchdogSec of the service";
        EXPECT_TRUE(never_an_older_one(taken()));
    }

    std::uint64_t counted(const char* name) const { return gateway->counter("control socket", name); }
    /// The attack runs until this counter of the control socket has moved.
    void is_attacked(const std::string& attack, const char* told)
    {
        is_attacked(attack, [&](Process&) { EXPECT_TRUE(eventually([&] { return counted(told) > 0; })); });
    }

private:
    static constexpr uid_t kStranger = 65534;
};

TEST_F(RowOfTheSocket, F28_WithAThousandClientsServesItsOperators)
{
    is_attacked("connects", "displaced");
}

TEST_F(RowOfTheSocket, F29_WithClientsThatReadNoAnswerServesItsOperators)
{
    is_attacked("slow", [&](Process&) {
        EXPECT_LT(counted("calls"), 1000U) << "no call is taken whose reply could not be sent";
    });
}

TEST_F(RowOfTheSocket, F30_With64MegabytesOfGarbageServesItsOperators)
{
    is_attacked("garbage", [&](Process& attacker) {
        EXPECT_TRUE(attacker.says("sent")) << "all 64 MiB";
        EXPECT_GT(counted("malformed"), 0U);
    });
}

TEST_F(RowOfTheSocket, F31_WithCallsThatAreNoJsonServesItsOperators)
{
    is_attacked("bad-json", "malformed");
}

} // namespace
} // namespace dpslave::test
