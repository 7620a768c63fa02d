// SPDX-License-Identifier: Apache-2.0
/// A port that vanishes and returns under its name. The moments are the test's own.
#include "pty.hpp"

#include "dpslave/io/port.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <optional>

namespace dpslave::io {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;
using testing::Optional;
using testing::StartsWith;

constexpr TtySettings kBus{.baud = 187'500, .mark_errors = true};
constexpr Instant kStart{1000s};

/// A name in /dev, whatever is plugged in there.
class Socket {
public:
    Socket()
    {
        std::string folder = fs::temp_directory_path() / "dpslave-port-XXXXXX";
        if (::mkdtemp(folder.data()) == nullptr)
            throw std::system_error{errno, std::system_category(), "mkdtemp"};
        folder_ = folder;
    }
    ~Socket() { fs::remove_all(folder_); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    std::string path() const { return folder_ / "port"; }
    Pty& plug()
    {
        cable_.emplace();
        fs::create_symlink(cable_->path(), path());
        return *cable_;
    }
    void pull()
    {
        fs::remove(path());
        cable_.reset();
    }

private:
    fs::path folder_;
    std::optional<Pty> cable_;
};

/// Opened, and then pulled and lost at kStart.
class LostPort : public testing::Test {
protected:
    LostPort()
    {
        socket.plug();
        auto opened = Port::open(socket.path(), kBus);
        if (!opened) throw std::runtime_error{opened.error()};
        port.emplace(*std::move(opened));
        socket.pull();
        port->lose(kStart);
    }

    /// It can be opened each time, and `give_up(now, is_first)` closes it at once.
    template <class GiveUp>
    void is_tried_less_and_less_often(GiveUp give_up)
    {
        socket.plug();
        Instant now = kStart;
        for (const auto wait : {500ms, 1000ms, 2000ms, 4000ms, 4000ms}) {
            ASSERT_EQ(port->next_try(), now + wait);
            now = port->next_try();
            ASSERT_TRUE(port->ready(now));
            give_up(now, wait == 500ms);
        }
    }

    Socket socket;
    std::optional<Port> port;
};

TEST(Port, IsOpenAndNeedsNoFurtherTry)
{
    Socket socket;
    socket.plug();

    auto port = Port::open(socket.path(), kBus);

    ASSERT_TRUE(port) << port.error();
    EXPECT_TRUE(port->is_open());
    EXPECT_EQ(port->next_try(), kNever);
    EXPECT_TRUE(port->ready(kStart));
    EXPECT_EQ(port->path(), socket.path());
    EXPECT_EQ(port->settings().baud, 187'500U);
}

TEST(Port, ThatIsNotThereIsRefusedAtTheStartWithTheSentenceOfTheTty)
{
    const auto port = Port::open("/dev/no-such-port", kBus);

    ASSERT_FALSE(port);
    EXPECT_THAT(port.error(), AllOf(StartsWith("/dev/no-such-port is not there"), HasSubstr("cable")));
}

TEST(Port, MadeClosedIsOpenedByTheFirstQuestion)
{
    Socket socket;
    Port port{socket.path(), kBus};
    EXPECT_FALSE(port.is_open());
    EXPECT_LE(port.next_try(), kStart);

    const Pty& cable = socket.plug();
    EXPECT_TRUE(port.ready(kStart));
    EXPECT_EQ(cable.rate(), 187'500U);
}

TEST_F(LostPort, IsTriedAgainAfterHalfASecondThenOneTwoAndAlwaysFour)
{
    EXPECT_FALSE(port->is_open());
    Instant now = kStart;
    for (const auto wait : {500ms, 1000ms, 2000ms, 4000ms, 4000ms, 4000ms}) {
        EXPECT_EQ(port->next_try(), now + wait);
        now = port->next_try();
        EXPECT_FALSE(port->ready(now));
    }
}

TEST_F(LostPort, SaysEachReasonOnceWhyItCannotBeOpenedAgain)
{
    EXPECT_EQ(port->take_trouble(), std::nullopt); // not tried yet
    EXPECT_FALSE(port->ready(port->next_try()));
    EXPECT_THAT(port->take_trouble(), Optional(StartsWith(socket.path() + " is not there")));
    EXPECT_EQ(port->take_trouble(), std::nullopt);
    EXPECT_FALSE(port->ready(port->next_try()));
    EXPECT_EQ(port->take_trouble(), std::nullopt); // the same

    fs::create_symlink("/dev/null", socket.path());
    EXPECT_FALSE(port->ready(port->next_try()));
    EXPECT_THAT(port->take_trouble(), Optional(HasSubstr("is no serial port")));
}

TEST_F(LostPort, ThatIsRefusedOnceItIsOpenIsTriedLessAndLessOften)
{
    is_tried_less_and_less_often([this](Instant now, bool is_first) {
        port->refuse(now, "its driver enable does not work");
        EXPECT_FALSE(port->is_open());
        EXPECT_EQ(port->take_trouble().has_value(), is_first);
    });
    ASSERT_TRUE(port->ready(port->next_try()));
    port->lose(kStart + 60s);

    EXPECT_EQ(port->next_try(), kStart + 60s + 500ms);
}

TEST_F(LostPort, IsNotTouchedBeforeItsTime)
{
    socket.plug();

    EXPECT_FALSE(port->ready(kStart + 500ms - 1ns));
    EXPECT_TRUE(port->ready(kStart + 500ms));
    EXPECT_EQ(port->next_try(), kNever);
}

TEST_F(LostPort, ThatCameBackBeginsItsWaitsAnew)
{
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(port->ready(port->next_try()));
    Pty& cable = socket.plug();
    ASSERT_TRUE(port->ready(port->next_try()));
    cable.send({5});
    std::array<std::uint8_t, 4> room{};
    ASSERT_TRUE(port->tty().wait_readable(1s));
    EXPECT_EQ(port->tty().read(room)->octets.size(), 1U);

    port->lose(kStart + 60s);
    EXPECT_EQ(port->next_try(), kStart + 60s + 500ms);
}

TEST_F(LostPort, ThatIsLostAgainAsSoonAsItIsOpenIsTriedLessAndLessOften)
{
    is_tried_less_and_less_often([this](Instant now, bool) { port->lose(now); });
}

TEST_F(LostPort, LostTwiceIsLostOnce)
{
    port->lose(kStart + 10s);

    EXPECT_EQ(port->next_try(), kStart + 500ms);
}

TEST_F(LostPort, ComesBackAtTheRateThatWasSetMeanwhile)
{
    EXPECT_EQ(port->set_baud(19'200), std::nullopt);
    const Pty& cable = socket.plug();
    ASSERT_TRUE(port->ready(kStart + 1s));

    EXPECT_EQ(cable.rate(), 19'200U);
    EXPECT_EQ(port->settings().baud, 19'200U);
}

TEST_F(LostPort, ComesBackAtTheRateThatItHadAtTheEnd)
{
    socket.plug();
    ASSERT_TRUE(port->ready(kStart + 1s));
    EXPECT_EQ(port->set_baud(500'000), std::nullopt);
    socket.pull();
    port->lose(kStart + 2s);
    const Pty& cable = socket.plug();
    ASSERT_TRUE(port->ready(kStart + 3s));

    EXPECT_EQ(cable.rate(), 500'000U);
}

TEST(Port, OfAnotherFirstWaitHasAllItsWaitsFromThat)
{
    Port port{"/dev/no-such-port", kBus, 1h};

    for (const auto wait : {1h, 2h, 4h, 8h, 8h}) {
        const Instant now = std::max(port.next_try(), kStart);
        EXPECT_FALSE(port.ready(now));
        EXPECT_EQ(port.next_try(), now + wait);
    }
}

} // namespace
} // namespace dpslave::io
