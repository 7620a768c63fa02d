// SPDX-License-Identifier: Apache-2.0
/// The serial port against a pty: settings, reading, writing, and the end of the cable.
/// A pty has no UART: parity, character size and error marks need hardware; its doubling of FF under PARMRK
/// is real.
#include "pty.hpp"

#include "dpslave/base/units.hpp"
#include "dpslave/io/tty.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>

#include <array>
#include <numeric>

namespace dpslave::io {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr TtySettings kBusLine{.baud = 187'500, .mark_errors = true};
constexpr TtySettings kDriveLine{.baud = 9'600, .data_bits = 7};

Tty opened(const std::string& path, const TtySettings& settings)
{
    auto tty = Tty::open(path, settings);
    if (!tty) throw std::runtime_error{tty.error()};
    return *std::move(tty);
}

std::vector<std::uint8_t> copy(const Chunk& chunk)
{
    return {chunk.octets.begin(), chunk.octets.end()};
}

TEST(TtyOpen, SetsEveryRateOfProfibus)
{
    for (const Baud baud : kBauds) {
        const auto rate = static_cast<std::uint32_t>(baud);
        Pty cable;

        auto tty = Tty::open(cable.path(), {.baud = rate, .mark_errors = true});

        ASSERT_TRUE(tty) << tty.error();
        EXPECT_EQ(cable.rate(), rate);
    }
}

TEST(TtyOpen, LetsTheKernelDropRtsAtTheCloseUnlessThatWouldMeanSending)
{
    const auto drops = [](bool wanted) {
        Pty cable;
        const Tty tty = opened(cable.path(), {.baud = 9'600, .drop_rts_at_close = wanted});
        termios now{};
        EXPECT_EQ(::tcgetattr(tty.fd(), &now), 0);
        return (now.c_cflag & HUPCL) != 0;
    };

    EXPECT_TRUE(drops(true));
    EXPECT_FALSE(drops(false));
}

TEST(TtyOpen, SetsARawLineThatTheOtherEndSeesUnchanged)
{
    Pty cable;
    Tty tty = opened(cable.path(), kDriveLine);

    ASSERT_FALSE(tty.write(std::vector<std::uint8_t>{0x0A, 0x0D, 0x03, 0x11, 0x13, 0x04, 0x00, 0x7F}));

    EXPECT_THAT(cable.received(), ElementsAre(0x0A, 0x0D, 0x03, 0x11, 0x13, 0x04, 0x00, 0x7F));
}

TEST(TtyOpen, DoesNotEchoWhatComes)
{
    Pty cable;
    Tty tty = opened(cable.path(), kDriveLine);

    cable.send({0x41, 0x0D});
    ASSERT_TRUE(tty.wait_readable(1s));

    EXPECT_TRUE(cable.received().empty());
}

TEST(TtyOpen, ThrowsAwayWhatCameBefore)
{
    Pty cable;
    const Fd keeps_it_alive{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    cable.send({0x01, 0x02, 0x0A});

    Tty tty = opened(cable.path(), kDriveLine);

    EXPECT_FALSE(tty.wait_readable(0s));
}

TEST(TtyOpen, ForReceivingOnlyLeavesNoWayToWrite)
{
    Pty pty;
    auto tty = Tty::open(pty.path(), {.baud = 187'500, .receive_only = true});
    ASSERT_TRUE(tty) << tty.error();
    EXPECT_EQ(::fcntl(tty->fd(), F_GETFL) & O_ACCMODE, O_RDONLY);
    const std::array<std::uint8_t, 2> octets{1, 2};

    EXPECT_EQ(tty->send(octets), std::errc::bad_file_descriptor);
    EXPECT_EQ(tty->write(octets), std::errc::bad_file_descriptor);
    EXPECT_EQ(tty->set_baud(9600), std::nullopt);
    EXPECT_EQ(pty.rate(), 9600U);
    EXPECT_TRUE(pty.received().empty());
    pty.send({7});
    ASSERT_TRUE(tty->wait_readable(std::chrono::minutes{1}));
    std::array<std::uint8_t, 4> buffer{};
    EXPECT_EQ(tty->read(buffer)->octets.size(), 1U);
}

TEST(TtyOpen, RefusesAPortThatIsNotThere)
{
    const auto tty = Tty::open("/dev/no-such-port", kBusLine);

    ASSERT_FALSE(tty);
    EXPECT_THAT(tty.error(),
                AllOf(StartsWith("/dev/no-such-port is not there"), HasSubstr("port"), HasSubstr("cable")));
}

TEST(TtyOpen, RefusesWhatIsNoSerialPort)
{
    const auto null = Tty::open("/dev/null", kBusLine);
    const auto folder = Tty::open("/dev", kBusLine);

    ASSERT_FALSE(null);
    EXPECT_THAT(null.error(), AllOf(StartsWith("/dev/null is no serial port"), HasSubstr("check `port`")));
    ASSERT_FALSE(folder);
    EXPECT_THAT(folder.error(), AllOf(StartsWith("/dev "), HasSubstr("check `port`")));
}

TEST(TtyOpen, SaysTheSameOfAPortThatIsOnlyLookedAt)
{
    const Pty cable;
    EXPECT_EQ(port_trouble(cable.path()), std::nullopt);
    for (const std::string path : {"/dev/no-such-port", "/proc/version"})
        EXPECT_EQ(port_trouble(path), Tty::open(path, kBusLine).error()) << path;
}

TEST(TtyOpen, RefusesAPortThatIsInUseAndTakesItWhenItIsFreeAgain)
{
    Pty cable;
    {
        const Tty first = opened(cable.path(), kBusLine);
        const auto second = Tty::open(cable.path(), kBusLine);
        ASSERT_FALSE(second);
        EXPECT_THAT(second.error(), AllOf(StartsWith(cable.path()), HasSubstr("used by another program")));
    }

    EXPECT_TRUE(Tty::open(cable.path(), kBusLine));
}

TEST(TtyOpen, ASecondOpenerDoesNotDisturbTheFirst)
{
    Pty cable;
    Tty first = opened(cable.path(), kDriveLine);
    cable.send({0x41});

    static_cast<void>(Tty::open(cable.path(), kBusLine));

    std::array<std::uint8_t, 8> room{};
    const auto chunk = first.read(room);
    ASSERT_TRUE(chunk);
    EXPECT_THAT(copy(*chunk), ElementsAre(0x41));
}

/// Opens `path` as an ordinary user, in a child process; gives the child's sentence.
std::string refusal_for_unprivileged(const std::string& path)
{
    int channel[2];
    if (::pipe(channel) != 0) return "pipe";
    const pid_t child = ::fork();
    if (child == 0) {
        constexpr unsigned kUnprivileged = 65534;
        std::string sentence = "no way to become an ordinary user";
        if (::setgid(kUnprivileged) == 0 && ::setuid(kUnprivileged) == 0) {
            const auto tty = Tty::open(path, kBusLine);
            sentence = tty ? "opened" : tty.error();
        }
        const bool is_written = ::write(channel[1], sentence.data(), sentence.size()) > 0;
        ::_exit(is_written ? 0 : 1);
    }
    ::close(channel[1]);
    char text[512] = {};
    const ssize_t got = ::read(channel[0], text, sizeof text - 1);
    ::close(channel[0]);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return got > 0 ? text : "";
}

TEST(TtyOpen, NamesTheGroupThatAUserWithoutRightsNeeds)
{
    if (::geteuid() != 0) GTEST_SKIP() << "needs root to become another user";
    Pty cable;
    ASSERT_EQ(::chmod(cable.path().c_str(), 0600), 0);

    EXPECT_THAT(refusal_for_unprivileged(cable.path()),
                AllOf(StartsWith(cable.path()), HasSubstr("group"), HasSubstr("dialout")));
}

TEST(TtyRead, GivesNothingWhenNothingCame)
{
    for (const TtySettings& settings : {kBusLine, kDriveLine}) {
        Pty cable;
        Tty tty = opened(cable.path(), settings);
        std::array<std::uint8_t, 8> room{};

        const auto chunk = tty.read(room);

        ASSERT_TRUE(chunk) << chunk.error().message();
        EXPECT_TRUE(chunk->octets.empty());
        EXPECT_FALSE(chunk->more);
        EXPECT_FALSE(tty.wait_readable(1ms));
    }
}

TEST(TtyRead, NeverWaitsAlsoWhereTheDescriptorWouldBlock)
{
    for (const TtySettings& settings : {kBusLine, kDriveLine}) {
        Pty cable;
        Tty tty = opened(cable.path(), settings);
        ASSERT_EQ(::fcntl(tty.fd(), F_SETFL, 0), 0); // VMIN 0 and VTIME 0 alone
        std::array<std::uint8_t, 8> room{};

        const auto chunk = tty.read(room);

        ASSERT_TRUE(chunk) << chunk.error().message();
        EXPECT_TRUE(chunk->octets.empty());
    }
}

TEST(TtyRead, GivesEveryOctetValueOnce)
{
    for (const TtySettings& settings : {kBusLine, kDriveLine}) {
        Pty cable;
        Tty tty = opened(cable.path(), settings);
        std::vector<std::uint8_t> every(256);
        std::iota(every.begin(), every.end(), std::uint8_t{0});

        cable.send(every);

        std::vector<std::uint8_t> got;
        std::array<std::uint8_t, 100> room{};
        while (got.size() < every.size() && tty.wait_readable(1s)) {
            const auto chunk = tty.read(room);
            ASSERT_TRUE(chunk);
            EXPECT_FALSE(chunk->bad_character);
            got.insert(got.end(), chunk->octets.begin(), chunk->octets.end());
        }
        EXPECT_EQ(got, every);
    }
}

TEST(TtyRead, SaysThatThereIsMoreUntilAllWasGiven)
{
    for (const TtySettings& settings : {kBusLine, kDriveLine}) {
        Pty cable;
        Tty tty = opened(cable.path(), settings);
        cable.send({1, 2, 3, 4, 5});
        ASSERT_TRUE(tty.wait_readable(1s));
        std::array<std::uint8_t, 3> room{};

        const auto first = tty.read(room);
        ASSERT_TRUE(first);
        EXPECT_THAT(copy(*first), ElementsAre(1, 2, 3));
        EXPECT_TRUE(first->more);

        const auto second = tty.read(room);
        ASSERT_TRUE(second);
        EXPECT_THAT(copy(*second), ElementsAre(4, 5));
        EXPECT_FALSE(second->more);
    }
}

/// Its edge says once that octets are there: what is left in the kernel would wait for the next ones.
TEST(TtyRead, SaysThatThereIsMoreUntilNothingIsLeftInTheKernelEither)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    const std::vector<std::uint8_t> sent(1500, 0x55);
    cable.send(sent);
    ASSERT_TRUE(tty.wait_readable(1s));
    std::array<std::uint8_t, 512> room{};
    std::size_t got = 0;
    for (bool more = true; more;) {
        const auto chunk = tty.read(room);
        ASSERT_TRUE(chunk);
        got += chunk->octets.size();
        more = chunk->more;
    }

    EXPECT_EQ(got, sent.size());
}

TEST(TtyRead, OctetsThatWereReadAheadCountAsReadable)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    cable.send({1, 2});
    ASSERT_TRUE(tty.wait_readable(1s));
    std::array<std::uint8_t, 1> room{};

    ASSERT_TRUE(tty.read(room));

    EXPECT_TRUE(tty.wait_readable(0s));
}

TEST(TtyRead, AfterDiscardingNothingOldComes)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    std::array<std::uint8_t, 1> room{};
    cable.send({1, 2, 3});
    ASSERT_TRUE(tty.wait_readable(1s));
    ASSERT_TRUE(tty.read(room)); // 2 and 3 are read ahead
    cable.send({4});

    ASSERT_FALSE(tty.discard_input());
    cable.send({9});
    ASSERT_TRUE(tty.wait_readable(1s));

    const auto chunk = tty.read(room);
    ASSERT_TRUE(chunk);
    EXPECT_THAT(copy(*chunk), ElementsAre(9));
}

TEST(TtyRead, AHangUpIsAnErrorAndNotSilence)
{
    for (const TtySettings& settings : {kBusLine, kDriveLine}) {
        Pty cable;
        Tty tty = opened(cable.path(), settings);
        std::array<std::uint8_t, 8> room{};

        EXPECT_FALSE(tty.hung_up());
        cable.hang_up();

        ASSERT_TRUE(tty.wait_readable(1s));
        EXPECT_TRUE(tty.hung_up());
        const auto chunk = tty.read(room);
        ASSERT_FALSE(chunk);
        EXPECT_EQ(chunk.error(), std::errc::io_error);
        EXPECT_TRUE(tty.write(std::vector<std::uint8_t>{1}));
    }
}

TEST(TtyWrite, AnEndThatTakesNothingIsGivenUpAfterABoundedTime)
{
    Pty cable;
    Tty tty = opened(cable.path(), {.baud = 1'500'000});
    const std::vector<std::uint8_t> telegram(255, 0x55);

    std::error_code error;
    for (int i = 0; i < 1000 && !error; ++i) error = tty.write(telegram); // not read: the buffers fill up

    EXPECT_EQ(error, std::errc::timed_out);
}

TEST(TtyWrite, GoesOnAsSoonAsTheOtherEndTakesAgain)
{
    Pty cable;
    Tty tty = opened(cable.path(), {.baud = 1'500'000});
    const std::vector<std::uint8_t> telegram(255, 0x55);
    while (!tty.write(telegram)) {
    }

    for (int i = 0; i < 100; ++i) static_cast<void>(cable.received());

    EXPECT_FALSE(tty.write(telegram));
}

TEST(TtySend, ATelegramThatDoesNotFitIsThrownAwayWholeAndWithoutWaiting)
{
    Pty cable;
    Tty tty = opened(cable.path(), {.baud = 9600});
    const std::vector<std::uint8_t> telegram(255, 0x55);

    std::error_code error;
    for (int i = 0; i < 1000 && !error; ++i) error = tty.send(telegram); // not read: the buffers fill up

    EXPECT_EQ(error, std::errc::no_buffer_space);
}

TEST(TtyBaud, IsChangedAndWhatCameBeforeIsThrownAway)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    std::array<std::uint8_t, 4> room{};
    cable.send({1, 2, 3, 4, 0xFF, 6});
    ASSERT_TRUE(tty.wait_readable(1s));
    ASSERT_TRUE(tty.read(room)); // FF and 6 are read ahead

    for (const Baud baud : kBauds) {
        cable.send({7});
        EXPECT_EQ(tty.set_baud(static_cast<std::uint32_t>(baud)), std::nullopt);

        EXPECT_EQ(cable.rate(), static_cast<std::uint32_t>(baud));
        EXPECT_FALSE(tty.wait_readable(0s));
    }
    cable.send({9});
    ASSERT_TRUE(tty.wait_readable(1s));
    const auto chunk = tty.read(room);
    ASSERT_TRUE(chunk);
    EXPECT_THAT(copy(*chunk), ElementsAre(9));
}

TEST(TtyBaud, ChangeDoesNotWaitForOctetsThatAreNotTaken)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    const std::vector<std::uint8_t> telegram(255, 0x55);
    while (!tty.send(telegram)) {
    }

    EXPECT_EQ(tty.set_baud(500'000), std::nullopt);
    EXPECT_EQ(cable.rate(), 500'000U);
}

TEST(TtyBaud, ChangeOfAPortThatHasGoneIsRefusedWithASentence)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    cable.hang_up();

    // A pty keeps its settings longer than its line; a UART that has gone does not.
    const std::string trouble = tty.set_baud(9'600).value_or("check that");
    EXPECT_THAT(trouble, HasSubstr("check that"));
    std::array<std::uint8_t, 4> room{};
    EXPECT_FALSE(tty.read(room)) << "who sets the rate hears of the loss when it reads";
}

TEST(TtyBaud, APtyCanDoThemAllAndStaysAtItsOwn)
{
    Pty cable;
    Tty tty = opened(cable.path(), kBusLine);
    cable.send({1});

    const TtyBauds bauds = tty.bauds();

    EXPECT_TRUE(bauds.can.all());
    EXPECT_EQ(bauds.why_not, "");
    EXPECT_EQ(cable.rate(), kBusLine.baud);
    EXPECT_FALSE(tty.wait_readable(0s)) << "what came while it tried is noise";
}

TEST(TtyTransmitter, ADriverThatCannotReportItIsNotAskedAgain)
{
    Pty cable;
    const Tty tty = opened(cable.path(), kBusLine);

    EXPECT_EQ(tty.transmitter_empty(), std::nullopt);
    EXPECT_EQ(tty.transmitter_empty(), std::nullopt);
}

} // namespace
} // namespace dpslave::io
