// SPDX-License-Identifier: Apache-2.0
/// Tests that whoever writes the log waits for nobody who reads it.
#include "pty.hpp"
#include "support/eventually.hpp"

#include "dpslave/io/log_thread.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <optional>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using test::eventually;

const std::string kLine = std::string(99, 'x') + '\n';

bool has_room(int fd)
{
    pollfd there{.fd = fd, .events = POLLOUT, .revents = 0};
    return ::poll(&there, 1, 0) == 1;
}

/// Returns how many lines were taken until there was no more room, neither there nor in `pipe`.
std::size_t fill(LogThread& log, int pipe)
{
    std::size_t lines = 0;
    EXPECT_TRUE(eventually([&] {
        const bool is_full = !has_room(pipe);
        while (log.put(kLine)) ++lines;
        return is_full;
    }));
    return lines;
}

/// Reads until it has all of `size` octets, or as many as there are in a minute.
std::string read_all(int fd, std::size_t size)
{
    std::string all;
    std::array<char, 4096> part{};
    pollfd there{.fd = fd, .events = POLLIN, .revents = 0};
    while (all.size() < size && ::poll(&there, 1, 60'000) == 1) {
        const ssize_t got = ::read(fd, part.data(), std::min(part.size(), size - all.size()));
        if (got <= 0) break;
        all.append(part.data(), static_cast<std::size_t>(got));
    }
    return all;
}

class LogToAPipe : public testing::Test {
protected:
    LogToAPipe()
    {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error{errno, std::generic_category()};
        reader = Fd{ends[0]};
        writer = Fd{ends[1]};
    }
    Fd reader, writer;
};

TEST_F(LogToAPipe, HasEachLineInItsOrder)
{
    LogThread log{writer.get()};
    EXPECT_TRUE(log.put("one\n"));
    EXPECT_TRUE(log.put("two\n"));
    EXPECT_TRUE(log.put(""));
    EXPECT_TRUE(log.finish(60s));
    EXPECT_EQ(read_all(reader.get(), 8), "one\ntwo\n");
}

TEST_F(LogToAPipe, ThatNobodyReadsTakesWhatThereIsRoomForAndGoesOnWhenItIsRead)
{
    LogThread log{writer.get()};

    const std::size_t lines = fill(log, writer.get());
    EXPECT_GE(lines, LogThread::kMostWaiting / kLine.size());
    EXPECT_FALSE(log.finish(1ms));

    EXPECT_EQ(read_all(reader.get(), lines * kLine.size()).size(), lines * kLine.size());
    EXPECT_TRUE(eventually([&] { return log.put("behind it\n"); }));
    EXPECT_EQ(read_all(reader.get(), 10), "behind it\n") << "no line was cut";
    EXPECT_EQ(::fcntl(writer.get(), F_GETFL) & O_NONBLOCK, 0) << "that of the others stays as it was";
}

TEST_F(LogToAPipe, ThatNobodyReadsDoesNotKeepTheEndOfTheProgram)
{
    {
        LogThread log{writer.get()};
        fill(log, writer.get());
        EXPECT_FALSE(log.say_last("the last\n", 1ms));
    }
    SUCCEED() << "the thread is left to itself";
}

TEST_F(LogToAPipe, HasTheLastLineOfAProgramThatEndsBehindIt)
{
    LogThread log{writer.get()};
    log.put("one\n");
    EXPECT_TRUE(log.finish(60s));
    EXPECT_TRUE(log.say_last("the last\n", 60s));
    EXPECT_EQ(read_all(reader.get(), 13), "one\nthe last\n");
}

TEST_F(LogToAPipe, WaitsWhereAnotherProgramHasSetItNotToBlock)
{
    ASSERT_EQ(::fcntl(writer.get(), F_SETFL, O_NONBLOCK), 0);
    LogThread log{writer.get()};
    const std::size_t lines = fill(log, writer.get());
    EXPECT_EQ(read_all(reader.get(), lines * kLine.size()).size(), lines * kLine.size());
}

TEST(LogThread, ToATerminalThatNobodyReadsIsTheSame)
{
    Pty pty;
    const Fd terminal{::open(pty.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    LogThread log{terminal.get()};

    std::size_t lines = 0;
    while (lines < 1'000'000 && log.put(kLine)) ++lines;
    EXPECT_LT(lines, 1'000'000U);

    EXPECT_TRUE(eventually([&] {
        static_cast<void>(pty.received());
        return log.finish(1ms);
    }));
    EXPECT_TRUE(log.put(kLine));
}

TEST(LogThread, CountsLinesThatCannotBeWritten)
{
    const Fd full{::open("/dev/full", O_WRONLY | O_CLOEXEC)};
    for (const int fd : {full.get(), -1}) {
        LogThread log{fd};
        EXPECT_TRUE(log.put(kLine));
        EXPECT_TRUE(log.put(kLine));
        EXPECT_TRUE(log.finish(60s));
        EXPECT_EQ(log.take_lost(), 2U);
        EXPECT_EQ(log.take_lost(), 0U);
    }
}

/// Whether the thread "log" of this process takes SIGTERM; nothing: there is none yet.
std::optional<bool> takes_sigterm()
{
    for (const auto& task : std::filesystem::directory_iterator{"/proc/self/task"}) {
        std::string line;
        std::getline(std::ifstream{task.path() / "comm"} >> std::ws, line);
        if (line != "log") continue;
        for (std::ifstream status{task.path() / "status"}; std::getline(status, line);)
            if (line.starts_with("SigBlk:"))
                return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1) == 0;
    }
    return std::nullopt;
}

TEST(LogThread, TakesNoSignalAndLeavesThoseOfItsMakerAsTheyWere)
{
    LogThread log{-1};
    std::optional<bool> takes;
    EXPECT_TRUE(eventually([&] { return (takes = takes_sigterm()).has_value(); }));
    EXPECT_FALSE(takes.value_or(true));
    sigset_t blocked{};
    ASSERT_EQ(::pthread_sigmask(SIG_SETMASK, nullptr, &blocked), 0);
    EXPECT_EQ(::sigismember(&blocked, SIGTERM), 0);
}

} // namespace
} // namespace dpslave::io
