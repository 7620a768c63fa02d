// SPDX-License-Identifier: Apache-2.0
// Tests what any user of the machine may do to the control socket, and what the bus and the operators notice
// of it.
// Only here: a hostile process beside the bus thread, and the rights of its user.
#include "gateway.hpp"
#include "service_manager.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

constexpr uid_t kStranger = 65534;

/// The attacker, as a user without any right where the test may become one.
class Attacker : public Process {
public:
    explicit Attacker(const Gateway& gateway)
        : Process({"/usr/bin/python3", source_path("tests/system/attacker.py"), gateway.socket(),
                   std::to_string(::geteuid() == 0 ? kStranger : ::geteuid())})
    {}
};

class Attack : public ::testing::Test {
protected:
    Attack() { std::filesystem::permissions(gateway.socket().parent_path(), std::filesystem::perms{0755}); }

    const Folder folder;
    ServiceManager manager{folder / "notify"};
    /// As dpslaved.service has it, but asked for more often, so that the test is short.
    Gateway gateway{{.environment = {{"NOTIFY_SOCKET", folder / "notify"}, {"WATCHDOG_USEC", "1000000"}}}};
};

TEST_F(Attack, FromAnyUserKeepsTheMainThreadNeitherFromItsWatchdogNorFromTheLog)
{
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    ASSERT_TRUE(manager.hears("WATCHDOG=1"));
    Attacker attacker{gateway};
    ASSERT_TRUE(attacker.says("attacking"));

    for (int i = 0; i < 12; ++i) EXPECT_TRUE(manager.hears("WATCHDOG=1"));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(gateway.daemon().says("the drive does not answer"));
    EXPECT_TRUE(manager.hears("drive silent"));
    gateway.drive().send_line("ok");

    EXPECT_LT(manager.longest_silence(), std::chrono::seconds{5}) << "WatchdogSec of the service";
    EXPECT_TRUE(master.does("wait 60s for state data-exchange"));
    EXPECT_EQ(attacker.wait(std::chrono::nanoseconds{0}), std::nullopt) << "it goes on until now";
}

TEST_F(Attack, OfAnotherUserLeavesTheOperatorsTheirConnectionsReadsAndWrites)
{
    if (::geteuid() != 0) GTEST_SKIP() << "only root can be root and another user at once";
    Attacker attacker{gateway};
    ASSERT_TRUE(attacker.says("attacking"));

    for (int i = 0; i < 14; ++i) {
        const std::string value = std::to_string(90 + i) + ".5";
        EXPECT_EQ(gateway.dpctl({"write", "62", value}).status, 0);
        EXPECT_THAT(gateway.dpctl({"read", "62"}).out, HasSubstr("is " + value));
    }
    EXPECT_EQ(gateway.dpctl({"status"}).status, 0);
    EXPECT_EQ(attacker.wait(std::chrono::nanoseconds{0}), std::nullopt) << "it goes on until now";
}

TEST_F(Attack, ByAHostileFileIsRefusedAtAReloadAndTheExchangeGoesOn)
{
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    const std::filesystem::path table = gateway.folder("tags.csv");
    std::string with_table = gateway.config_text();
    with_table = with_table.substr(0, with_table.rfind("tags = ")) + "tags = \"tags.csv\"\n";
    std::string faulty = "tag,name,type\n", deep = "a";
    for (int i = 0; i < 12'000; ++i) faulty += std::to_string(i) + ",a name,NOTYPE\n";
    for (int i = 0; i < 200'000; ++i) deep += ".a";
    const auto is_refused_for = [&](const std::string& why) {
        const Outcome outcome = gateway.dpctl({"reload"});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_THAT(outcome.out + outcome.err, HasSubstr(why));
    };

    write_file(table, faulty);
    write_file(gateway.config(), with_table);
    is_refused_for("there are more faults than the 100 shown here");
    std::filesystem::remove(table);
    ASSERT_EQ(::mkfifo(table.c_str(), 0600), 0);
    is_refused_for("no regular file");
    write_file(gateway.config(), gateway.config_text() + deep + " = 1\n");
    is_refused_for("nested deeper");

    EXPECT_LT(manager.longest_silence(), std::chrono::seconds{5}) << "WatchdogSec of the service";
    EXPECT_TRUE(master.does("wait 60s for state data-exchange"));
}

TEST_F(Attack, ThatIsOverLeavesNothingBehind)
{
    {
        Attacker attacker{gateway};
        ASSERT_TRUE(attacker.says("attacking"));
        attacker.end(SIGKILL);
    }

    EXPECT_EQ(gateway.dpctl({"read", "62"}).status, 0);
    EXPECT_EQ(gateway.daemon().end(), 0);
}

} // namespace
} // namespace dpslave::test
