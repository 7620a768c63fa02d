// SPDX-License-Identifier: Apache-2.0
/// Another program changes the settings of an open port (H2): it is seen, said and set right. On ptys, which
/// keep all flags; rate and format of a real UART are those of the virtual machine (tools/run machine-amd64).
#include "pty.hpp"

#include "dpslave/io/tty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <termios.h>

#include <functional>
#include <string>
#include <vector>

namespace dpslave::io {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr TtySettings kBus{.baud = 187'500, .mark_errors = true};

/// As `stty -F PORT` does: opens it, changes something, closes it.
void change(const std::string& path, const std::function<void(termios&)>& how)
{
    const Fd other{::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    termios settings{};
    ASSERT_EQ(::tcgetattr(other.get(), &settings), 0);
    how(settings);
    ASSERT_EQ(::tcsetattr(other.get(), TCSANOW, &settings), 0);
}

struct OpenPort {
    Pty cable;
    Tty tty = *Tty::open(cable.path(), kBus);
};

struct Change {
    const char* words;
    bool harms;
    std::function<void(termios&)> how;
};

std::vector<Change> changes()
{
    const auto input = [](tcflag_t flag) { return [flag](termios& t) { t.c_iflag ^= flag; }; };
    const auto local = [](tcflag_t flag) { return [flag](termios& t) { t.c_lflag ^= flag; }; };
    const auto control = [](tcflag_t flag) { return [flag](termios& t) { t.c_cflag ^= flag; }; };
    return {
        {"ISTRIP is on", true, input(ISTRIP)},
        {"INLCR is on", true, input(INLCR)},
        {"IGNCR is on", true, input(IGNCR)},
        {"ICRNL is on", true, input(ICRNL)},
        {"IUCLC is on", true, input(IUCLC)},
        {"IXON is on", true, input(IXON)},
        {"IXOFF is on", true, input(IXOFF)},
        {"PARMRK is off", true, input(PARMRK)},
        {"INPCK is off", true, input(INPCK)},
        {"IGNPAR is on", true, input(IGNPAR)},
        {"IGNBRK is on", true, input(IGNBRK)},
        {"ECHO is on", true, local(ECHO)},
        {"ICANON is on", true, local(ICANON)},
        {"ISIG is on", true, local(ISIG)},
        {"IEXTEN is on", true, local(IEXTEN)},
        {"OPOST is on, ONLCR is on", true, [](termios& t) { t.c_oflag |= OPOST | ONLCR; }},
        {"2400 instead of 187500 bit/s", true,
         [](termios& t) {
             ::cfsetispeed(&t, B2400);
             ::cfsetospeed(&t, B2400);
         }},
        {"ONLCR is on", false, [](termios& t) { t.c_oflag |= ONLCR; }}, // without OPOST
        {"ECHOE is on", false, local(ECHOE)},
        {"IUTF8 is on", false, input(IUTF8)},
        {"HUPCL is off", false, control(HUPCL)},
        {"CLOCAL is off", false, control(CLOCAL)},
        {"CRTSCTS is on", false, control(CRTSCTS)},
        {"VMIN or VTIME", false, [](termios& t) { t.c_cc[VMIN] = 1; }},
    };
}

TEST(ChangedSettings, AreNoneWhileNobodyHasChangedThem)
{
    OpenPort port;

    EXPECT_FALSE(port.tty.changed_settings());

    ASSERT_FALSE(port.tty.set_baud(19'200));
    EXPECT_FALSE(port.tty.changed_settings()) << "the rate is the program's own";
    static_cast<void>(port.tty.bauds());
    EXPECT_FALSE(port.tty.changed_settings());
    port.cable.hang_up();
    EXPECT_FALSE(port.tty.changed_settings()) << "read() says that it has gone";
}

TEST(ChangedSettings, AreNamedAndJudgedByWhatTheyDoToOctets)
{
    for (const Change& one : changes()) {
        OpenPort port;

        change(port.cable.path(), one.how);

        const auto changed = port.tty.changed_settings();
        ASSERT_TRUE(changed) << one.words;
        EXPECT_THAT(changed->words.data(), HasSubstr(one.words));
        EXPECT_EQ(changed->harms_octets, one.harms) << one.words;
    }
}

TEST(ChangedSettings, AreSetAgain)
{
    for (const Change& one : changes()) {
        OpenPort port;
        termios before{}, after{};
        ASSERT_EQ(::tcgetattr(port.tty.fd(), &before), 0);
        change(port.cable.path(), one.how);
        const auto changed = port.tty.changed_settings();
        ASSERT_TRUE(changed);

        EXPECT_FALSE(port.tty.set_again(*changed));

        EXPECT_FALSE(port.tty.changed_settings()) << one.words;
        ASSERT_EQ(::tcgetattr(port.tty.fd(), &after), 0);
        EXPECT_EQ(after.c_iflag, before.c_iflag) << one.words;
        EXPECT_EQ(after.c_oflag, before.c_oflag) << one.words;
        EXPECT_EQ(after.c_cflag, before.c_cflag) << one.words;
        EXPECT_EQ(after.c_lflag, before.c_lflag) << one.words;
        EXPECT_EQ(port.cable.rate(), 187'500U) << one.words;
    }
}

TEST(ChangedSettings, ThatHarmOctetsTakeWhatHasComeWithThem)
{
    OpenPort port;
    change(port.cable.path(), [](termios& t) { t.c_iflag |= ISTRIP; });
    port.cable.send({0xDC, 0x82});
    const auto changed = port.tty.changed_settings();
    ASSERT_TRUE(changed && changed->harms_octets);

    ASSERT_FALSE(port.tty.set_again(*changed));
    port.cable.send({0x10});

    std::array<std::uint8_t, 8> buffer{};
    const auto chunk = port.tty.read(buffer);
    ASSERT_TRUE(chunk);
    EXPECT_THAT(std::vector<std::uint8_t>(chunk->octets.begin(), chunk->octets.end()), ElementsAre(0x10));
}

TEST(ChangedSettings, ThatHarmNothingLeaveWhatHasCome)
{
    OpenPort port;
    port.cable.send({0xDC, 0x82});
    change(port.cable.path(), [](termios& t) { t.c_cflag ^= CLOCAL; });
    const auto changed = port.tty.changed_settings();
    ASSERT_TRUE(changed && !changed->harms_octets);

    ASSERT_FALSE(port.tty.set_again(*changed));

    std::array<std::uint8_t, 8> buffer{};
    const auto chunk = port.tty.read(buffer);
    ASSERT_TRUE(chunk);
    EXPECT_THAT(std::vector<std::uint8_t>(chunk->octets.begin(), chunk->octets.end()),
                ElementsAre(0xDC, 0x82));
}

TEST(ChangedSettings, OfManyAreSaidAsFarAsThereIsRoom)
{
    OpenPort port;

    change(port.cable.path(), [](termios& t) {
        t.c_iflag = ~t.c_iflag & 0x7FFF;
        t.c_lflag = ~t.c_lflag & 0xFFFF;
        t.c_oflag = ~t.c_oflag & 0xFFFF;
    });

    const auto changed = port.tty.changed_settings();
    ASSERT_TRUE(changed && changed->harms_octets);
    const std::string words = changed->words.data(); // it has an end
    EXPECT_THAT(words, HasSubstr("ISTRIP is on"));
    EXPECT_LT(words.size(), changed->words.size());
}

} // namespace
} // namespace dpslave::io
