// SPDX-License-Identifier: Apache-2.0
// Tests what a new configuration means for a program that runs.
#include "app/reload/reload_plan.hpp"
#include "config/config_bench.hpp"

namespace dpslave {
namespace {

using app::InForce;
using app::Plan;
using config::Config;
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
    static std::vector<std::uint8_t> addresses_of(const config::Config& config)
    {
        std::vector<std::uint8_t> all;
        for (const auto& station : config.stations) all.push_back(station.address);
        return all;
    }
    /// As at the start, without a master.
    static std::vector<InForce> in_force(const config::Config& config)
    {
        std::vector<InForce> all;
        for (const auto& station : config.stations) all.push_back({station.address});
        return all;
    }
    Plan plan(const std::string& before, const std::string& after) const
    {
        const config::Config present = good(before);
        return app::plan_reload(present, in_force(present), good(after));
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

TEST_F(ReloadPlan, RecognisesAStationByItsNameWhereverItStands)
{
    const std::string turned =
        one.substr(0, one.find("[[station]]")) + test::kSecondStation + one.substr(one.find("[[station]]"));
    const Plan plan = this->plan(two, turned);
    EXPECT_THAT(stays(plan), ElementsAre(1U, 0U));
    // An index of a station follows the new order, or the next plan means another one.
    EXPECT_THAT(plan.changes, ElementsAre("lines or stations are in another order"));
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
    EXPECT_THAT(
        plan.changes,
        ElementsAre(HasSubstr("station winder changed: it leaves the bus and starts again at address 6 (")));
    ASSERT_THAT(plan.leaving, SizeIs(1));
    EXPECT_EQ(plan.leaving[0].station, "winder");
    EXPECT_THAT(plan.leaving[0].reason, HasSubstr(GetParam().what));
    EXPECT_THAT(stays(plan), ElementsAre(0U, std::nullopt));
}

INSTANTIATE_TEST_SUITE_P(By, ChangedStation,
                         testing::Values(Change{"unit", "\"01\"", "\"02\""},
                                         Change{"profile", "\"620\"", "\"584s\""},
                                         Change{"ident", "unit =", "ident = 0x1234\nunit ="},
                                         Change{"Demand Data", "unit =", "demand.error_base = 1\nunit ="}),
                         testing::PrintToStringParamName());

/// Any of these is applied while the station goes on.
class AppliedKey : public ReloadPlan, public testing::WithParamInterface<Change> {};

TEST_P(AppliedKey, IsNamedAndNoStationLeavesTheBus)
{
    const Plan plan = this->plan(two, one + with(test::kSecondStation, GetParam().from, GetParam().to));
    EXPECT_THAT(plan.changes, ElementsAre(HasSubstr(GetParam().what)));
    EXPECT_THAT(plan.leaving, IsEmpty());
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
    EXPECT_TRUE(plan.stations[1].is_changed);
    EXPECT_FALSE(plan.stations[0].is_changed);
}

INSTANTIATE_TEST_SUITE_P(
    Of, AppliedKey,
    testing::Values(Change{"output_refresh_s", "unit =", "output_refresh_s = 2.0\nunit ="},
                    Change{"write_limits", "unit = \"01\"",
                           "unit = \"01\"\n[station.write_limits]\n55 = [\"1\", \"2\"]\n"},
                    Change{"output_loss", "unit =", "output_loss = \"hold\"\nunit ="},
                    Change{"station reel: its name, which was winder", "\"winder\"", "\"reel\""},
                    Change{"tags", "unit =", "tags = \"../tags/590plus.csv\"\nunit ="}),
    testing::PrintToStringParamName());

TEST_F(ReloadPlan, TakesAStationOfAnotherNameAndAnotherUnitForAnother)
{
    const std::string other = with(with(test::kSecondStation, "\"winder\"", "\"reel\""), "\"01\"", "\"02\"");
    const Plan plan = this->plan(two, one + other);
    EXPECT_THAT(stays(plan), ElementsAre(0U, std::nullopt));
    EXPECT_THAT(plan.leaving, ElementsAre(Plan::Leaving{"winder", "removed"}));
}

// ---- rows of the tag table

/// A master has chosen tag 55, which shows 1250, and tag 56, to which it writes 700.
class ReloadOfRows : public ReloadPlan {
protected:
    static constexpr const char* kRows = "tag,name,type,decimals,min,max\n"
                                         "55,SPEED,REAL,2,-100,100\n"
                                         "56,SETPOINT,REAL,2,-100,100\n"
                                         "57,CURRENT,REAL,2,,\n";
    Plan of(const std::string& rows, std::optional<std::uint16_t> speed = 1250)
    {
        folder_.write("tags/empty.csv", kRows);
        const config::Config present = good(one);
        auto now = in_force(present);
        now[0].tags = {{55, speed}, {56, 700}};
        folder_.write("tags/empty.csv", rows);
        return app::plan_reload(present, now, good(one));
    }
    void goes_on(const Plan& plan, const std::string& change)
    {
        EXPECT_THAT(plan.changes, ElementsAre(change));
        EXPECT_THAT(plan.leaving, IsEmpty());
        EXPECT_THAT(plan.stations, ElementsAre(Plan::Station{0U, true}));
    }
    void leaves(const Plan& plan, const std::string& reason)
    {
        EXPECT_THAT(plan.leaving, ElementsAre(Plan::Leaving{"unwinder", reason}));
        EXPECT_THAT(stays(plan), ElementsAre(std::nullopt));
    }
};

TEST_F(ReloadOfRows, AppliesANameThatTheMasterUses)
{
    goes_on(of(with(kRows, "SPEED", "SPEED FEEDBACK")), "station unwinder: 1 row of its tag table");
}

TEST_F(ReloadOfRows, AppliesOneMoreRowThatNoMasterHasChosen)
{
    goes_on(of(with(kRows, "57,", "54,RAMP,INT,,,\n57,")), "station unwinder: 1 row of its tag table");
}

TEST_F(ReloadOfRows, AppliesAnyChangeOfARowThatNoMasterHasChosen)
{
    goes_on(of(with(kRows, "57,CURRENT,REAL,2,,", "57,CURRENT,WORD,,,")),
            "station unwinder: 1 row of its tag table");
    goes_on(of(with(kRows, "57,CURRENT,REAL,2,,\n", "")), "station unwinder: 1 row of its tag table");
}

TEST_F(ReloadOfRows, AppliesLimitsThatTheValueMeets)
{
    goes_on(of(with(kRows, "SETPOINT,REAL,2,-100,100", "SETPOINT,REAL,2,-100,7")),
            "station unwinder: 1 row of its tag table");
}

TEST_F(ReloadOfRows, TakesTheStationOffTheBusWhereTheValueIsOutsideTheNewLimits)
{
    leaves(of(with(kRows, "SETPOINT,REAL,2,-100,100", "SETPOINT,REAL,2,-100,6.99")),
           "tag 56 is 7.00, which is outside its new limits");
}

TEST_F(ReloadOfRows, TakesTheStationOffTheBusWhereTheMasterWouldGetAnotherValue)
{
    leaves(of(with(kRows, "SPEED,REAL,2", "SPEED,REAL,1")),
           "tag 55, which the master uses, would be another value");
    leaves(of(with(kRows, "55,SPEED,REAL,2,-100,100\n", "")),
           "tag 55, which the master uses, would be another value");
}

TEST_F(ReloadOfRows, AppliesAScaleWhereNoValueWasEverOnTheBus)
{
    goes_on(of(with(kRows, "SPEED,REAL,2", "SPEED,REAL,1"), std::nullopt),
            "station unwinder: 1 row of its tag table");
}

TEST_F(ReloadPlan, SeesAProfileOrATagTableThatIsAnotherOneUnderTheSameName)
{
    const config::Config present = good(two);
    folder_.write("tags/empty.csv", "tag,name,type\n55,SPEED,INT\n56,SETPOINT,INT\n");
    const Plan other_tags = app::plan_reload(present, in_force(present), good(two));
    EXPECT_THAT(other_tags.changes,
                ElementsAre(HasSubstr("station unwinder: "), HasSubstr("station winder: ")));

    change_profile("590-site", "V4.2 onwards", "V4.2 onwards");
    const std::string site = with(two, "\"590\"", "\"590-site\"");
    const config::Config now = good(site);
    change_profile("590-site", "V4.2 onwards", "V4.3 onwards");
    const Plan other_text = app::plan_reload(now, in_force(now), good(site));
    EXPECT_THAT(other_text.changes, ElementsAre("station unwinder: profile"));
    EXPECT_THAT(other_text.leaving, IsEmpty());
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
    EXPECT_THAT(plan.changes, ElementsAre("line p3 changed: /dev/null-p3 is opened again"));
    EXPECT_THAT(plan.lines, ElementsAre(Plan::Line{0U, true, true}));
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
}

TEST_F(ReloadPlan, MovesALineToAnotherPortWithItsStations)
{
    const Plan plan = this->plan(two, with(two, "/dev/null-p3", "/dev/null-p4"));
    EXPECT_THAT(plan.changes, ElementsAre("line p3 moves from /dev/null-p3 to /dev/null-p4"));
    EXPECT_THAT(plan.leaving, IsEmpty());
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
}

TEST_F(ReloadPlan, KeepsThePortOpenOfALineThatHasAnotherNameOrOtherRetries)
{
    std::string after = with(one, "protocol = \"ei-ascii\"", "protocol = \"ei-ascii\"\nretries = 4");
    for (int i = 0; i < 2; ++i) after = with(after, "\"p3\"", "\"drives\"");
    const Plan plan = this->plan(one, after);
    EXPECT_THAT(plan.changes, ElementsAre("line drives: its name, which was p3", "line drives: retries"));
    EXPECT_THAT(plan.lines, ElementsAre(Plan::Line{0U, true, false}));
    EXPECT_THAT(stays(plan), ElementsAre(0U));
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
    EXPECT_THAT(added.lines, ElementsAre(Plan::Line{0U, false, false}, Plan::Line{}));
    EXPECT_THAT(stays(added), ElementsAre(0U, 1U));

    const Plan removed = plan(more, two);
    EXPECT_THAT(removed.changes, ElementsAre("line p4 removed"));
    EXPECT_THAT(removed.lines, ElementsAre(Plan::Line{0U, false, false}));
}

// ---- A-033

TEST_F(ReloadPlan, OfAnotherAddressOfAnOptionBoardWaitsForTheNextStart)
{
    const Plan plan = this->plan(two, with(two, "address = 6", "address = 7"));
    EXPECT_THAT(plan.changes, IsEmpty());
    EXPECT_THAT(plan.pending,
                ElementsAre(HasSubstr("station winder: address 7 takes effect at the next start")));
    EXPECT_THAT(plan.refusals, IsEmpty());
    EXPECT_THAT(stays(plan), ElementsAre(0U, 1U));
    EXPECT_EQ(plan.config.stations[1].address, 6) << "the one in force";
}

TEST_F(ReloadPlan, DoesTheRestOfAChangeAtTheOldAddressOfAnOptionBoard)
{
    const std::string after = with(with(two, "address = 6", "address = 7"), "unit = \"01\"", "unit = \"02\"");
    const Plan plan = this->plan(two, after);
    EXPECT_THAT(
        plan.changes,
        ElementsAre("station winder changed: it leaves the bus and starts again at address 6 (unit)"));
    EXPECT_THAT(plan.pending, SizeIs(1));
    EXPECT_EQ(plan.config.stations[1].address, 6);
}

TEST_F(ReloadPlan, DropsAPendingAddressThatIsTakenBack)
{
    const config::Config present = good(two);
    const Plan first = app::plan_reload(present, {{5}, {6}}, good(with(two, "address = 6", "address = 7")));
    const Plan second = app::plan_reload(first.config, {{5}, {6}}, good(two));
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
    EXPECT_THAT(
        plan.changes,
        ElementsAre("station box changed: it leaves the bus and starts again at address 10 (address)"));
    EXPECT_THAT(plan.pending, IsEmpty());
    EXPECT_EQ(plan.config.stations[2].address, 10);
}

TEST_F(ReloadPlan, RefusesAnAddressThatATechnologyBoxWasGivenByHand)
{
    const config::Config present = good(boxed);
    const std::string after = boxed + with(with(kBox, "\"box\"", "\"other\""), "\"02\"", "\"03\"");
    const Plan plan =
        app::plan_reload(present, {{5}, {6}, {20}}, good(with(after, "address = 9", "address = 21")));
    EXPECT_THAT(plan.refusals, IsEmpty());

    const std::string taken = boxed + with(with(with(kBox, "\"box\"", "\"other\""), "\"02\"", "\"03\""),
                                           "address = 9", "address = 20");
    const Plan refused = app::plan_reload(present, {{5}, {6}, {20}}, good(taken));
    EXPECT_THAT(refused.refusals, ElementsAre(HasSubstr("set by hand")));
}

TEST_F(ReloadPlan, LetsATechnologyBoxGoOnAtTheAddressThatItWasGivenByHand)
{
    const config::Config present = good(boxed);
    const Plan plan = app::plan_reload(present, {{5}, {6}, {20}}, good(boxed));
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
                    Change{"[bus] direction, gpio_active_low", "direction = \"none\"",
                           "direction = \"rts\"\ngpio_active_low = true"},
                    Change{"[realtime] priority, cpu", "[control]",
                           "[realtime]\npriority = 10\ncpu = 1\n[control]"},
                    Change{"[control] socket", "[control]", "[control]\nsocket = \"/run/other.sock\""}),
    testing::PrintToStringParamName());

TEST_F(ReloadPlan, FromStationsToListeningAndBackNeedsARestart)
{
    const config::Config listens = good("[bus]\nport = \"/dev/null-bus\"\nbaud = 187500\nlisten = true\n");
    const config::Config serves = good(one);

    for (const Plan& plan : {app::plan_reload(serves, in_force(serves), listens),
                             app::plan_reload(listens, in_force(listens), serves)}) {
        ASSERT_THAT(plan.refusals, SizeIs(1));
        EXPECT_THAT(plan.refusals.front(), HasSubstr("[bus] listen cannot change while the bus is served"));
        EXPECT_THAT(plan.refusals.front(), HasSubstr("systemctl restart dpslaved"));
    }
}

TEST_F(ReloadPlan, MayChangeTheOperatorsWhatTheyMayAndTheSinksOfTheLamps)
{
    const Plan group = plan(one, with(one, "\"root\"", "\"daemon\""));
    EXPECT_THAT(group.refusals, IsEmpty());
    EXPECT_THAT(group.changes, ElementsAre("group daemon may operate, from the next call on"));
    EXPECT_THAT(stays(group), ElementsAre(0U));

    const Plan shows = plan(one, with(one, "[control]", "[control]\nread_only = true"));
    EXPECT_THAT(shows.refusals, IsEmpty());
    EXPECT_THAT(shows.changes,
                ElementsAre("nothing can be written over the control socket, from the next call on"));
    EXPECT_THAT(stays(shows), ElementsAre(0U));

    const Plan lamps = plan(one, with(one, "[control]", "[leds]\nsysfs = \"/tmp\"\n[control]"));
    EXPECT_THAT(lamps.refusals, IsEmpty());
    EXPECT_THAT(lamps.changes, ElementsAre("lamps are now taken from /tmp"));
}

} // namespace
} // namespace dpslave
