// SPDX-License-Identifier: Apache-2.0
/// Tests who is said to use a port, in a /proc of the test: /dev/null stands for the port, device 1:3.
#include "pty.hpp"
#include "support/eventually.hpp"
#include "support/folder.hpp"

#include "dpslave/io/port_users.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <fstream>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;

class PortUsersOf : public testing::Test {
protected:
    /// A process with this name, controlling terminal and open files.
    void process(int pid, const std::string& name, const std::string& terminal,
                 const std::vector<std::string>& files)
    {
        const fs::path one = proc / std::to_string(pid);
        fs::create_directories(one / "fd");
        std::ofstream{one / "comm"} << name << '\n';
        std::ofstream{one / "stat"} << pid << " (" << name << ") S 1 812 812 " << terminal
                                    << " 812 4194560\n";
        int number = 0;
        for (const std::string& file : files) fs::create_symlink(file, one / "fd" / std::to_string(number++));
    }
    PortUsers users(int mine = 0) const { return users_of_port("/dev/null", mine, proc); }

    test::Folder folder;
    const fs::path proc = folder.path();
};

TEST_F(PortUsersOf, AProcessThatHasItOpenIsNamedWithItsNumber)
{
    process(812, "ModemManager", "0", {"/dev/zero", "/dev/null"});
    process(91, "screen (1)", "0", {"/dev/null"});
    process(5, "sshd", "0", {"/dev/zero"});

    EXPECT_EQ(users().users, (std::vector<PortUser>{{91, "screen (1)"}, {812, "ModemManager"}}));
    EXPECT_EQ(users().in_words(), "process 91 (screen (1)), process 812 (ModemManager)");
    EXPECT_FALSE(users().is_console);
}

TEST_F(PortUsersOf, AProcessWhoseTerminalItIsIsNamedAlsoWhereItsFilesCannotBeSeen)
{
    process(812, "agetty", std::to_string(1 << 8 | 3), {});
    EXPECT_EQ(users().in_words(), "process 812 (agetty)");
}

TEST_F(PortUsersOf, TheConsoleOfTheKernelIsNamed)
{
    std::ofstream{proc / "consoles"} << "tty0                 -WU (EC p  )    4:1\n"
                                        "null                 -W- (E  p a)    1:3\n";
    EXPECT_TRUE(users().is_console);
    EXPECT_TRUE(users().is_shared());
    EXPECT_EQ(users().in_words(), "it is the console of the kernel");
    process(812, "agetty", "259", {});
    EXPECT_EQ(users().in_words(), "process 812 (agetty), and it is the console of the kernel");
}

TEST_F(PortUsersOf, AnotherConsoleIsNone)
{
    std::ofstream{proc / "consoles"} << "ttyS0                -W- (EC p a)   11:3\n";
    EXPECT_FALSE(users().is_shared());
}

TEST_F(PortUsersOf, TheDaemonThatServesItIsNone)
{
    process(812, "dpslaved", "0", {"/dev/null"});
    EXPECT_TRUE(users(812).users.empty());
    EXPECT_EQ(users(1).users.size(), 1U);
}

TEST_F(PortUsersOf, APortThatIsNotThereHasNone)
{
    process(812, "agetty", "0", {"/dev/null"});
    EXPECT_FALSE(users_of_port("/dev/no-such-port", 0, proc).is_shared());
    EXPECT_FALSE(users_of_port("/etc/passwd", 0, proc).is_shared()) << "nor has a file";
}

/// A simulated line keeps the end of the daemon open, so that it is there when nobody has it.
TEST(PortUsersOfThisMachine, WhoHasMadeAPtyIsNone)
{
    const Pty pty;
    const Fd kept{::open(pty.path().c_str(), O_RDWR | O_NOCTTY)};
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) { // it has both ends
        ::pause();
        ::_exit(0);
    }
    const PortUsers found = users_of_port(pty.path());
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_FALSE(found.is_shared()) << found.in_words();
}

/// By the real /proc: another process has the other end of a pty.
TEST(PortUsersOfThisMachine, AreThoseThatHaveItOpen)
{
    const Pty pty;
    EXPECT_FALSE(users_of_port(pty.path()).is_shared());
    const Fd port{::open(pty.path().c_str(), O_RDWR | O_NOCTTY)}; // without O_CLOEXEC
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        ::execlp("sleep", "sleep", "60", nullptr);
        ::_exit(127);
    }
    PortUsers found;
    test::eventually([&] { return !(found = users_of_port(pty.path())).users.empty(); });
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ASSERT_EQ(found.users.size(), 1U);
    EXPECT_EQ(found.users[0].pid, child);
}

} // namespace
} // namespace dpslave::io
