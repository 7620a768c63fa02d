// SPDX-License-Identifier: Apache-2.0
// dpctl identify with the simulated drives, over a line with the timing of its rate, or over a bare pty.
// Only here: a search that opens and sets a tty again and again, and Ctrl-C.
#include "gateway.hpp"
#include "support/gpio_stand_in/chip.hpp"
#include "support/paths.hpp"

#include "dpslave/config/config.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <termios.h>
#include <unistd.h>

#include <optional>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A laptop at a line with one simulated drive or instrument.
class Laptop : public ::testing::Test {
protected:
    void line(unsigned baud, unsigned bits = 10)
    {
        line_.emplace(Arguments{program_path("dpsim"), "line", "--baud", std::to_string(baud), "--bits",
                                std::to_string(bits), "--a", port(), "--b", far_end()});
        ASSERT_TRUE(line_->says("ready"));
        baud_ = std::to_string(baud);
    }
    void drive(Arguments more)
    {
        Arguments command{program_path("dpsim"), "drive", "--port", far_end(), "--baud", baud_};
        command.insert(command.end(), more.begin(), more.end());
        drive_.emplace(command);
        ASSERT_TRUE(drive_->says("ready"));
    }
    std::string port() const { return folder_ / "near"; }
    std::string far_end() const { return folder_ / "far"; }

    Arguments command(Arguments more) const
    {
        Arguments all{program_path("dpctl"), "identify", port(), "--profiles",
                      source_path("config/profiles")};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    Json identify(Arguments more, int status)
    {
        more.emplace_back("--json");
        const Outcome ran = run(command(std::move(more)));
        EXPECT_EQ(ran.status, status) << ran.err;
        return Json::parse(ran.out, nullptr, false);
    }
    Json rule(const Json& answering, const std::string& name) const
    {
        for (const Json& one : answering.at("rules"))
            if (one.at("rule") == name) return one;
        return nullptr;
    }
    /// The blocks beside a bus, as dpslaved reads them.
    config::Config configured(const Json& said)
    {
        write_file(folder_ / "dpslaved.toml", "[bus]\nport = \"/dev/null-bus\"\ndirection = "
                                              "\"none\"\n\n[control]\noperator_group = \"root\"\n\n" +
                                                  said.at("config").get<std::string>());
        auto config = config::load_config(folder_ / "dpslaved.toml", source_path("config/profiles"));
        if (config) return *std::move(config);
        for (const auto& fault : config.error()) ADD_FAILURE() << to_string(fault);
        return {};
    }

    Folder folder_;
    std::optional<Process> line_, drive_;
    std::string baud_;
};

TEST_F(Laptop, FindsADriveAtAnotherRateAndTheRuleThatItsProfileDoesNotHave)
{
    line(19'200);
    drive({"--profile", "590", "--mnemonics", "ac", "--log"});

    const Json said = identify({"--baud", "9600,19200", "--unit", "00", "--protocol", "ei-ascii", "--tags",
                                "55-57", "--timeout", "0.3"},
                               0);

    const Json& one = said["answering"].at(0);
    EXPECT_EQ(one["baud"], 19200);
    EXPECT_EQ(one["format"], "7E1");
    EXPECT_EQ(one["identity"], ">0590");
    EXPECT_EQ(one["device"], nullptr) << "no manual says what it stands for";
    EXPECT_EQ(one["version"], ">0100");
    EXPECT_EQ(rule(one, "ac")["answering"], Json({55, 56, 57}));
    EXPECT_EQ(rule(one, "590plus")["denied"], Json({55, 56, 57}));
    EXPECT_EQ(one["best_rules"], Json({"ac"}));
    EXPECT_LE(said["asked"], said["most"]);
    const auto config = configured(said);
    ASSERT_EQ(config.stations.size(), 1U);
    EXPECT_EQ(config.lines[0].baud, 19'200U);
    EXPECT_EQ(config.stations[0].profile->mnemonics, drive::MnemonicRule::ac);
    drive_->send_line("stats");
    EXPECT_TRUE(drive_->says(" 0 writes,"));
    EXPECT_TRUE(drive_->ever_said("EE >01C7")) << "of a tag that was denied: not even EE was written";
}

TEST_F(Laptop, CountsTheTagsOfATable)
{
    line(38'400);
    drive({"--profile", "590", "--mnemonics", "pno"});
    write_file(folder_ / "own.csv", "tag,name,type\n55,A,INT\n56,B,INT\n57,C,INT\n119,D,INT\n");

    const Outcome ran = run(command({"--baud", "38400", "--format", "7E1", "--unit", "00", "--table",
                                     folder_ / "own.csv", "--timeout", "0.3"}));

    EXPECT_EQ(ran.status, 0) << ran.err;
    EXPECT_THAT(ran.out, AllOf(HasSubstr("ei-ascii unit 00 at 38.4 kbit/s, 7E1"),
                               HasSubstr("3 of 4 tags answer: 55-57; 1 denied: 119"),
                               HasSubstr("fits          rule pno"), HasSubstr("No profile has the rule pno"),
                               HasSubstr("FILL IN")));
    EXPECT_THAT(ran.err, HasSubstr("Ctrl-C ends it"));
}

TEST_F(Laptop, FindsTwoUnitsOfALine)
{
    line(38'400);
    drive({"--profile", "590", "--unit", "00", "03"});

    const Json said =
        identify({"--baud", "38400", "--format", "7E1", "--unit", "00,01,03", "--timeout", "0.3"}, 0);

    ASSERT_EQ(said["answering"].size(), 2U);
    EXPECT_EQ(said["answering"][1]["unit"], "03");
    EXPECT_EQ(configured(said).stations.size(), 2U);
}

TEST_F(Laptop, FindsAnInstrumentByModbus)
{
    line(9'600);
    drive({"--profile", "2408f", "--unit", "5"});

    const Json said = identify({"--baud", "9600", "--format", "7E1,8N1", "--unit", "05,5", "--tags",
                                "1,2,60000", "--timeout", "0.3"},
                               0);

    ASSERT_EQ(said["answering"].size(), 1U) << "05 and 5 are the same address";
    const Json& one = said["answering"].at(0);
    EXPECT_EQ(one["protocol"], "modbus-rtu");
    EXPECT_EQ(one["unit"], "5");
    EXPECT_EQ(one["rules"][0]["answering"], Json({1, 2}));
    EXPECT_EQ(configured(said).stations[0].unit.unit, 5);
}

TEST_F(Laptop, TakesAnEchoForNoDrive)
{
    line(38'400);
    drive({"--profile", "590", "--fault", "echo on", "--fault", "silence"});
    const Arguments narrow{"--baud", "38400", "--unit", "00,1", "--timeout", "0.1"};

    const Json silent = identify(narrow, 1);
    EXPECT_EQ(silent["answering"], Json::array());
    EXPECT_EQ(silent["echo"], true);

    drive_->send_line("ok");
    drive_->send_line("echo on");
    drive_->send_line("stats");
    ASSERT_TRUE(drive_->says(" reads"));
    const Json said = identify(narrow, 0);
    ASSERT_EQ(said["answering"].size(), 1U);
    EXPECT_EQ(configured(said).lines[0].echo, EchoMode::on);
}

TEST_F(Laptop, SaysThatNothingAnswers)
{
    line(9'600);

    const Outcome ran = run(command({"--baud", "9600,19200", "--unit", "00,1", "--timeout", "0.02"}));

    EXPECT_EQ(ran.status, 1);
    EXPECT_THAT(ran.out, AllOf(HasSubstr("Nothing answers"), HasSubstr("the options of this"),
                               Not(HasSubstr("[[line]]"))));
}

TEST_F(Laptop, LeavesThePortAsItWasAfterCtrlC)
{
    line(9'600);
    const int port_fd = ::open(port().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    ASSERT_GE(port_fd, 0);
    termios before{};
    ASSERT_EQ(::tcgetattr(port_fd, &before), 0);
    before.c_lflag |= ICANON;
    ASSERT_EQ(::cfsetspeed(&before, B57600), 0);
    ASSERT_EQ(::tcsetattr(port_fd, TCSANOW, &before), 0);
    const auto settings = [&] {
        termios now{};
        ::tcgetattr(port_fd, &now);
        return now;
    };

    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        Process searching{command({"--timeout", "0.1"})};
        ASSERT_TRUE(searching.says("Ctrl-C ends it"));
        EXPECT_TRUE(eventually([&] { return (settings().c_lflag & ICANON) == 0; }));
        EXPECT_EQ(searching.end(signal), 1);

        EXPECT_TRUE(searching.ever_said("ended by a signal"));
        const termios after = settings();
        EXPECT_EQ(after.c_lflag, before.c_lflag);
        EXPECT_EQ(after.c_cflag, before.c_cflag);
        EXPECT_EQ(::cfgetospeed(&after), static_cast<speed_t>(B57600));
    }
    ::close(port_fd);
}

TEST_F(Laptop, SwitchesTheDriverForEachQuestionAndReleasesItAtTheEnd)
{
    constexpr unsigned kLine = 5;
    stand_in::ChipFile chip{folder_ / "gpiochip0", "pl061"};
    line(38'400);
    const Arguments transceiver{"--direction", "gpio", "--gpio-chip", chip.path(),
                                "--gpio-line", "5",    "--timeout",   "0.05"};

    Process searching{command(transceiver), {{"LD_LIBRARY_PATH", built_path("tests/gpio_stand_in")}}};
    ASSERT_TRUE(searching.says("Ctrl-C ends it"));
    EXPECT_TRUE(eventually([&] { return chip.rises(kLine) >= 3; })) << "once for each question";
    EXPECT_EQ(searching.end(SIGINT), 1);

    EXPECT_FALSE(chip.high(kLine));
    EXPECT_FALSE(chip.is_taken(kLine));
}

TEST_F(Laptop, NamesADriverEnableThatIsNotThereAndAsksNothing)
{
    line(9'600);

    const Outcome ran =
        run(command({"--direction", "gpio", "--gpio-chip", folder_ / "none", "--gpio-line", "5"}));

    EXPECT_EQ(ran.status, 1);
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(ran.err, HasSubstr("none"));
}

} // namespace
} // namespace dpslave::test
