// SPDX-License-Identifier: Apache-2.0
// dpctl identify: what it says of a search, its blocks as the daemon reads them, and the program at ports
// that do not answer. With drives: tests/system/identify_test.cpp.
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/identify/identify_port.hpp"
#include "dpctl/identify/identify_report.hpp"
#include "io/pty.hpp"
#include "profile/files.hpp"
#include "support/paths.hpp"

#include "dpslave/config/config.hpp"
#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>
#include <grp.h>
#include <sys/file.h>
#include <sys/stat.h>

namespace dpslave::test {
namespace {

using namespace dpslave::dpctl;
using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using Ran = test::Ran;

const std::string kProfiles = source_path("config/profiles");

std::vector<profile::Profile> shipped()
{
    std::vector<profile::Profile> all;
    for (const std::string& name : io::names_in(kProfiles, ".toml"))
        all.push_back(*profile::load_profile(io::read_regular_file, kProfiles, name));
    return all;
}

report::Answering ei_drive(const std::string& unit = "00")
{
    report::Answering one{.protocol = "ei-ascii", .baud = 19200, .format = "7E1", .unit = unit};
    one.identity = ">2650";
    one.version = ">0304";
    one.device = "650V, frames C to F";
    one.rules = {{.rule = "590plus", .answering = {55}, .denied = {56, 57}},
                 {.rule = "ac", .answering = {55, 56, 57}},
                 {.rule = "pno", .denied = {55}, .nameless = 2}};
    one.best_rules = {"ac"};
    return one;
}

Identified found(std::vector<report::Answering> answering)
{
    Identified all{.port = "/dev/ttyUSB0"};
    all.asked = 57;
    all.most = 2000;
    all.took = 9s;
    all.timeout = 200ms;
    all.answering = std::move(answering);
    all.profiles = shipped();
    return all;
}

// ---- what it says

TEST(Identify, SaysWhatAnswersAndUnderWhichRuleWhichTags)
{
    const std::string out = render_identified(found({ei_drive()}), {});

    EXPECT_THAT(out, AllOf(HasSubstr("/dev/ttyUSB0: 57 questions in 9 s\n"),
                           HasSubstr("ei-ascii unit 00 at 19.2 kbit/s, 7E1\n"),
                           HasSubstr(">2650 (650V, frames C to F)"), HasSubstr(">0304")));
    EXPECT_THAT(out, AllOf(HasSubstr("rule 590plus  1 of 3 tags answer: 55; 2 denied: 56, 57"),
                           HasSubstr("3 of 3 tags answer: 55-57"),
                           HasSubstr("0 of 1 tag answer; 1 denied: 55; 2 without a mnemonic under this"),
                           HasSubstr("fits          rule ac")));
}

TEST(Identify, SaysWhatItCouldNotFindOut)
{
    report::Answering one = ei_drive();
    one.identity.reset();
    one.version.reset();
    one.best_rules = {"ac", "pno"};
    Identified all = found({one});
    EXPECT_THAT(not_found_out(all),
                AllOf(Contains(HasSubstr("it gives no II")), Contains(HasSubstr("it gives no V0")),
                      Contains(HasSubstr("as many tags answer under ac and pno"))));

    one = ei_drive();
    one.device.reset();
    one.best_rules.clear();
    all = found({one});
    all.end = SearchEnd::interrupted;
    EXPECT_THAT(not_found_out(all), AllOf(Contains(HasSubstr("no manual says what II >2650 stands for")),
                                          Contains(HasSubstr("no tag answers under any")),
                                          Contains(HasSubstr("57 of at most 2000 were asked"))));
    EXPECT_THAT(not_found_out(all), Contains(HasSubstr("PROFIBUS address")));
}

TEST(Identify, WithoutAnAnswerSaysWhatWasLeftOutAndPrintsNoBlocks)
{
    Identified all = found({});
    all.not_asked = {"Modbus units above 32: name one with --unit"};
    all.damaged = 3;
    all.hears_itself = true;
    const std::string out = render_identified(all, {});

    EXPECT_THAT(out, AllOf(HasSubstr("Nothing answers"), HasSubstr("Modbus units above 32"),
                           HasSubstr("after 3 questions came octets"), HasSubstr("hears what it sends")));
    EXPECT_THAT(out, Not(HasSubstr("[[line]]")));
}

TEST(Identify, PrintsTheSameAsJson)
{
    const Json json = identified_json(found({ei_drive()}));

    EXPECT_EQ(json["end"], "complete");
    EXPECT_EQ(json["answering"][0]["best_rules"], Json({"ac"}));
    EXPECT_EQ(json["answering"][0]["rules"][0]["denied"], Json({56, 57}));
    EXPECT_THAT(json["config"].get<std::string>(), HasSubstr("[[station]]"));
}

// ---- the blocks

class Blocks : public testing::Test {
protected:
    config::Config read(const Identified& all) const
    {
        const std::string text = "[bus]\nport = \"/dev/null-bus\"\ndirection = \"none\"\n\n[control]\n"
                                 "operator_group = \"root\"\n\n" +
                                 config_blocks(all);
        auto config = config::load_config(folder_.write("dpslaved.toml", text), kProfiles);
        if (config) return *std::move(config);
        for (const auto& fault : config.error()) ADD_FAILURE() << to_string(fault) << '\n' << text;
        return {};
    }
    Folder folder_;
};

TEST_F(Blocks, AreReadByTheDaemonAndSayWhatIsToBeFilledIn)
{
    Identified all = found({ei_drive(), ei_drive("0A")});
    all.port = R"(/dev/a "b\c)";
    all.hears_itself = true;
    all.timeout = 500ms;
    const auto config = read(all);

    ASSERT_EQ(config.lines.size(), 1U);
    EXPECT_EQ(config.lines[0].port, all.port);
    EXPECT_EQ(config.lines[0].baud, 19200U);
    EXPECT_EQ(config.lines[0].format, (config::LineFormat{7, 'E', 1}));
    EXPECT_EQ(config.lines[0].echo, EchoMode::on);
    EXPECT_EQ(config.lines[0].timeout, 500ms);
    ASSERT_EQ(config.stations.size(), 2U);
    EXPECT_EQ(config.stations[1].unit, (drive::UnitAddress{0, 10}));
    EXPECT_NE(config.stations[0].address, config.stations[1].address);
    EXPECT_EQ(config.stations[0].profile->mnemonics, drive::MnemonicRule::ac) << "the rule that fits";
    EXPECT_THAT(config_blocks(all),
                AllOf(HasSubstr("FILL IN: its PROFIBUS address"),
                      HasSubstr("FILL IN: the profile of this drive. These fit: 584sv, ")));
}

TEST_F(Blocks, PreferAProfileWhoseRuleIsNotAssumed)
{
    report::Answering one = ei_drive();
    one.best_rules = {"590plus"};

    EXPECT_THAT(config_blocks(found({one})), HasSubstr("These fit: 590plus, 584s, 590, 620"));
    EXPECT_FALSE(read(found({one})).stations[0].profile->mnemonics_assumed);
}

TEST_F(Blocks, OfARuleThatNoProfileHasSaySo)
{
    report::Answering one = ei_drive();
    one.best_rules = {"pno"};

    EXPECT_EQ(read(found({one})).stations.size(), 1U);
    EXPECT_THAT(config_blocks(found({one})), HasSubstr("No profile has the rule pno"));
}

TEST_F(Blocks, OfAnInstrumentNameAProfileOfModbusAndAnIdentToFillIn)
{
    const report::Answering one{.protocol = "modbus-rtu", .baud = 9600, .format = "8N1", .unit = "17"};
    const auto config = read(found({one}));

    ASSERT_EQ(config.stations.size(), 1U);
    EXPECT_EQ(config.lines[0].protocol, config::kModbusRtu);
    EXPECT_EQ(config.stations[0].unit.unit, 17);
    EXPECT_THAT(config_blocks(found({one})),
                AllOf(HasSubstr("These fit: 2404f, 2408f"), HasSubstr("FILL IN: Ident_Number")));
}

TEST_F(Blocks, HaveTheTransceiverThatWasUsed)
{
    Identified all = found({ei_drive()});
    all.driver = {
        .direction = io::Direction::gpio, .gpio_chip = "/dev/gpiochip0", .gpio_line = 18, .active_low = true};

    EXPECT_EQ(read(all).lines[0].driver_enable, all.driver);
    all.driver = {.direction = io::Direction::rts};
    EXPECT_EQ(read(all).lines[0].driver_enable, all.driver);
}

TEST_F(Blocks, NameTheTableThatWasAskedFor)
{
    Identified all = found({ei_drive()});
    all.table = source_path("config/tags/example.csv");

    EXPECT_EQ(read(all).stations[0].tag_file, all.table);
}

// ---- the port

TEST(IdentifyPort, SaysWhatToDoAboutEachTrouble)
{
    const auto words = [](std::errc why) { return port_sentence("/dev/ttyX", std::make_error_code(why)); };

    EXPECT_THAT(words(std::errc::no_such_file_or_directory), HasSubstr("is not there: plug the adapter in"));
    EXPECT_THAT(words(std::errc::permission_denied), HasSubstr("no group may: use sudo"));
    EXPECT_THAT(words(std::errc::device_or_resource_busy), HasSubstr("`fuser /dev/ttyX`"));
    EXPECT_THAT(words(std::errc::inappropriate_io_control_operation), HasSubstr("no serial port"));
}

TEST(IdentifyPort, NamesTheGroupThatMayOpenIt)
{
    const Folder folder;
    const std::string port = folder.write("port", "");
    std::filesystem::permissions(port, std::filesystem::perms{0660});
    struct stat what {};
    ASSERT_EQ(::stat(port.c_str(), &what), 0);
    const group* const owner = ::getgrgid(what.st_gid);
    const std::string name = owner != nullptr ? owner->gr_name : std::to_string(what.st_gid);

    EXPECT_THAT(port_sentence(port, std::make_error_code(std::errc::permission_denied)),
                HasSubstr("`sudo usermod -aG " + name + " $USER`"));
}

TEST(DpctlIdentify, TakesItsPortBehindTheOptions)
{
    EXPECT_THAT(
        test::dpctl({"identify", "--baud", "9600,19200", "--unit", "00", "--rule", "ac", "/nonexistent"}).err,
        HasSubstr("/nonexistent is not there"));
}

TEST(DpctlIdentify, EndsWith1AtAPortThatCannotBeUsed)
{
    const Ran missing = test::dpctl({"identify", "/nonexistent/tty"});
    EXPECT_EQ(missing.exit, 1);
    EXPECT_EQ(missing.out, "");
    EXPECT_THAT(missing.err, HasSubstr("dpctl: /nonexistent/tty is not there"));

    const io::Pty cable;
    const io::Fd other{::open(cable.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    ASSERT_EQ(::flock(other.get(), LOCK_EX | LOCK_NB), 0);
    EXPECT_THAT(test::dpctl({"identify", cable.path()}).err, HasSubstr("is used by another program"));
}

TEST(DpctlIdentify, EndsWith2WhereNothingIsLeftToBeAsked)
{
    EXPECT_EQ(test::dpctl({"identify", "x", "--protocol", "modbus-rtu", "--format", "7E1"}).exit, 2);
    EXPECT_EQ(test::dpctl({"identify", "x", "--protocol", "modbus-rtu", "--unit", "0A"}).exit, 2);
    EXPECT_EQ(test::dpctl({"identify", "x", "--table", "/nonexistent.csv"}).exit, 2);
}

TEST(DpctlIdentify, AtALineWithoutADriveSaysSoAndEndsWith1)
{
    const io::Pty cable;
    const Ran ran = test::dpctl({"identify", cable.path(), "--baud", "9600", "--format", "7E1,8N1", "--unit",
                                 "05", "--timeout", "0.01", "--json"});

    EXPECT_EQ(ran.exit, 1) << ran.err;
    const Json json = Json::parse(ran.out);
    EXPECT_EQ(json["asked"], 3) << "7E1 and 8N1 of EI-ASCII, 8N1 of Modbus";
    EXPECT_EQ(json["end"], "complete");
    EXPECT_EQ(json["answering"], Json::array());
    EXPECT_EQ(json["config"], "");
    EXPECT_THAT(ran.err, HasSubstr("Ctrl-C ends it"));
}

} // namespace
} // namespace dpslave::test
