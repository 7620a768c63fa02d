// SPDX-License-Identifier: Apache-2.0
// From a bare drive to a confirmed table, with the real programs: survey, Ctrl-C, resume,
// confirm, check, exchange.
// Only here: the files that one command leaves and the next one reads, with a signal between them.
#include "gateway.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A 590 of which nothing is known: its table is empty.
class BareDrive : public ::testing::Test {
protected:
    BareDrive()
    {
        write_file(table, "tag,name,type,decimals\n");
        std::string config = gateway.config_text();
        const auto at = config.find("tags = ");
        write_file(gateway.config(),
                   config.replace(at, config.find('\n', at) - at, "tags = \"unwinder.csv\""));
        gateway.start_daemon();
        EXPECT_TRUE(gateway.daemon().says("the drive answers"));
    }
    Arguments survey(Arguments more) const
    {
        Arguments all{"survey", "unwinder", "--output", table};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::string row(int tag) const
    {
        const std::string text = '\n' + content(table) + '\n';
        const auto at = text.find('\n' + std::to_string(tag) + ',');
        return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
    }
    /// A change of the table by hand.
    void change(const std::string& from, const std::string& to)
    {
        std::string text = content(table) + '\n';
        ASSERT_NE(text.find(from), std::string::npos) << text;
        write_file(table, text.replace(text.find(from), from.size(), to));
    }

    Gateway gateway{{.started = false}};
    const std::filesystem::path table = gateway.folder("unwinder.csv");
    const std::filesystem::path record = gateway.folder("unwinder.survey.csv");
};

TEST_F(BareDrive, IsSurveyedInterruptedResumedConfirmedAndExchanged)
{
    gateway.drive().send_line("set 55 12.34");
    gateway.drive().send_line("set 56 -7.5");
    {
        Process first{gateway.dpctl_command(survey({"--tags", "50-145"}))};
        ASSERT_TRUE(first.says("96 tags to ask"));
        EXPECT_EQ(first.end(SIGINT), 1);
        EXPECT_TRUE(first.ever_said("--resume"));
    }
    EXPECT_THAT(content(record), HasSubstr("tag,mnemonic,answers"));

    const Outcome all = gateway.dpctl(survey({"--tags", "50-145", "--resume"}));

    EXPECT_EQ(all.status, 0) << all.out << all.err;
    EXPECT_THAT(all.out, AllOf(HasSubstr("96 of 96 tags asked: 18 answer"), HasSubstr("0 silent")));
    EXPECT_EQ(row(55), "55,,INT,2,,,bj,,no,12.34,12.34");
    EXPECT_EQ(row(56), "56,,INT,1,,,bk,,no,-7.5,-7.5")
        << "its second decimal was 0, and the drive leaves zeros out";
    EXPECT_EQ(row(91), "91,,INT,0,0,65535,cj,,no,40000,40000");
    EXPECT_EQ(row(100), "100,,WORD,,,,cs,,no,>0000,>0000");
    EXPECT_EQ(row(102), "102,,BOOL,,,,cu,,no,1,1");
    EXPECT_EQ(row(130), "130,,STRING,,,,dm,,no,,");
    EXPECT_EQ(row(120), "") << "it can only be written";
    EXPECT_THAT(content(record), HasSubstr("\n120,dc,0,0,1,"));

    // Two rows are confirmed by the manual, which prints two decimals for both.
    change("55,,INT,2,,,bj,,no", "55,SPEED FEEDBACK,INT,2,,,bj,,yes");
    change("56,,INT,1,,,bk,,no", "56,SPEED SETPOINT,INT,2,,,bk,,yes");
    const Outcome checked = gateway.run_daemon({"--check"});
    EXPECT_EQ(checked.status, 0) << checked.err;
    EXPECT_THAT(checked.out + checked.err, HasSubstr("confirmation")) << "the other rows still wait";
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 10s for in 1 = 1234"));
    EXPECT_TRUE(master.does("out 1 = 4200"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 42.00"));

    // The survey goes on beside the exchange, contradicts what was confirmed wrongly and leaves it alone.
    change("SPEED FEEDBACK,INT,2", "SPEED FEEDBACK,INT,1");
    const Outcome again = gateway.dpctl(survey({"--tags", "55-62", "--passes", "2"}));
    EXPECT_EQ(again.status, 1);
    EXPECT_THAT(
        again.out,
        HasSubstr("tag 55 (SPEED FEEDBACK), line 2: its row says 1 decimal, the drive answers with 2"));
    EXPECT_THAT(row(55), HasSubstr("SPEED FEEDBACK,INT,1"));
    EXPECT_TRUE(gateway.exchange_ends_with(0));
    EXPECT_FALSE(gateway.daemon().ever_said("does not answer"));
    EXPECT_EQ(gateway.station().at("left_count"), 0);
}

TEST_F(BareDrive, ThatIsSwitchedOffIsWaitedForAndNotHeldForADriveWithoutTags)
{
    gateway.drive().send_line("silence");
    ASSERT_TRUE(gateway.daemon().says("does not answer"));
    Process running{gateway.dpctl_command(survey({"--tags", "55-57"}))};
    ASSERT_TRUE(running.says("3 tags to ask"));
    gateway.drive().send_line("ok");

    EXPECT_EQ(running.wait(), 0);

    EXPECT_TRUE(running.ever_said("3 of 3 tags asked: 3 answer, 0 denied, 0 silent"));
}

TEST_F(BareDrive, LeavesNoWordInTheLogForATagThatItDoesNotHave)
{
    const Outcome all = gateway.dpctl(survey({"--tags", "1-20"}));

    EXPECT_THAT(all.out, HasSubstr("20 of 20 tags asked: 0 answer, 20 denied, 0 silent"));
    EXPECT_EQ(gateway.daemon().how_often("tag"), 0U);
    EXPECT_EQ(gateway.diagnosis().at("trouble"), Json::array());
    EXPECT_EQ(gateway.station().at("drive").at("refusals"), 0);
}

TEST(Survey, ByTheRuleThatADriveFollowsMakesATableThatNeedsNoRule)
{
    const Gateway gateway{{.drive = {"--mnemonics", "pno"}}};
    const auto table = gateway.folder("own.csv");
    write_file(table, "tag,name,type,decimals\n");
    const auto survey = [&](Arguments more) {
        Arguments all{"survey", "unwinder", "--output", table, "--tags", "55-57"};
        all.insert(all.end(), more.begin(), more.end());
        return gateway.dpctl(all);
    };
    EXPECT_THAT(survey({}).out, HasSubstr("3 of 3 tags asked: 0 answer, 3 denied"))
        << "the profile has another rule";

    const Outcome all = survey({"--rule", "pno"});

    EXPECT_EQ(all.status, 0) << all.out << all.err;
    EXPECT_THAT(all.out, HasSubstr("3 of 3 tags asked: 3 answer"));
    EXPECT_THAT(content(table), AllOf(HasSubstr("\n55,,INT,"), HasSubstr(",37,,no,")));
}

TEST(Survey, OfAnInstrumentSaysThatModbusShowsSixteenBitsOnly)
{
    // No source states the true ident; any will do here.
    const Gateway gateway{
        {.profile = "2408f", .units = {"1"}, .protocol = "modbus-rtu", .keys = "ident = 0x0A0B\n"}};
    const auto table = gateway.folder("own.csv");
    write_file(table, "tag,name,type,decimals\n");

    const Outcome all = gateway.dpctl({"survey", "unwinder", "--output", table, "--tags", "1-3"});

    EXPECT_EQ(all.status, 0) << all.err;
    EXPECT_THAT(all.out, AllOf(HasSubstr("Modbus shows 16 bits"), HasSubstr("3 of 3 tags asked: 3 answer")));
    EXPECT_THAT(content(table), HasSubstr("\n1,,WORD,,"));
}

} // namespace
} // namespace dpslave::test
