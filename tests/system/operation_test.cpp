// SPDX-License-Identifier: Apache-2.0
// The operation of the gateway: dpctl, its exit codes, and the two lamps.
// Only here: a program with its exit status, a socket, and the files of the lamps.
#include "gateway.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dpslave::test {
namespace {

using ::testing::HasSubstr;

TEST(Dpctl, ReportsWithItsExitCodeWhetherDataIsExchanged)
{
    Gateway gateway;
    EXPECT_TRUE(gateway.exchange_ends_with(1));
    {
        Master master{gateway, {"--tags", "55"}};
        ASSERT_TRUE(master.does("start 60s"));
        EXPECT_TRUE(gateway.exchange_ends_with(0));
        EXPECT_TRUE(gateway.exchange_ends_with(0, "unwinder"));
        EXPECT_TRUE(gateway.exchange_ends_with(0, "5"));
        EXPECT_TRUE(gateway.exchange_ends_with(2, "other"));
        EXPECT_TRUE(master.does("unlock"));
    }
    EXPECT_TRUE(gateway.exchange_ends_with(1));
}

TEST(Dpctl, EndsWithOneWhenRefusedTwoForUsageAndThreeWithoutDaemon)
{
    Gateway gateway;
    EXPECT_EQ(gateway.dpctl({"status"}).status, 0);
    EXPECT_EQ(gateway.dpctl({"io", "other"}).status, 2) << "there is no such station";
    EXPECT_EQ(gateway.dpctl({"no-such-command"}).status, 2);
    EXPECT_EQ(gateway.dpctl({"write", "56"}).status, 2);
    EXPECT_EQ(gateway.daemon().end(), 0);
    const Outcome without = gateway.dpctl({"status"});
    EXPECT_EQ(without.status, 3);
    EXPECT_THAT(without.err, HasSubstr(gateway.socket().string()));
    EXPECT_EQ(gateway.dpctl({"status", "--wait", "0", "--quiet"}).status, 3);
}

TEST(Dpctl, AnswersEachQuestionInWordsAndInJson)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    for (const char* const question : {"status", "show", "io", "diag", "counters", "version"}) {
        SCOPED_TRACE(question);
        const Outcome words = gateway.dpctl({question}), json = gateway.dpctl({"--json", question});
        EXPECT_EQ(words.status, 0);
        EXPECT_EQ(words.err, "");
        EXPECT_NE(words.out, "");
        EXPECT_EQ(json.status, 0);
        EXPECT_TRUE(Json::accept(json.out)) << json.out;
    }
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("590 with PROFIBUS-DP option board"));
}

TEST(Dpctl, ReadsAndWritesATagOfTheDriveInItsOwnUnits)
{
    Gateway gateway;
    const Outcome read = gateway.dpctl({"read", "62"});
    EXPECT_EQ(read.status, 0);
    EXPECT_THAT(read.out, HasSubstr("is 110.0"));

    EXPECT_EQ(gateway.dpctl({"write", "62", "95.5"}).status, 0);
    EXPECT_TRUE(gateway.drive().says("tag 62 written 95.5"));
    EXPECT_EQ(gateway.json({"read", "62"}).at("raw"), 955);
    EXPECT_EQ(gateway.dpctl({"write", "56", "-12.5"}).status, 0);
    EXPECT_TRUE(gateway.drive().says("tag 56 written -12.50"));

    EXPECT_EQ(gateway.dpctl({"write", "62", "200.1"}).status, 5) << "beyond its limit";
    EXPECT_EQ(gateway.dpctl({"write", "55", "1"}).status, 5) << "read only";
    EXPECT_EQ(gateway.dpctl({"read", "1999"}).status, 5) << "no such tag";
    EXPECT_EQ(gateway.dpctl({"read", "130"}).status, 5) << "text is not transported";
    gateway.drive().send_line("silence");
    const Outcome silent = gateway.dpctl({"read", "62"});
    EXPECT_EQ(silent.status, 4);
    EXPECT_THAT(silent.err, HasSubstr("does not answer"));
}

TEST(Dpctl, IsRefusedAValueOutsideTheLimitsForWrites)
{
    Gateway gateway{{.keys = "[station.write_limits]\n62 = [\"80.0\", \"110.0\"]\n"}};
    for (const char* const value : {"79.9", "110.1", "-80.0", "200.1"}) {
        const Outcome refused = gateway.dpctl({"write", "62", value});
        EXPECT_EQ(refused.status, 5) << value;
        EXPECT_THAT(refused.err, HasSubstr("takes 80.0 to 110.0, as [station.write_limits] says")) << value;
    }
    EXPECT_EQ(gateway.json({"read", "62"}).at("value"), "110.0") << "never changed to the limit";
    for (const char* const value : {"80.0", "110.0", "95.5"})
        EXPECT_EQ(gateway.dpctl({"write", "62", value}).status, 0) << value;
    EXPECT_EQ(gateway.dpctl({"write", "56", "-12.5"}).status, 0) << "a tag without limits";

    Master master{gateway, {"--tags", "62w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("out 1 = 1200"));
    EXPECT_TRUE(gateway.drive().says("tag 62 written 120.0")) << "the master is not limited";
}

TEST(Dpctl, WritesNothingWhileTheDaemonOnlyShows)
{
    Gateway gateway{{.profile = "605", .control_keys = "read_only = true\n"}};
    for (const Arguments& command :
         {Arguments{"write", "1", "5"}, {"write", "60000", "x"}, {"tec", "set", "RIDE_THROUGH", "1"}}) {
        const Outcome refused = gateway.dpctl(command);
        EXPECT_EQ(refused.status, 5);
        EXPECT_THAT(refused.err, HasSubstr("the daemon only shows"));
    }
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0) << "the way out of it";
}

TEST(Dpctl, EachWriteIsALineOfTheLogWithTheUserAndTheValueBefore)
{
    Gateway gateway;
    const std::string by = " by uid " + std::to_string(::geteuid()) + ", pid ";
    EXPECT_EQ(gateway.dpctl({"write", "62", "95.5"}).status, 0);
    EXPECT_TRUE(gateway.daemon().says("set to 95.5" + by));
    EXPECT_TRUE(gateway.daemon().ever_said(", before not known: done")) << "no master has chosen it";

    Master master{gateway, {"--tags", "62,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 955"));
    EXPECT_TRUE(gateway.word_becomes(62, "raw", 955));
    EXPECT_EQ(gateway.dpctl({"write", "62", "80.0"}).status, 0);
    EXPECT_TRUE(gateway.daemon().says("set to 80.0" + by));
    EXPECT_TRUE(gateway.daemon().ever_said(", before 95.5: done"));

    gateway.drive().send_line("silence");
    EXPECT_EQ(gateway.dpctl({"write", "62", "70.0"}).status, 4);
    EXPECT_TRUE(gateway.daemon().says("set to 70.0" + by));
    EXPECT_TRUE(gateway.daemon().ever_said(": no answer") || gateway.daemon().ever_said("does not answer"));
}

TEST(Dpctl, FollowShowsChangesAsTheyCome)
{
    Gateway gateway;
    Process watch{gateway.dpctl_command({"io", "--follow", "--json"})};
    EXPECT_TRUE(watch.says("Wait_Prm"));
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(watch.says("Data_Exch"));
    gateway.drive().send_line("set 55 12.34");
    EXPECT_TRUE(watch.says("12.34"));
    EXPECT_EQ(gateway.daemon().end(), 0);
    EXPECT_TRUE(watch.wait().has_value()) << "without a daemon there is nothing to watch";
}

TEST(Dpctl, FollowOfStatusShowsWhatTheMasterOrders)
{
    Gateway gateway;
    Process following{gateway.dpctl_command({"status", "--follow"})};
    EXPECT_TRUE(following.says("state Wait_Prm"));
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(following.says("state Data_Exch (was"));
    ASSERT_TRUE(master.does("sync"));
    EXPECT_TRUE(following.says("state Data_Exch, Sync (was Data_Exch)"));
    ASSERT_TRUE(master.does("freeze"));
    EXPECT_TRUE(following.says("state Data_Exch, Sync, Freeze (was Data_Exch, Sync)"));
}

TEST(Dpctl, ShowsAnAddressThatWasChangedInTheFileAsPending)
{
    Gateway gateway;
    EXPECT_TRUE(gateway.json({"show"}).at("stations").at(0).at("info").at("address_pending").is_null());

    std::string text = gateway.config_text();
    text.replace(text.find("address = 5"), 11, "address = 7");
    write_file(gateway.config(), text);
    const auto info = [&] { return gateway.json({"show"}).at("stations").at(0).at("info"); };
    EXPECT_TRUE(eventually([&] { return info().at("address_pending") == 7; }))
        << "it looks at its file itself";
    EXPECT_EQ(info().at("address_active"), 5);
    EXPECT_THAT(gateway.dpctl({"show"}).out, HasSubstr("5 active, 7 pending"));
    {
        Master master{gateway, {"--tags", "55"}, 5};
        EXPECT_TRUE(master.does("start 60s")) << "until the restart the old one counts";
    }
    EXPECT_EQ(gateway.daemon().end(), 0);
    gateway.start_daemon();
    Master master{gateway, {"--tags", "55"}, 7};
    EXPECT_TRUE(master.does("start 60s"));
}

class Lamps : public ::testing::Test {
protected:
    explicit Lamps(const char* profile = "590") : gateway{{.profile = profile, .lamps = true}} {}

    static bool shows(const std::filesystem::path& lamp, const std::string& value)
    {
        return eventually([&] { return content(lamp) == value; });
    }
    static bool flashes(const std::filesystem::path& lamp)
    {
        return shows(lamp, "1") && shows(lamp, "0") && shows(lamp, "1");
    }
    std::string pattern(const char* lamp) const
    {
        const Json all = gateway.json({"show"});
        for (const Json& one : all.at("stations").at(0).at("leds").at("leds"))
            if (one.at("name") == lamp) return one.at("pattern");
        return "";
    }

    Gateway gateway;
    const std::filesystem::path red = gateway.lamp_folder() / "class/gpio/gpio23/value";
    const std::filesystem::path green = gateway.lamp_folder() / "class/leds/green/brightness";
};

TEST_F(Lamps, SpeakTheLanguageOfTheOptionBoard)
{
    EXPECT_TRUE(shows(red, "1")) << "external fault: there is no master";
    EXPECT_EQ(content(gateway.lamp_folder() / "class/gpio/gpio23/direction"), "low");
    EXPECT_TRUE(flashes(green));
    EXPECT_EQ(pattern("green"), "flashing 1 Hz");

    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(shows(red, "0")) << "data exchange";
    EXPECT_TRUE(flashes(green));
    EXPECT_EQ(pattern("red"), "off");
    EXPECT_EQ(pattern("green"), "flashing 2 Hz");

    gateway.drive().send_line("silence");
    EXPECT_TRUE(shows(red, "1")) << "internal fault: the drive does not answer";
    EXPECT_TRUE(flashes(green));
    EXPECT_EQ(pattern("green"), "flashing 2 Hz");

    gateway.drive().send_line("ok");
    EXPECT_TRUE(shows(red, "0"));
}

class LampsOf620 : public Lamps {
protected:
    LampsOf620() : Lamps("620") {}
};

TEST_F(LampsOf620, FlashBothForAnInternalFault)
{
    EXPECT_TRUE(shows(red, "1"));
    gateway.drive().send_line("silence");
    EXPECT_TRUE(flashes(red));
    EXPECT_EQ(pattern("red"), "flashing 2 Hz");
    EXPECT_EQ(pattern("green"), "flashing 2 Hz");
}

TEST_F(Lamps, AreDarkWhenTheDaemonHasEnded)
{
    EXPECT_TRUE(shows(red, "1"));
    EXPECT_EQ(gateway.daemon().end(), 0);
    EXPECT_EQ(content(red), "0");
    EXPECT_EQ(content(green), "0");
}

/// A pipe that nobody reads: to open it for writing never ends, like a call of a chip that hangs.
TEST_F(Lamps, ThatHangCostOnlyThemselvesAndTheEndSaysSo)
{
    EXPECT_TRUE(flashes(green));
    std::filesystem::remove(green);
    ASSERT_EQ(::mkfifo(green.c_str(), 0600), 0);

    EXPECT_TRUE(gateway.daemon().says("the lamp green does not show its pattern: LED led:green"));
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(shows(red, "0")) << "data exchange";
    EXPECT_THAT(gateway.dpctl({"doctor"}).out, HasSubstr("has not answered for"));

    EXPECT_EQ(gateway.daemon().end(), 0);
    EXPECT_TRUE(gateway.daemon().says("the lamps of led do not answer"));
    EXPECT_EQ(content(red), "0");
}

} // namespace
} // namespace dpslave::test
