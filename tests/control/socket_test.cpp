// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <fstream>

namespace dpslave::control {
namespace {

using test::call;
using test::quiet_methods;
using test::TempFolder;

ServerSettings at(const std::filesystem::path& path)
{
    ServerSettings settings;
    settings.socket = path;
    return settings;
}

/// A socket file whose process has died without removing it.
void leave_stale_socket(const std::filesystem::path& path)
{
    const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.native().copy(address.sun_path, sizeof address.sun_path - 1);
    const void* any = &address;
    ASSERT_EQ(::bind(fd, static_cast<const sockaddr*>(any), sizeof address), 0);
    ::close(fd);
}

TEST(ControlSocket, IsReadableForEveryUser)
{
    const test::Bench bench;
    struct stat status {};
    ASSERT_EQ(::stat(bench.socket.c_str(), &status), 0);

    EXPECT_TRUE(S_ISSOCK(status.st_mode));
    EXPECT_EQ(status.st_mode & 0777U, 0666U);
}

TEST(ControlSocket, WithoutAServerIsReplaced)
{
    const TempFolder folder;
    const auto path = folder.path() / "control.sock";
    leave_stale_socket(path);

    const auto server = Server::open(at(path), quiet_methods());

    ASSERT_TRUE(server) << server.error();
    EXPECT_NO_THROW(test::RawCaller{path});
}

TEST(ControlSocket, WithAServerIsKept)
{
    test::Bench first;

    const auto second = Server::open(at(first.socket), quiet_methods());

    ASSERT_FALSE(second);
    EXPECT_EQ(second.error(), first.socket.string() + ": another dpslaved is running and answers here");
    EXPECT_TRUE(first.ask("GetStatus").contains("parameters"));
}

TEST(ControlSocket, IsNotMadeInPlaceOfAFile)
{
    const TempFolder folder;
    const auto path = folder.path() / "notes.txt";
    std::ofstream(path) << "precious";

    const auto server = Server::open(at(path), quiet_methods());

    ASSERT_FALSE(server);
    EXPECT_EQ(server.error(),
              path.string() + ": exists and is not a socket; remove it or name another control.socket");
    EXPECT_TRUE(std::filesystem::exists(path));
}

TEST(ControlSocket, NeedsAFolderThatExists)
{
    const TempFolder folder;
    const auto path = folder.path() / "nowhere" / "control.sock";

    EXPECT_EQ(Server::open(at(path), quiet_methods()).error(),
              path.string() + ": cannot be made: No such file or directory");
}

TEST(ControlSocket, NeedsAPathThatFits)
{
    EXPECT_NE(Server::open(at("/tmp/" + std::string(200, 'x')), quiet_methods())
                  .error()
                  .find("1 to 107 characters"),
              std::string::npos);
    EXPECT_FALSE(Server::open(at(""), quiet_methods()));
}

TEST(ControlSocket, GoesWithItsServer)
{
    const TempFolder folder;
    const auto path = folder.path() / "control.sock";
    {
        const auto server = Server::open(at(path), quiet_methods());
        ASSERT_TRUE(std::filesystem::exists(path));
    }

    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(ControlSocket, ThatAnotherServerReplacedIsNotRemoved)
{
    const TempFolder folder;
    const auto path = folder.path() / "control.sock";
    {
        const auto first = Server::open(at(path), quiet_methods());
        std::filesystem::rename(path, folder.path() / "old.sock");
        leave_stale_socket(path);
    }

    EXPECT_TRUE(std::filesystem::exists(path));
}

} // namespace
} // namespace dpslave::control
