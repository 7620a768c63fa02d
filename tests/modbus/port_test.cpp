// SPDX-License-Identifier: Apache-2.0
/// The port itself: not there at the start, pulled in service, plugged in again.
#include "modbus/rtu_line.hpp"
#include "scripted_slave.hpp"

#include "dpslave/io/clock.hpp"
#include "dpslave/io/thread_sign.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <optional>

namespace dpslave::modbus::test {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// A port under one name, whatever is plugged in there.
class Socket {
public:
    Socket()
    {
        std::string folder = (std::filesystem::temp_directory_path() / "dpslave-modbus-XXXXXX").string();
        if (::mkdtemp(folder.data()) == nullptr)
            throw std::system_error{errno, std::system_category(), "mkdtemp"};
        folder_ = folder;
        plug();
    }
    ~Socket()
    {
        slave_.reset();
        std::filesystem::remove_all(folder_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    std::string path() const { return folder_ / "port"; }
    void plug()
    {
        cable_.emplace();
        std::filesystem::create_symlink(cable_->path(), path());
        slave_ = std::make_unique<ScriptedSlave>(cable_->fd());
    }
    void pull()
    {
        slave_.reset();
        std::filesystem::remove(path());
        cable_.reset();
    }
    ScriptedSlave& slave() { return *slave_; }

private:
    std::filesystem::path folder_;
    std::optional<io::Pty> cable_;
    std::unique_ptr<ScriptedSlave> slave_;
};

TEST(ModbusPort, IsRefusedWithASentenceWhenItIsNotThere)
{
    std::atomic<bool> is_open{false};

    const auto none = ModbusRtu::open({.port = "/dev/no-such-port"}, is_open);
    const auto no_tty = ModbusRtu::open({.port = "/dev/null"}, is_open);

    ASSERT_FALSE(none);
    EXPECT_THAT(none.error(), AllOf(StartsWith("/dev/no-such-port is not there"), HasSubstr("check `port`")));
    ASSERT_FALSE(no_tty);
    EXPECT_THAT(no_tty.error(), HasSubstr("no serial port"));
    EXPECT_FALSE(is_open);
}

TEST(ModbusPort, IsRefusedWhileAnotherProgramUsesIt)
{
    io::Pty cable;
    std::atomic<bool> is_open{false};
    const auto first = ModbusRtu::open({.port = cable.path()}, is_open);
    ASSERT_TRUE(first) << first.error();

    const auto second = ModbusRtu::open({.port = cable.path()}, is_open);

    ASSERT_FALSE(second);
    EXPECT_THAT(second.error(), HasSubstr("used by another program"));
}

TEST(ModbusPort, GivesEveryOctetThroughUnchanged)
{
    Bench line;
    line.slave().answers("01 03 08 0D 0A 11 13 03 04 00 7F"); // CR, LF, XON, XOFF, end of text, end of file
    std::array<std::uint16_t, 4> words{};

    ASSERT_EQ(line.drive().read({.unit = 1}, number(0x0D0A), words), AccessError::none);

    EXPECT_THAT(words, testing::ElementsAre(0x0D0A, 0x1113, 0x0304, 0x007F));
    EXPECT_THAT(line.slave().requested()[0], StartsWith("01 03 0D 0A 00 04"));
}

TEST(ModbusPort, ThatBabblesWithoutEndDoesNotHoldACallForEver)
{
    io::Pty cable;
    std::atomic<bool> is_open{false};
    const auto drive = ModbusRtu::open({.port = cable.path(), .baud = 115'200, .timeout = 50ms}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    const std::jthread babbler{[&](const std::stop_token& stop) {
        const Octets noise(64, 0x55);
        while (!stop.stop_requested()) {
            pollfd line{.fd = cable.fd(), .events = POLLOUT, .revents = 0};
            ::poll(&line, 1, 1);
            if ((line.revents & POLLOUT) != 0 && ::write(cable.fd(), noise.data(), noise.size()) < 0) return;
        }
    }};
    std::uint16_t word = 0;

    EXPECT_NE((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::none);
    EXPECT_NE((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::none);
}

TEST(ModbusPort, ThatDoesNotTakeTheRequestIsStillThere)
{
    Socket socket;
    std::atomic<bool> is_open{true};
    const auto drive = ModbusRtu::open({.port = socket.path(), .timeout = 60s}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    const io::Fd same_port{::open(socket.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    std::uint16_t word = 0;

    ASSERT_EQ(::tcflow(same_port.get(), TCOOFF), 0); // as a UART without its clear-to-send
    EXPECT_EQ((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::no_answer);
    EXPECT_EQ((*drive)->last_trouble(), "the line does not accept the request");
    EXPECT_TRUE(is_open);

    ASSERT_EQ(::tcflow(same_port.get(), TCOON), 0);
    socket.slave().answers("01 03 02 00 B7");
    EXPECT_EQ((*drive)->read({.unit = 1}, number(2), {&word, 1}), AccessError::none);
    EXPECT_EQ(word, 183);
    EXPECT_EQ(socket.slave().requested().size(), 1U);
}

/// Nothing is written behind a call that has stalled: a word that goes out once is still to go, and no answer
/// is owed.
TEST(ModbusPort, ThatMayNotBeWrittenToHasSentNothing)
{
    Socket socket;
    std::atomic<bool> is_open{true};
    const auto drive = ModbusRtu::open({.port = socket.path(), .timeout = 60s}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    io::ThreadSign sign;
    sign.enter(io::PortCall::open, io::monotonic_now() - 1h);
    sign.leave(io::monotonic_now());
    io::set_sign_of_this_thread(&sign);
    std::uint16_t word = 7;

    EXPECT_EQ((*drive)->write({.unit = 1}, number(1), {&word, 1}), AccessError::no_answer);
    EXPECT_FALSE((*drive)->has_sent());
    EXPECT_EQ((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::no_answer);
    EXPECT_TRUE(is_open);

    io::set_sign_of_this_thread(nullptr);
    socket.slave().answers("01 03 02 00 B7");
    EXPECT_EQ((*drive)->read({.unit = 1}, number(2), {&word, 1}), AccessError::none);
    EXPECT_EQ(word, 183);
}

TEST(ModbusPort, IsUsedAgainWhenItReturns)
{
    Socket socket;
    std::atomic<bool> is_open{true};
    const auto drive = ModbusRtu::open({.port = socket.path(), .timeout = 60s, .reopen_after = 0ms}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    std::uint16_t word = 0;

    socket.pull();
    EXPECT_EQ((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::no_answer);
    EXPECT_FALSE(is_open);
    EXPECT_EQ((*drive)->last_trouble(), socket.path() + " is missing");
    EXPECT_NE((*drive)->probe({.unit = 1}), AccessError::none); // still gone
    EXPECT_FALSE(is_open);

    socket.plug();
    socket.slave().answers("01 03 02 00 B7");
    EXPECT_EQ((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::none);
    EXPECT_EQ(word, 183);
    EXPECT_TRUE(is_open);
}

TEST(ModbusPort, ThatVanishesWhileAnAnswerIsAwaitedIsNotWaitedForAnyLonger)
{
    Socket socket;
    std::atomic<bool> is_open{false};
    const auto drive = ModbusRtu::open({.port = socket.path(), .timeout = 1h, .reopen_after = 0ms}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    std::thread puller{[&socket] {
        static_cast<void>(socket.slave().requested(1));
        socket.pull();
    }};
    std::uint16_t word = 0;

    EXPECT_EQ((*drive)->read({.unit = 1}, number(1), {&word, 1}), AccessError::no_answer);

    puller.join();
    EXPECT_FALSE(is_open);
}

TEST(ModbusPort, IsTriedAgainOnlyAfterAWhile)
{
    Socket socket;
    std::atomic<bool> is_open{false};
    const auto drive = ModbusRtu::open({.port = socket.path(), .timeout = 60s, .reopen_after = 1h}, is_open);
    ASSERT_TRUE(drive) << drive.error();
    socket.pull();
    EXPECT_NE((*drive)->probe({.unit = 1}), AccessError::none);
    socket.plug();

    EXPECT_NE((*drive)->probe({.unit = 1}), AccessError::none);

    EXPECT_FALSE(is_open);
    EXPECT_TRUE(socket.slave().requested().empty());
}

/// The thread had no processor meanwhile. A read gives 256 octets, and the 37th frame begins in the first
/// one.
TEST(ModbusPort, AFrameThatWaitsInThePortIsReadThoughItsTimeIsOver)
{
    constexpr int kFrames = 40;
    io::Pty cable;
    std::atomic<bool> is_open{false};
    const auto line = RtuLine::open({.port = cable.path()}, is_open);
    ASSERT_TRUE(line) << line.error();
    constexpr std::array<std::uint8_t, 5> kReadsRegister1{3, 0, 1, 0, 1};
    ASSERT_TRUE((*line)->send(1, kReadsRegister1));
    Octets all;
    for (int i = 0; i < kFrames; ++i)
        for (const std::uint8_t octet : framed("01 03 02 00 07")) all.push_back(octet);
    cable.send(all);

    const Instant over = io::monotonic_now() - 1h;
    int frames = 0;
    for (auto heard = ModbusPort::Heard::silence; frames < kFrames;) {
        pollfd port{.fd = (*line)->fd(), .events = POLLIN, .revents = 0};
        if (heard == ModbusPort::Heard::silence) {
            ASSERT_EQ(::poll(&port, 1, 60'000), 1);
        }
        heard = (*line)->receive(over);
        frames += heard == ModbusPort::Heard::frame ? 1 : 0;
        ASSERT_TRUE(heard == ModbusPort::Heard::frame || heard == ModbusPort::Heard::silence);
    }
}

/// At 1200 bit/s a request takes 67 ms; on a pty its answer is there at once.
TEST(ModbusPort, APtyTakesNoWireTime)
{
    for (const auto wire_time : {drive::WireTime::automatic, drive::WireTime::no}) {
        Bench line{60s, 1'200, wire_time};
        line.slave().answers("01 03 02 00 B7");
        EXPECT_EQ(line.read(number(1)), AccessError::none);
        EXPECT_EQ(line.drive().counts({.unit = 1}).early, 0U);
    }
}

TEST(ModbusPort, APtyTakesWireTimeWhereTheLineSaysSo)
{
    std::uint64_t early = 0;
    for (int tries = 0; early == 0 && tries < 120; ++tries) { // a slave that stood still is not early
        Bench line{500ms, 1'200, drive::WireTime::yes};
        line.slave().answers("01 03 02 00 B7");
        const AccessError error = line.read(number(1));
        early = line.drive().counts({.unit = 1}).early;
        EXPECT_TRUE(early == 0 || error == AccessError::no_answer);
    }
    EXPECT_EQ(early, 1U);
}

} // namespace
} // namespace dpslave::modbus::test
