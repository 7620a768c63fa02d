// SPDX-License-Identifier: Apache-2.0
/// Another program changes the settings of the port of the bus, or of a drive line (H2): no octet is echoed
/// for long, no changed value reaches a drive, and the station comes back by itself.
#include "app/bus_bench.hpp"
#include "app/line/line_port.hpp"

#include <gmock/gmock.h>
#include <termios.h>

#include <functional>
#include <memory>
#include <string>

namespace dpslave::test {
namespace {

using ::test::Saps;
using ::test::sd2;
using testing::HasSubstr;

/// As `stty -F PORT` does.
void change_settings(const std::string& port, const std::function<void(termios&)>& how)
{
    const io::Fd other{::open(port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    termios settings{};
    ASSERT_EQ(::tcgetattr(other.get(), &settings), 0);
    how(settings);
    ASSERT_EQ(::tcsetattr(other.get(), TCSANOW, &settings), 0);
}

class ChangedBusPort : public OnABus {
protected:
    /// In Data_Exch; the first parameter is an output, behind the four words of Demand Data.
    void start_with_an_output()
    {
        ASSERT_EQ(master.ask(set_prm(kStation, master.next_fc())), Octets{0xE5});
        Octets identifiers(1 + kInputs, 0x50);
        identifiers[0] = 0x73;
        identifiers[1] = 0x60;
        ASSERT_EQ(master.ask(sd2(kStation, 2, master.next_fc(), Saps{62, 62}, identifiers)), Octets{0xE5});
        app::StationLink& station = *links[kStation];
        const auto has_layout = [&station] {
            return station.outputs.fresh() && station.outputs.latest().layout.generation != 0;
        };
        ASSERT_TRUE(eventually(has_layout));
        InputImage inputs;
        inputs.generation = station.outputs.latest().layout.generation;
        inputs.every_input_tried = true;
        station.inputs.publish(inputs);
        ASSERT_TRUE(master.ask(with_output(0x0102, master.next_fc())));
        ASSERT_TRUE(eventually([&] { return newest_output() == 0x0102; }));
    }
    Octets with_output(std::uint16_t word, std::uint8_t fc) const
    {
        Octets data(8, 0x00);
        data.push_back(static_cast<std::uint8_t>(word >> 8));
        data.push_back(static_cast<std::uint8_t>(word & 0xFF));
        return sd2(kStation, 2, fc, data);
    }
    std::uint16_t newest_output()
    {
        app::StationLink& station = *links[kStation];
        static_cast<void>(station.outputs.fresh());
        return station.outputs.latest().words[0];
    }
    /// What was changed, as it is told; empty: nothing is told.
    std::string told()
    {
        std::string words;
        const bool is_told = eventually([&] {
            const auto changed = link.settings_changed.pop();
            if (changed) words = changed->words.data();
            return changed.has_value();
        });
        return is_told ? words : "";
    }
    std::uint64_t departures()
    {
        app::StationLink& station = *links[kStation];
        static_cast<void>(station.bus_snapshot.fresh());
        return station.bus_snapshot.latest().counters.left_data_exchange;
    }
};

TEST_F(ChangedBusPort, ThatStripsABitOfOctetAndChecksumPassesNoWordOn)
{
    // With ISTRIP the telegram still fits: the only octets with bit 7 are one of the output and the checksum.
    start({.direction = io::Direction::none}, {station(kStation)});
    for (int round = 0; round < 5; ++round) {
        start_with_an_output();
        const Generation generation = links[kStation]->outputs.latest().layout.generation;
        const std::uint8_t fc = master.next_fc();
        constexpr std::uint16_t kWord = 0xDC40;
        ASSERT_NE(with_output(kWord, fc).rbegin()[1] & 0x80, 0) << "the checksum loses the same bit";

        change_settings(pty.path(), [](termios& t) { t.c_iflag |= ISTRIP; });
        master.ask(with_output(kWord, fc), 1);

        bool is_passed_on = false;
        ASSERT_TRUE(eventually([&] {
            is_passed_on = is_passed_on || newest_output() == (kWord & 0x7F7F);
            return links[kStation]->ended.load() == generation;
        }));
        EXPECT_FALSE(is_passed_on);
        EXPECT_THAT(told(), HasSubstr("ISTRIP is on"));
        ASSERT_TRUE(asked_until(fdl_status(kStation), [&] { return true; })) << "and it comes back";
    }
    EXPECT_TRUE(eventually([this] { return snapshot().settings_changed >= 5; }));
}

TEST_F(ChangedBusPort, ThatEchoesIsSilentAgainWithTheNextTick)
{
    start({.direction = io::Direction::none}, {station(kStation)});
    start_with_an_output();

    change_settings(pty.path(), [](termios& t) { // stty sane
        t.c_iflag |= BRKINT | ICRNL | IMAXBEL;
        t.c_oflag |= OPOST | ONLCR;
        t.c_lflag |= ISIG | ICANON | IEXTEN | ECHO | ECHOE | ECHOK;
    });

    EXPECT_THAT(told(), HasSubstr("ECHO is on"));
    pty.received();
    const Octets foreign = sd2(9, 2, 0x6D, Octets(8, 0x0A));
    pty.send(foreign);
    EXPECT_TRUE(eventually([&] { return snapshot().counters.octets >= foreign.size(); }));
    EXPECT_TRUE(pty.received().empty()) << "a telegram of another station was sent back";
    start_with_an_output();
}

TEST_F(ChangedBusPort, ThatHarmsNoOctetIsSetAgainWhileTheStationStays)
{
    start({.direction = io::Direction::none}, {station(kStation)});
    start_with_an_output();

    for (int round = 1; round <= 10; ++round) {
        change_settings(pty.path(), [](termios& t) { t.c_cc[VMIN] = 1; });
        EXPECT_THAT(told(), HasSubstr("VMIN"));
        ASSERT_TRUE(master.ask(with_output(0x0103, master.next_fc())));
    }

    EXPECT_EQ(newest_output(), 0x0103);
    EXPECT_EQ(departures(), 0U);
}

/// The line is open, and another program may change it.
class ChangedLinePort : public testing::Test {
protected:
    ChangedLinePort() { line.port = cable.path(); }

    std::string told()
    {
        const auto one = link.happenings.take();
        return one ? std::string{one->text.data()} : "";
    }

    io::Pty cable;
    config::LineConfig line;
    app::LineLink link;
    app::LinePort port{false, app::listeners_of(link)};
};

TEST_F(ChangedLinePort, IsNotBelievedAfterAChangeThatHarmsOctetsAndIsSetAgain)
{
    ASSERT_TRUE(port.open(line));
    EXPECT_TRUE(port.settings_hold(line));
    change_settings(cable.path(), [](termios& t) { t.c_iflag |= ISTRIP; });

    EXPECT_FALSE(port.settings_hold(line));

    EXPECT_TRUE(port.settings_hold(line));
    EXPECT_EQ(link.settings_changed.load(), 1U);
    ASSERT_TRUE(link.changed_settings.fresh());
    EXPECT_THAT(link.changed_settings.latest().words.data(), HasSubstr("ISTRIP is on"));
}

TEST_F(ChangedLinePort, IsBelievedAfterAChangeThatHarmsNothing)
{
    ASSERT_TRUE(port.open(line));
    change_settings(cable.path(), [](termios& t) { t.c_cflag ^= CLOCAL; });

    EXPECT_TRUE(port.settings_hold(line));

    EXPECT_EQ(link.settings_changed.load(), 1U);
    termios now{};
    const io::Fd other{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    ASSERT_EQ(::tcgetattr(other.get(), &now), 0);
    EXPECT_NE(now.c_cflag & CLOCAL, 0U);
}

} // namespace
} // namespace dpslave::test
