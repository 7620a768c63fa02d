// SPDX-License-Identifier: Apache-2.0
// What a new configuration means for a program that runs.
#include "config_bench.hpp"

#include "dpslave/app/reload_plan.hpp"

namespace dpslave {
namespace {

using app::Config;
using app::Plan;
using test::with;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kBox = R"(
[[station]]
name = "box"
address = 9
profile = "605"
line = "p3"
unit = "02"
)";

class ReloadPlan : public test::ConfigFile {
protected:
    static std::vector<std::uint8_t> addresses_of(const Config& config)
    {
        std::vector<std::uint8_t> all;
        for (const auto& station : config.stations) all.push_back(station.address);
        return all;
    }
    Plan plan(const std::string& before, const std::string& after) const
    {
        const Config present = good(before);
        return app::plan_reload(present, addresses_of(present), good(after));
    }
    /// Of each station of the new file: the index that it had and keeps.
    static std::vector<std::optional<std::size_t>> stays(const Plan& plan)
    {
        std::vector<std::optional<std::size_t>> all;
        for (const auto& station : plan.stations) all.push_back(station.stays);
        return all;
    }

    const std::string one{test::kGood};
    const std::string two = one + test::kSecondStation;
    const std::string boxed = two + kBox;
};

TEST_F(ReloadPlan, OfTheSameFileChangesNothing)
{
    const Plan same = plan(two, two);
    EXPECT_THAT(same.changes, IsEmpty());
    EXPECT_THAT(same.pending, IsEmpty());
    EXPECT_THAT(same.refusals, IsEmpty());
    EXPECT_THAT(stays(same), ElementsAre(0U, 1U));
}

TEST_F(ReloadPlan, DoesNotLookAtCommentsAtThePlaceOfAKeyOrAtADefaultThatIsWritten)
{
    const Plan same = plan(two, "# a comment\n\n" + two + "output_refresh_s = 1.0\n");
    EXPECT_THAT(same.changes, IsEmpty());
    EXPECT_THAT(same.refusals, IsEmpty());
    EXPECT_THAT(stays(same), ElementsAre(0U, 1U));
}

TEST_F(ReloadPlan, KnowsAStationByItsNameWhereverItStands)
{
    const std::string turned =
        one.substr(0, one.find("[[station]]")) + test::kSecondStation + one.substr(one.find("[[station]]"));
    const Plan plan = this->plan(two, turned);
    EXPECT_THAT(stays(plan), ElementsAre(1U, 0U));
    // Whoever counts stations has to learn the new order, or the next plan means another one.
    EXPECT_THAT(plan.changes, ElementsAre("lines or stations stand in another order"));
}

TEST_F(ReloadPlan, AddsAndRemovesStationsWhileTheOthersGoOn)
{
    const Plan added = plan(one, two);
    EXPECT_THAT(added.changes, ElementsAre("station winder added at address 6"));
    EXPECT_THAT(stays(added), ElementsAre(0U, std::nullopt));

    const Plan removed = plan(two, one);
    EXPECT_THAT(removed.changes, ElementsAre("station winder removed"));
    EXPECT_THAT(stays(removed), ElementsAre(0U));
}

struct Change {
    const char* what;
    const char* from;
    const char* to;
};
void PrintTo(const Change& change, std::ostream* out)
{
    *out << test::case_name(change.what);
}

/// Any of these takes the second station away and puts a new one in its place.
class ChangedStation : public ReloadPlan, public testing::WithParamInterface<Change> {};

TEST_P(ChangedStation, LeavesAndStartsAnewWhileTheOtherGoesOn)
{
    const std::string after = one + with(test::kSecondStation, GetParam().from, GetParam().to);
    const Plan plan = this->plan(two, after);
    EXPECT_THAT(plan.changes,
                ElementsAre("station winder changed: it leaves the bus and starts anew at address 6"));
    EXPECT_THAT(stays(plan), ElementsAre(0U, std::nullopt));
}

INSTANTIATE_TEST_SUITE_P(
    By, ChangedStation,
    testing::Values(Change{"its unit", "\"01\"", "\"02\""}, Change{"its profile", "\"620\"", "\"584s\""},
                    Change{"its refresh", "unit =", "output_refresh_s = 2.0\nunit ="},
                    Change{"what is done at the loss", "unit =", "output_loss = \"hold\"\nunit ="},
                    Change{"its ident", "unit =", "ident = 0x1234\nunit ="},
                    Change{"its tag table", "unit =", "tags = \"../tags/590plus.csv\"\nunit ="}),
    testing::PrintToStringParamName());

TEST_F(ReloadPlan, SeesAProfileOrATagTableThatIsAnotherOneUnderTheSameName)
{
    const Config present = good(two);
    folder_.write("tags/empty.csv", "tag,name,type\n55,SPEED,INT\n56,SETPOINT,INT\n");
    const Plan other_tags = app::plan_reload(present, addresses_of(present), good(two));
    EXPECT_THAT(stays(other_tags), ElementsAre(std::nullopt, std::nullopt));

    change_profile("590-site", "V4.2 onwards", "V4.2 onwards");
    const std::string site = with(two, "\"590\"", "\"590-site\"");
    const Config now = good(site);
    change_profile("590-site", "V4.2 onwards", "V4.3 onwards");
    EXPECT_THAT(stays(app::plan_reload(now, addresses_of(now), good(site))), ElementsAre(std::nullopt, 1U));
}

TEST_F(ReloadPlan, LetsAStationGoOnWhoseLampsAreOthers)
{
    const Plan plan = this->plan(one, one + "[station.leds]\nred = \"gpio:23\"\n");
    EXPECT_THAT(plan.changes, ElementsAre("station unwinder: other lamps"));
    EXPECT_THAT(stays(plan), ElementsAre(0U));
}

TEST_F(ReloadPlan, LetsStationsGoOnWhoseLineIsSetInAnotherWay)
{
    const Plan plan =
        this->plan(two, with(two, "protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nbaud = 19200"));
    EXPECT_THAT(plan.changes, ElementsAre("line p3 changed: /dev/null-p3 is opened anew"));
    EXPECT_THAT(plan.lines, ElementsAre(Plan::Line{0U, true}));
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
}

TEST_F(ReloadPlan, StartsAStationAnewWhoseLineSpeaksAnotherProtocol)
{
    change_profile("590-both", "[\"ei-ascii\"]", "[\"ei-ascii\", \"modbus-rtu\"]");
    const std::string ascii = with(with(one, "\"590\"", "\"590-both\""), "\"00\"", "\"01\"");
    const Plan plan = this->plan(ascii, with(ascii, "\"ei-ascii\"", "\"modbus-rtu\""));
    EXPECT_THAT(stays(plan), ElementsAre(std::nullopt));
}

TEST_F(ReloadPlan, AddsAndRemovesLines)
{
    const std::string more =
        two + "[[line]]\nname = \"p4\"\nport = \"/dev/null-p4\"\nprotocol = \"ei-ascii\"\n";
    const Plan added = plan(two, more);
    EXPECT_THAT(added.changes, ElementsAre("line p4 added (/dev/null-p4)"));
    EXPECT_THAT(added.lines, ElementsAre(Plan::Line{0U, false}, Plan::Line{}));
    EXPECT_THAT(stays(added), ElementsAre(0U, 1U));

    const Plan removed = plan(more, two);
    EXPECT_THAT(removed.changes, ElementsAre("line p4 removed"));
    EXPECT_THAT(removed.lines, ElementsAre(Plan::Line{0U, false}));
}

// ---- A-033

TEST_F(ReloadPlan, OfAnotherAddressOfAnOptionBoardWaitsForTheNextStart)
{
    const Plan plan = this->plan(two, with(two, "address = 6", "address = 7"));
    EXPECT_THAT(plan.changes, IsEmpty());
    EXPECT_THAT(plan.pending,
                ElementsAre(HasSubstr("station winder: address 7 counts from the next start on")));
    EXPECT_THAT(plan.refusals, IsEmpty());
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
    EXPECT_EQ(plan.config.stations[1].address, 6) << "the one in force";
}

TEST_F(ReloadPlan, DoesTheRestOfAChangeAtTheOldAddressOfAnOptionBoard)
{
    const std::string after = with(with(two, "address = 6", "address = 7"), "unit = \"01\"", "unit = \"02\"");
    const Plan plan = this->plan(two, after);
    EXPECT_THAT(plan.changes,
                ElementsAre("station winder changed: it leaves the bus and starts anew at address 6"));
    EXPECT_THAT(plan.pending, SizeIs(1));
    EXPECT_EQ(plan.config.stations[1].address, 6);
}

TEST_F(ReloadPlan, ForgetsAPendingAddressThatIsTakenBack)
{
    const Config present = good(two);
    const Plan first = app::plan_reload(present, {5, 6}, good(with(two, "address = 6", "address = 7")));
    const Plan second = app::plan_reload(first.config, {5, 6}, good(two));
    EXPECT_THAT(second.changes, IsEmpty());
    EXPECT_THAT(second.pending, IsEmpty());
}

TEST_F(ReloadPlan, OfTwoOptionBoardsThatChangePlacesLeavesBothWhereTheyAre)
{
    std::string after = with(two, "address = 5", "address = 99");
    after = with(with(after, "address = 6", "address = 5"), "address = 99", "address = 6");
    const Plan plan = this->plan(two, after);
    EXPECT_THAT(plan.pending, SizeIs(2));
    EXPECT_THAT(plan.refusals, IsEmpty());
    EXPECT_EQ(addresses_of(plan.config), (std::vector<std::uint8_t>{5, 6}));
}

TEST_F(ReloadPlan, RefusesAnAddressThatAnOptionBoardLeavesWithTheNextStartOnly)
{
    const std::string after =
        with(two, "address = 6", "address = 7") + with(kBox, "address = 9", "address = 6");
    const Plan plan = this->plan(two, after);
    EXPECT_THAT(plan.refusals,
                ElementsAre(HasSubstr("station box: address 6 is that of station winder until the "
                                      "next start")));
}

TEST_F(ReloadPlan, ChangesTheAddressOfATechnologyBoxAtOnce)
{
    const Plan plan = this->plan(boxed, with(boxed, "address = 9", "address = 10"));
    EXPECT_THAT(plan.changes,
                ElementsAre("station box changed: it leaves the bus and starts anew at address 10"));
    EXPECT_THAT(plan.pending, IsEmpty());
    EXPECT_EQ(plan.config.stations[2].address, 10);
}

TEST_F(ReloadPlan, RefusesAnAddressThatATechnologyBoxWasGivenByHand)
{
    const Config present = good(boxed);
    const std::string after = boxed + with(with(kBox, "\"box\"", "\"other\""), "\"02\"", "\"03\"");
    const Plan plan = app::plan_reload(present, {5, 6, 20}, good(with(after, "address = 9", "address = 21")));
    EXPECT_THAT(plan.refusals, IsEmpty());

    const std::string taken = boxed + with(with(with(kBox, "\"box\"", "\"other\""), "\"02\"", "\"03\""),
                                           "address = 9", "address = 20");
    const Plan refused = app::plan_reload(present, {5, 6, 20}, good(taken));
    EXPECT_THAT(refused.refusals, ElementsAre(HasSubstr("set by hand")));
}

TEST_F(ReloadPlan, LetsATechnologyBoxGoOnAtTheAddressThatItWasGivenByHand)
{
    const Config present = good(boxed);
    const Plan plan = app::plan_reload(present, {5, 6, 20}, good(boxed));
    EXPECT_THAT(plan.changes, IsEmpty());
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U, 2U));
}

// ---- what needs a restart

class NeedsARestart : public ReloadPlan, public testing::WithParamInterface<Change> {};

TEST_P(NeedsARestart, IsRefusedByTheNameOfItsKey)
{
    const Plan plan = this->plan(two, with(two, GetParam().from, GetParam().to));
    ASSERT_THAT(plan.refusals, SizeIs(1));
    EXPECT_THAT(plan.refusals.front(), HasSubstr(GetParam().what));
    EXPECT_THAT(plan.refusals.front(), HasSubstr("systemctl restart dpslaved"));
}

INSTANTIATE_TEST_SUITE_P(
    Of, NeedsARestart,
    testing::Values(Change{"[bus] port", "/dev/null-bus", "/dev/null-other"},
                    Change{"[bus] baud", "baud = 187500", "baud = 93750"},
                    Change{"[bus] max_tsdr", "baud = 187500", "baud = 187500\nmax_tsdr = 200"},
                    Change{"[realtime] priority, cpu", "[control]",
                           "[realtime]\npriority = 10\ncpu = 1\n[control]"},
                    Change{"[control] socket", "[control]", "[control]\nsocket = \"/run/other.sock\""}),
    testing::PrintToStringParamName());

TEST_F(ReloadPlan, MayChangeWhoOperatesAndWhereTheLampsAre)
{
    const Plan group = plan(one, with(one, "\"root\"", "\"daemon\""));
    EXPECT_THAT(group.refusals, IsEmpty());
    EXPECT_THAT(group.changes, ElementsAre("group daemon may operate, for callers from now on"));
    EXPECT_THAT(stays(group), ElementsAre(0U));

    const Plan lamps = plan(one, with(one, "[control]", "[leds]\nsysfs = \"/tmp\"\n[control]"));
    EXPECT_THAT(lamps.refusals, IsEmpty());
    EXPECT_THAT(lamps.changes, ElementsAre("lamps are looked for in /tmp"));
}

} // namespace
} // namespace dpslave
