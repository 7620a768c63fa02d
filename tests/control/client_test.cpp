// SPDX-License-Identifier: Apache-2.0
// The client against peers that are no server of ours: it must say what is wrong, within its time.
#include "bench.hpp"

#include "dpslave/control/client.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <thread>

namespace dpslave::control {
namespace {

using namespace std::chrono_literals;
using namespace std::string_literals;
using Kind = ClientError::Kind;

/// Takes one connection, says `words` and then holds the line, or ends it.
class Impostor {
public:
    Impostor(std::string words, bool hangs_up)
    {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        path.native().copy(address.sun_path, sizeof address.sun_path - 1);
        const void* any = &address;
        listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        EXPECT_EQ(::bind(listener_, static_cast<const sockaddr*>(any), sizeof address), 0);
        EXPECT_EQ(::listen(listener_, 1), 0);
        thread_ = std::thread([this, words = std::move(words), hangs_up] {
            const int fd = ::accept(listener_, nullptr, nullptr);
            if (::send(fd, words.data(), words.size(), MSG_NOSIGNAL) < 0) ADD_FAILURE();
            if (hangs_up) ::shutdown(fd, SHUT_RDWR);
            std::array<char, 4096> ignored;
            while (::recv(fd, ignored.data(), ignored.size(), 0) > 0) {
            } // until the client goes
            ::close(fd);
        });
    }
    Impostor(const Impostor&) = delete;
    Impostor& operator=(const Impostor&) = delete;
    ~Impostor()
    {
        thread_.join();
        ::close(listener_);
    }
    test::TempFolder folder;
    const std::filesystem::path path = folder.path() / "s";

private:
    int listener_ = -1;
    std::thread thread_;
};

constexpr auto kLong = 20s; ///< not waited for: the peer does something
constexpr auto kShort = 100ms;

ClientError failure_of(const std::string& words, bool hangs_up, std::chrono::milliseconds timeout)
{
    const Impostor impostor{words, hangs_up};
    auto client = Client::connect(impostor.path, timeout);
    return client->call("GetStatus").error();
}

TEST(ControlClient, SaysThatThereIsNoDaemon)
{
    const auto client = Client::connect("/nonexistent/control.sock", 100ms);

    ASSERT_FALSE(client);
    EXPECT_EQ(client.error().kind, Kind::no_daemon);
    EXPECT_EQ(client.error().text,
              "nothing answers on /nonexistent/control.sock (No such file or directory)");
}

TEST(ControlClient, GivesUpOnASilentDaemon)
{
    const ClientError error = failure_of("", false, kShort);

    EXPECT_EQ(error.kind, Kind::timeout);
    EXPECT_NE(error.text.find("no answer within 100 ms"), std::string::npos);
}

TEST(ControlClient, GivesUpOnHalfAnAnswer)
{
    EXPECT_EQ(failure_of("{\"para", false, kShort).kind, Kind::timeout);
}

TEST(ControlClient, NoticesThatTheDaemonEnds)
{
    EXPECT_EQ(failure_of("", true, kLong).kind, Kind::ended);
    EXPECT_EQ(failure_of("{\"para", true, kLong).kind, Kind::ended);
}

TEST(ControlClient, RefusesNonsense)
{
    EXPECT_EQ(failure_of("HTTP/1.0 400 Bad Request\r\n\r\n\0"s, false, kLong).kind, Kind::nonsense);
    EXPECT_EQ(failure_of("[]\0"s, false, kLong).kind, Kind::nonsense);
    EXPECT_EQ(failure_of("{\"parameters\":7}\0"s, false, kLong).kind, Kind::nonsense);
}

TEST(ControlClient, ReadsTheReplyOfADaemonThatHangsUpBehindIt)
{
    const Impostor impostor{"{\"error\":\"org.dpslaved.Control.Busy\"}\0"s, true};
    auto client = Client::connect(impostor.path, kLong);

    const auto reply = client->call("GetStatus");

    ASSERT_TRUE(reply) << reply.error().text;
    EXPECT_EQ(reply->error, "org.dpslaved.Control.Busy");
}

TEST(ControlClient, StopsAStreamWhenItIsWoken)
{
    const Impostor impostor{"{\"parameters\":{\"n\":1},\"continues\":true}\0"s, false};
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    auto client = Client::connect(impostor.path, kLong);
    ASSERT_FALSE(client->start("Watch"));
    const auto first = client->next(pipe[0]);
    ASSERT_TRUE(first && *first);
    EXPECT_TRUE((*first)->continues);

    ASSERT_EQ(::write(pipe[1], "x", 1), 1);
    const auto woken = client->next(pipe[0]);

    ASSERT_TRUE(woken);
    EXPECT_FALSE(woken->has_value());
    ::close(pipe[0]);
    ::close(pipe[1]);
}

} // namespace
} // namespace dpslave::control
