// SPDX-License-Identifier: Apache-2.0
/// Tests what the service manager hears, with a socket of the test in its place.
#include "support/folder.hpp"

#include "dpslave/io/fd.hpp"
#include "dpslave/io/notify.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>

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
