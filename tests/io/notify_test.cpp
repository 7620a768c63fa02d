// SPDX-License-Identifier: Apache-2.0
/// Tests what the service manager hears, with a socket of the test in its place.
#include "support/folder.hpp"

#include "dpslave/io/fd.hpp"
#include "dpslave/io/notify.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;

class ServiceManager : public testing::Test {
protected:
    void SetUp() override
    {
        const std::string path = folder / "notify";
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        ASSERT_LT(path.size(), sizeof address.sun_path);
        path.copy(address.sun_path, path.size());
        socket = Fd{::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
        ASSERT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
        ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
        ::unsetenv("WATCHDOG_USEC");
        ::unsetenv("WATCHDOG_PID");
    }
    void TearDown() override
    {
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    }

    /// The next message; empty: none came.
    std::string heard()
    {
        char text[512];
        const ssize_t got = ::recv(socket.get(), text, sizeof text, 0);
        return got > 0 ? std::string(text, static_cast<std::size_t>(got)) : std::string{};
    }

    dpslave::test::Folder folder;
    Fd socket;
    Notifier notifier;
};

TEST_F(ServiceManager, ReceivesReadyAndTheStatus)
{
    notifier.ready("station 5: Wait_Prm");

    EXPECT_EQ(heard(), "READY=1\nSTATUS=station 5: Wait_Prm");
}

TEST_F(ServiceManager, ReceivesEachStatus)
{
    notifier.status("station 5: Data_Exch");

    EXPECT_EQ(heard(), "STATUS=station 5: Data_Exch");
}

TEST_F(ServiceManager, AStatusOfSeveralLinesStaysOneAssignment)
{
    notifier.status("one\nMAINPID=1\ntwo");

    EXPECT_EQ(heard(), "STATUS=one MAINPID=1 two");
}

TEST_F(ServiceManager, ReceivesTheWatchdogAndTheEnd)
{
    notifier.watchdog();
    notifier.stopping();

    EXPECT_EQ(heard(), "WATCHDOG=1");
    EXPECT_EQ(heard(), "STOPPING=1");
}

TEST_F(ServiceManager, ReceivesWhenAReloadBegan)
{
    notifier.reloading(Instant{12'345'678us});

    EXPECT_EQ(heard(), "RELOADING=1\nMONOTONIC_USEC=12345678");
}

TEST_F(ServiceManager, ThatIsNotThereGetsNothing)
{
    ::unsetenv("NOTIFY_SOCKET");

    notifier.ready("up");
    notifier.watchdog();

    EXPECT_EQ(heard(), "");
}

TEST_F(ServiceManager, ThatDoesNotReadKeepsNobodyAndHearsTheLastOfEachWhenItReads)
{
    notifier.reloading(Instant{1us});
    for (int i = 0; i < 10'000; ++i) notifier.status("round " + std::to_string(i));
    notifier.watchdog();
    notifier.ready("up");

    std::vector<std::string> all;
    for (std::string one = heard(); !one.empty(); one = heard()) {
        all.push_back(one);
        notifier.send_rest();
    }
    EXPECT_EQ(all.front(), "RELOADING=1\nMONOTONIC_USEC=1");
    EXPECT_EQ(all.back(), "READY=1\nSTATUS=up");
    EXPECT_EQ(std::count(all.begin(), all.end(), "STATUS=round 9999"), 1);
    EXPECT_EQ(std::count(all.begin(), all.end(), "STATUS=round 9998"), 0);
    EXPECT_EQ(std::count(all.begin(), all.end(), "WATCHDOG=1"), 0) << "a sign of life that is late is none";
}

TEST_F(ServiceManager, MayHaveAnAbstractSocket)
{
    const std::string name = "@dpslave-notify-test-" + std::to_string(::getpid());
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, name.size());
    address.sun_path[0] = '\0';
    socket = Fd{::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), length), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);

    notifier.watchdog();

    EXPECT_EQ(heard(), "WATCHDOG=1");
}

TEST_F(ServiceManager, ReportsHowOftenTheWatchdogIsDue)
{
    ::setenv("WATCHDOG_USEC", "3000000", 1);

    EXPECT_EQ(notifier.watchdog_interval(), 3s);
}

TEST_F(ServiceManager, HasNoWatchdogUnlessConfigured)
{
    EXPECT_EQ(notifier.watchdog_interval(), std::nullopt);

    ::setenv("WATCHDOG_USEC", "3000000", 1);
    ::setenv("WATCHDOG_PID", "1", 1); // another process is meant
    EXPECT_EQ(notifier.watchdog_interval(), std::nullopt);
}

} // namespace
} // namespace dpslave::io
