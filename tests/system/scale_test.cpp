// SPDX-License-Identifier: Apache-2.0
// X-49 on the real programs: a number whose scale is in no table holds the start, until a reload brings its
// row.
// Only here: a held start that ends by a reload.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The drive speaks 55 with two decimals and 56 likewise; the table of the daemon knows less.
class UnknownScale : public ::testing::Test {
protected:
    UnknownScale()
    {
        table("tag,type,decimals\n56,INT,2\n");
        write_file(gateway.config(), with_own_table());
        gateway.start_daemon();
    }
    void table(const std::string& rows) { write_file(gateway.folder("own.csv"), rows); }
    std::string with_own_table() const
    {
        std::string text = gateway.config_text();
        const auto at = text.find("tags = ");
        return text.replace(at, text.find('\n', at) - at, "tags = \"own.csv\"");
    }
    ::testing::AssertionResult diag_says(const std::string& words) const
    {
        std::string shown;
        for (int i = 0; i < 100; ++i) {
            shown = gateway.dpctl({"diag"}).out;
            if (shown.find(words) != std::string::npos) return ::testing::AssertionSuccess();
        }
        return ::testing::AssertionFailure() << shown;
    }

    Gateway gateway{{.started = false}};
};

TEST_F(UnknownScale, OfAnInputHoldsTheStartUntilAReloadBringsItsRow)
{
    gateway.drive().send_line("unit 00");
    gateway.drive().send_line("set 55 12.50");
    Master master{gateway, {"--tags", "55,56w"}};

    EXPECT_TRUE(master.does("try start 3s"));
    EXPECT_TRUE(master.does("expect diag stat-diag"));
    EXPECT_TRUE(master.does("expect diag not not-ready"));
    EXPECT_TRUE(gateway.word_becomes(55, "state", "unscaled"));
    EXPECT_EQ(gateway.word(55)["answer"], "12.5");
    EXPECT_EQ(gateway.word(55)["raw"], 0);
    EXPECT_TRUE(diag_says("Data exchange does not start: the scale of tag 55 (answers '12.5') is not known"));
    EXPECT_EQ(gateway.dpctl({"status", "--wait", "0", "--quiet"}).status, 1)
        << "it is in Data_Exch and exchanges nothing";
    EXPECT_THAT(gateway.dpctl({"status"}).out,
                AllOf(HasSubstr("1, 0 in Data_Exch"), HasSubstr("Data_Exch, held")));
    EXPECT_TRUE(gateway.daemon().says("Data exchange does not start"));

    table("tag,type,decimals\n55,INT,2\n56,INT,2\n");
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    EXPECT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(gateway.exchange_ends_with(0));
    EXPECT_TRUE(master.does("out 1 = 700"));
    EXPECT_TRUE(gateway.drive().says("tag 56 written 7.00"));
    EXPECT_TRUE(master.leaves());
}

TEST_F(UnknownScale, OfAnOutputHoldsTheStartAndNothingIsWritten)
{
    Master master{gateway, {"--tags", "56,57w"}};

    EXPECT_TRUE(master.does("try start 3s"));
    EXPECT_TRUE(master.does("expect diag stat-diag"));
    EXPECT_TRUE(gateway.word_becomes(57, "state", "unscaled"));
    EXPECT_EQ(gateway.counter("unwinder", "drive_writes"), 0U);
}

TEST_F(UnknownScale, WithOneScaleForAllUnlistedTagsTheExchangeBegins)
{
    write_file(gateway.config(), with_own_table() + "unlisted_decimals = 2\n");
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    gateway.drive().send_line("unit 00");
    gateway.drive().send_line("set 55 12.50");
    Master master{gateway, {"--tags", "55,56w"}};

    EXPECT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(master.does("wait 60s for in 1 = 1250"));
    EXPECT_TRUE(master.leaves());
}

/// the daemon asks by the rule of the 590, and the drive goes by that of the AC drives.
TEST(DeniedTags, OfADriveUnderAnotherMnemonicRuleHoldTheStart)
{
    Gateway gateway{{.model = "690plus"}};
    Master master{gateway, {"--tags", "55,56w"}};

    EXPECT_TRUE(master.does("try start 3s"));
    EXPECT_TRUE(master.does("expect diag stat-diag"));
    EXPECT_TRUE(master.does("expect diag not not-ready"));
    EXPECT_TRUE(gateway.word_becomes(55, "state", "invalid_tag"));
    EXPECT_TRUE(gateway.word_becomes(56, "state", "invalid_tag"));
    EXPECT_EQ(gateway.word(55)["answer"], "EE >01C7");
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("the drive denies a tag"));
    EXPECT_TRUE(
        gateway.daemon().says("Data exchange does not start: the drive denies every chosen tag: tag 55"));
    EXPECT_EQ(gateway.counter("unwinder", "drive_writes"), 0U);
}

} // namespace
} // namespace dpslave::test
