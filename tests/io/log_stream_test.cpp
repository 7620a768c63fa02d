// SPDX-License-Identifier: Apache-2.0
/// Tests that whoever writes the log waits for nobody who reads it.
#include "pty.hpp"

#include "dpslave/io/log_stream.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>

namespace dpslave::io {
namespace {

const std::string kLine = std::string(99, 'x') + '\n';

/// Returns how many octets were taken until there was no more room.
std::size_t fill(LogStream& stream)
{
    constexpr std::size_t kMuch = std::size_t{1} << 24; // more than any of them has room for
    for (std::size_t all = 0;;) {
        const std::size_t taken = stream.put(kLine);
        all += taken;
        if (taken < kLine.size() || all > kMuch) return all;
    }
}

TEST(LogStream, ToATerminalThatNobodyReadsTakesWhatThereIsRoomForAndGoesOnWhenItIsRead)
{
    Pty pty;
    const Fd terminal{::open(pty.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    LogStream stream{terminal.get()};

    const std::size_t taken = fill(stream);
    EXPECT_GT(taken, kLine.size());
    EXPECT_LT(taken, std::size_t{1} << 24);
    EXPECT_LT(stream.put(kLine), kLine.size());

    while (!pty.received().empty()) {
    }
    EXPECT_EQ(stream.put(kLine), kLine.size());
    EXPECT_EQ(::fcntl(terminal.get(), F_GETFL) & O_NONBLOCK, 0) << "that of the others stays as it was";
}

TEST(LogStream, ToAPipeAndToASocketIsTheSame)
{
    std::array<int, 2> pipe{}, socket{};
    ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, socket.data()), 0);
    for (const auto& ends : {pipe, socket}) {
        const Fd reader{ends[0]}, writer{ends[1]};
        LogStream stream{writer.get()};

        EXPECT_GT(fill(stream), kLine.size());
        EXPECT_LT(stream.put(kLine), kLine.size());
        EXPECT_EQ(::fcntl(writer.get(), F_GETFL) & O_NONBLOCK, 0);
    }
}

TEST(LogStream, ThatNobodyHasAnyMoreTakesNothing)
{
    LogStream closed{-1};

    EXPECT_EQ(closed.put(kLine), 0u);
}

} // namespace
} // namespace dpslave::io
