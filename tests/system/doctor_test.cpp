// SPDX-License-Identifier: Apache-2.0
// Set-ups that are broken on purpose: the first cause that the doctor names is the true one. One of each
// family, and the search. Every rule is judged in tests/dpctl/doctor_test.cpp, those of the fault matrix in
// tests/faults too.
// Only here: what the daemon has counted by itself is what the rules of the doctor ask for.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <string>

namespace dpslave::test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

/// The name of the first cause; "well" where there is none.
std::string first_cause(const Gateway& gateway)
{
    const Json found = gateway.json({"doctor"}).at("findings");
    return found.empty() ? "well" : found.at(0).at("rule").get<std::string>();
}

/// That the first cause soon is this one: the counters are looked at once a second.
::testing::AssertionResult first_cause_is(const Gateway& gateway, const std::string& rule)
{
    std::string seen;
    const auto result = eventually([&] { return (seen = first_cause(gateway)) == rule; });
    if (!result) return ::testing::AssertionFailure() << "the first cause is " << seen << ", not " << rule;
    return result;
}

std::string evidence(const Gateway& gateway)
{
    return gateway.json({"doctor"}).at("findings").at(0).at("evidence");
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error("there is no " + from);
    return text.replace(at, from.size(), to);
}

// ---------------------------------------------------------------- the bus

TEST(DoctorOfTheBus, NamesSilenceACutCableAndAPortThatVanishes)
{
    Gateway gateway;
    EXPECT_EQ(first_cause(gateway), "station.just_started") << "no cause before one can be known";
    EXPECT_TRUE(first_cause_is(gateway, "bus.silent")) << "no master at all";
    EXPECT_THAT(evidence(gateway), HasSubstr("not one octet"));

    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));

    gateway.bus().send_line("cut");
    EXPECT_TRUE(first_cause_is(gateway, "bus.silent")) << "the cable is cut";
    EXPECT_THAT(evidence(gateway), HasSubstr("the last octet from the bus was received"));

    gateway.unplug_bus();
    EXPECT_TRUE(first_cause_is(gateway, "bus.gone")) << "the adapter was pulled";
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("is missing"));
}

// ---------------------------------------------------------------- the master's project

TEST(DoctorOfTheMaster, NamesWhatIsWrongWithItsProject)
{
    Gateway gateway;
    {
        Master only_looks{gateway, {"--tags", "55"}};
        for (int i = 0; i < 3; ++i) ASSERT_TRUE(only_looks.does("diag"));
        EXPECT_TRUE(first_cause_is(gateway, "station.asked_only"));
    }
    {
        Master other_device{gateway, {"--tags", "55", "--ident", "0x1234"}};
        other_device.send_line("start 100s");
        EXPECT_TRUE(first_cause_is(gateway, "station.prm_refused"));
        EXPECT_THAT(evidence(gateway), HasSubstr("Ident_Number 0x0533, got 0x1234"));
    }
    Master other_modules{gateway, {"--tags", "55,56w", "--cfg", "7350"}};
    other_modules.send_line("start 100s");
    EXPECT_TRUE(first_cause_is(gateway, "station.cfg_refused"));
}

// ---------------------------------------------------------------- tags

TEST(DoctorOfTags, NamesAValueOutOfRangeThatTheMasterSendsButNoTypingErrorOfDpctl)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    const Outcome typo = gateway.dpctl({"read", "999"});
    EXPECT_EQ(typo.status, 5);
    EXPECT_THAT(typo.err, HasSubstr("has no line for tag 999"));
    EXPECT_TRUE(first_cause_is(gateway, "well")) << "a wrong tag in a dpctl command is no fault of the plant";
    EXPECT_THAT(gateway.dpctl({"write", "56", "5"}).out, HasSubstr("will overwrite it"));

    ASSERT_TRUE(master.does("out 1 = 20000"));
    EXPECT_TRUE(first_cause_is(gateway, "station.range"));
}

// ---------------------------------------------------------------- the drive

/// The first finding of a station: what a loaded machine does to the bus is not meant.
Json first_of_station(const Gateway& gateway)
{
    const Json reply = gateway.json({"doctor"});
    for (const Json& one : reply.at("findings"))
        if (!one.at("station").is_null()) return one;
    return {{"rule", "well"}, {"evidence", ""}};
}

/// Of the timeout_ms that the doctor asks for, in milliseconds; 0: of none.
int timeout_asked_for(const std::string& said)
{
    const std::string words = "set timeout_ms = ";
    const std::size_t at = said.find(words);
    return at == std::string::npos ? 0 : std::stoi(said.substr(at + words.size()));
}

TEST(DoctorOfTheDrive, ThatIsAlwaysLateIsReportedWithTheTimeoutThatItNeeds)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,57,56w"}};
    ASSERT_TRUE(master.does("start 60s"));
    gateway.drive().send_line("slow 300ms");

    const auto is = [&](const char* rule) {
        return eventually([&] { return first_of_station(gateway).at("rule") == rule; });
    };
    const auto asked_for = [&] { return timeout_asked_for(first_of_station(gateway).at("evidence")); };
    EXPECT_TRUE(is("drive.late"));
    EXPECT_TRUE(eventually([&] { return asked_for() != 0; }));
    const int needed = asked_for();
    EXPECT_GE(needed, 300);
    EXPECT_LT(needed, 1000) << "it is measured when the answer comes, not when the next question is asked";

    write_file(gateway.config(), replaced(gateway.config_text(), "[[station]]",
                                          fmt::format("timeout_ms = {}\n[[station]]", needed)));
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    EXPECT_TRUE(is("well")) << "what the doctor advises helps";
}

TEST(DoctorOfTheDrive, FindsAUnitThatIsAnotherOne)
{
    Wiring wiring;
    wiring.units = {"03"};
    wiring.started = false;
    Gateway gateway{wiring};
    write_file(gateway.config(), replaced(gateway.config_text(), "unit = \"03\"", "unit = \"05\""));
    gateway.start_daemon();
    Master master{gateway, {"--tags", "55"}};
    master.send_line("start 100s");
    EXPECT_TRUE(first_cause_is(gateway, "drive.never"));
    EXPECT_THAT(evidence(gateway), HasSubstr("unit 05"));

    EXPECT_EQ(gateway.dpctl({"doctor", "--probe"}).status, 5) << "the station is in exchange";
    const Outcome probe = gateway.dpctl({"doctor", "--probe", "--yes"});
    EXPECT_EQ(probe.status, 0) << probe.err;
    EXPECT_THAT(probe.out, HasSubstr("ei-ascii unit 03 at 38.4 kbit/s, 7E1"));
    EXPECT_THAT(probe.out, HasSubstr("fits          rule 590plus"));
    EXPECT_THAT(probe.err,
                ContainsRegex("searching for the drive of unwinder on .*: [0-9]+ s at most; Ctrl-C ends it"));
}

TEST(DoctorOfTheDrive, LooksForItWhileItsStationIsOffTheBusAndThenTheExchangeComesBack)
{
    Wiring wiring;
    wiring.when_drive_lost = "silent";
    Gateway gateway{wiring};
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 60s"));

    Process probe{gateway.dpctl_command({"doctor", "--probe", "--yes"})};
    EXPECT_TRUE(gateway.daemon().says("The drive is gone")) << "nobody knew whether it was";
    EXPECT_EQ(probe.end(SIGINT), 1);

    EXPECT_TRUE(eventually(
        [&] { return master.does("try start 3s") && gateway.station().at("state") == "Data_Exch"; }));
}

TEST(DoctorOfTheDrive, LooksForItUntilItIsCancelledAndThenTheLineGoesOn)
{
    Wiring wiring;
    wiring.units = {"00", "01"};
    wiring.present = {"00"};
    Gateway gateway{wiring};
    gateway.drive().send_line("unit 00");
    gateway.drive().send_line("set 55 12.50");
    EXPECT_TRUE(eventually([&] { return gateway.station(1).at("drive").at("link") == "silent"; }));

    const Outcome which = gateway.dpctl({"doctor", "--probe"});
    EXPECT_EQ(which.status, 2);
    EXPECT_THAT(which.err, HasSubstr("for example: --station unwinder"));

    Process probe{gateway.dpctl_command({"doctor", "--probe", "rewinder"})};
    EXPECT_TRUE(probe.says("at most; Ctrl-C ends it"));
    EXPECT_EQ(probe.end(SIGINT), 1);
    EXPECT_TRUE(gateway.daemon().says("rewinder: the search for the drive was ended"));
    EXPECT_FALSE(probe.transcript().await("a drive answers", 0, {}))
        << "the drive of unwinder is not the one";
    EXPECT_TRUE(eventually([&] { return gateway.station(0).at("drive").at("link") == "answers"; }));
    EXPECT_THAT(gateway.dpctl({"read", "55", "--station", "unwinder"}).out, HasSubstr("12.50"));
}

// ---------------------------------------------------------------- the technology box

TEST(DoctorOfABox, NamesATypeThatSilencesItAndTheRideThroughThatRuns)
{
    Wiring wiring;
    wiring.profile = "605";
    wiring.table = "tag,name,type,decimals,min,max,access,values,start\n"
                   "55,Speed,INT,2,-300.00,300.00,ro,,0.00\n"
                   "56,Setpoint,INT,2,-105.00,105.00,rw,,0.00\n";
    wiring.keys = "[station.tec]\nride_through = 20\n";
    Gateway gateway{wiring};
    {
        Master master{
            gateway,
            {"--family", "technology-box", "--ident", "0x1649", "--tags", "55,56w", "--watchdog", "200ms"}};
        ASSERT_TRUE(master.does("start 60s"));
        ASSERT_TRUE(master.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
        const Outcome silenced = gateway.dpctl({"tec", "set", "RIDE_THROUGH", "99"});
        EXPECT_EQ(silenced.status, 5);
        EXPECT_THAT(silenced.err, HasSubstr("--yes"));
        EXPECT_EQ(gateway.tec("RIDE THROUGH"), 20);
        ASSERT_TRUE(master.does("stop"));
    }
    EXPECT_TRUE(gateway.daemon().says("the outputs keep their values for"));
    EXPECT_TRUE(eventually([&] { return !gateway.station().at("ride").is_null(); }));
    EXPECT_THAT(gateway.dpctl({"doctor"}).out, HasSubstr("RIDE THROUGH is running"));
    EXPECT_EQ(gateway.dpctl({"tec", "set", "RIDE_THROUGH", "0"}).status, 0);
    EXPECT_TRUE(gateway.daemon().says("RIDE THROUGH is over: the outputs are set to 0"));

    EXPECT_EQ(gateway.dpctl({"tec", "set", "TYPE", "3"}).status, 0) << "no master is there";
    EXPECT_TRUE(eventually([&] {
        const Json found = gateway.json({"doctor"}).at("findings");
        for (const Json& one : found)
            if (one.at("rule") == "box.type") return true;
        return false;
    }));
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("FAULT is TYPE MISMATCH"));
}

} // namespace
} // namespace dpslave::test
