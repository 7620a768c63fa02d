// SPDX-License-Identifier: Apache-2.0
// Set-ups that are broken on purpose: the first cause that the doctor names is the true one.
#include "gateway.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <optional>
#include <string>

namespace dpslave::test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

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

/// A gateway whose configuration says something else than the table does.
class Misconfigured {
public:
    Misconfigured(const std::string& from, const std::string& to, Wiring wiring = {})
        : gateway_(not_started(std::move(wiring)))
    {
        write_file(gateway_.config(), replaced(gateway_.config_text(), from, to));
        gateway_.start_daemon();
    }
    Gateway& operator*() { return gateway_; }

private:
    static Wiring not_started(Wiring wiring)
    {
        wiring.started = false;
        return wiring;
    }
    Gateway gateway_;
};

// ---------------------------------------------------------------- the bus

TEST(DoctorOfTheBus, NamesSilenceACutCableAndAPortThatVanishes)
{
    Gateway gateway;
    EXPECT_EQ(first_cause(gateway), "station.just_started") << "no cause before one can be known";
    EXPECT_TRUE(first_cause_is(gateway, "bus.silent")) << "no master at all";
    EXPECT_THAT(evidence(gateway), HasSubstr("not one octet"));

    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));

    gateway.bus().send_line("cut");
    EXPECT_TRUE(first_cause_is(gateway, "bus.silent")) << "the cable is cut";
    EXPECT_THAT(evidence(gateway), HasSubstr("the last octet from the bus was received"));

    gateway.unplug_bus();
    EXPECT_TRUE(first_cause_is(gateway, "bus.gone")) << "the adapter was pulled";
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("is missing"));
}

TEST(DoctorOfTheBus, NamesAFixedRateThatIsNotThatOfTheBus)
{
    Misconfigured wrong{"baud = 187500\n", "baud = 500000\n"};
    Gateway& gateway = *wrong;
    Master master{gateway, {"--tags", "55", "--slot-ms", "50"}};
    master.send_line("start 100s");

    EXPECT_TRUE(first_cause_is(gateway, "bus.rate"));
    EXPECT_THAT(evidence(gateway), HasSubstr("fixed at 500 kbit/s"));
}

TEST(DoctorOfTheBus, NamesTheOtherAddressThatTheMasterAsksFor)
{
    Gateway gateway;
    {
        Master master{gateway, {"--tags", "55"}, 7};
        for (int i = 0; i < 20; ++i) // Slave_Diag of address 7 by master 2
            EXPECT_TRUE(master.does("send 68 05 05 68 87 82 6D 3C 3E F0 16"));
        EXPECT_TRUE(first_cause_is(gateway, "bus.other_address"));
        EXPECT_THAT(evidence(gateway), HasSubstr("asks for address 7"));
    }
    Master ours{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(ours.does("start 30s"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));
}

TEST(DoctorOfTheBus, NamesAnAddressThatIsUsedTwice)
{
    Gateway gateway;
    Master other{gateway, {"--master", "5", "--tags", "55", "--slot-ms", "50"}, 9};
    other.send_line("start 100s");

    EXPECT_TRUE(first_cause_is(gateway, "bus.double_address"));
}

TEST(DoctorOfTheBus, NamesNoiseAndDropsItWhenItIsOver)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w", "--retries", "15"}};
    ASSERT_TRUE(master.does("start 30s"));
    gateway.bus().send_line("errors 0.0005");

    EXPECT_TRUE(first_cause_is(gateway, "bus.flaws"));
    EXPECT_THAT(evidence(gateway), HasSubstr("damaged telegrams"));
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

TEST(DoctorOfTheMaster, NamesClear)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    ASSERT_TRUE(master.does("clear"));

    EXPECT_TRUE(first_cause_is(gateway, "station.clear"));
    EXPECT_THAT(gateway.dpctl({"io"}).out, Not(HasSubstr("outputs go to the drive")));
    EXPECT_THAT(gateway.dpctl({"status"}).out, HasSubstr("Data_Exch in Clear"));
    EXPECT_EQ(gateway.dpctl({"status", "--wait", "0", "--quiet"}).status, 0);
    EXPECT_EQ(gateway.dpctl({"status", "--wait", "0", "--quiet", "--drive"}).status, 1);

    ASSERT_TRUE(master.does("operate"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));
}

TEST(DoctorOfTheMaster, NamesASecondMasterThatHasThisSlaveInItsProject)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));

    EXPECT_TRUE(master.does("send 68 0C 0C 68 85 83 6D 3D 3E B8 02 0A 0B 05 33 00 F7 16"));
    EXPECT_TRUE(first_cause_is(gateway, "station.two_masters"));
    EXPECT_THAT(evidence(gateway), HasSubstr("master 2 has this slave"));
}

TEST(DoctorOfTheMaster, SaysOfOutputsOfAWrongLengthThatTheyAreThat)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(master.does("start 30s"));
        EXPECT_TRUE(master.does("try send 68 04 04 68 05 02 6D 01 75 16"));
        EXPECT_TRUE(gateway.daemon().says("Data_Exchange of a wrong length"));
    }
    EXPECT_TRUE(first_cause_is(gateway, "station.output_length"));
}

TEST(DoctorOfTheMaster, NamesAWatchdogThatIsShorterThanItsCycle)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w", "--watchdog", "100", "--cycle", "400"}};
    for (int i = 0; i < 20; ++i) master.send_line("try start 5s"); // the slave drops its parameters each time

    EXPECT_TRUE(first_cause_is(gateway, "station.watchdog"));
}

// ---------------------------------------------------------------- tags

TEST(DoctorOfTags, NamesAValueOutOfRangeThatTheMasterSendsButNoTypingErrorOfDpctl)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    const Outcome typo = gateway.dpctl({"read", "999"});
    EXPECT_EQ(typo.status, 1);
    EXPECT_THAT(typo.err, HasSubstr("has no line for tag 999"));
    EXPECT_TRUE(first_cause_is(gateway, "well")) << "a wrong tag in a dpctl command is no fault of the plant";
    EXPECT_THAT(gateway.dpctl({"write", "56", "5"}).out, HasSubstr("will overwrite it"));

    ASSERT_TRUE(master.does("out 1 = 20000"));
    EXPECT_TRUE(first_cause_is(gateway, "station.range"));
}

TEST(DoctorOfTags, NamesModulesInTheWrongOrder)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55w,56"}};
    ASSERT_TRUE(master.does("start 30s"));
    ASSERT_TRUE(master.does("out 1 = 500"));
    EXPECT_TRUE(first_cause_is(gateway, "station.read_only"));
}

TEST(DoctorOfTags, NamesATagThatTheDriveDoesNotKnow)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,999"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(first_cause_is(gateway, "station.tags"));
}

// ---------------------------------------------------------------- the drive

/// A master that exchanges data with a drive on which all is well.
class SickDrive : public ::testing::Test {
protected:
    void begins(Wiring wiring = {})
    {
        gateway.emplace(std::move(wiring));
        master.emplace(*gateway, Arguments{"--tags", "55,57,56w"});
        ASSERT_TRUE(master->does("start 30s"));
        ASSERT_TRUE(is("well"));
    }
    /// The first finding of the station: what a loaded machine does to the bus is not meant here.
    Json first() const
    {
        const Json reply = gateway->json({"doctor"});
        for (const Json& one : reply.at("findings"))
            if (!one.at("station").is_null()) return one;
        return {{"rule", "well"}, {"evidence", ""}, {"steps", Json::array()}};
    }
    ::testing::AssertionResult is(const std::string& rule) const
    {
        std::string seen;
        if (eventually([&] { return (seen = first().at("rule")) == rule; }))
            return ::testing::AssertionSuccess();
        return ::testing::AssertionFailure() << "the first cause is " << seen << ", not " << rule;
    }
    std::string evidence() const { return first().at("evidence"); }
    std::string steps() const { return first().at("steps").dump(); }
    std::optional<Gateway> gateway;
    std::optional<Master> master;
};

TEST_F(SickDrive, WithNoiseOnItsCableIsNamedWithCounts)
{
    begins();
    gateway->drive_line().send_line("errors 0.0005");

    EXPECT_TRUE(is("drive.damaged"));
    EXPECT_THAT(evidence(), ContainsRegex("[0-9]+ answers could not be read in the last minute, .*"
                                          "beside [0-9]+ good ones"));
    EXPECT_THAT(steps(), HasSubstr("screen"));
}

TEST_F(SickDrive, ThatAnswersGarbageIsNotCalledSilent)
{
    begins();
    gateway->drive().send_line("garbage");

    EXPECT_TRUE(is("drive.unreadable"));
    EXPECT_THAT(evidence(), AllOf(HasSubstr("could not be read"), HasSubstr("it answered well before"),
                                  HasSubstr("38.4 kbit/s, 7E1")));
    EXPECT_THAT(steps(), AllOf(HasSubstr("rate and format"), HasSubstr("--probe")));
}

TEST_F(SickDrive, ThatAnswersWithAWrongChecksumIsDistinguishedFromGarbage)
{
    begins();
    gateway->drive().send_line("bad-bcc");

    EXPECT_TRUE(is("drive.unreadable"));
    EXPECT_THAT(evidence(), HasSubstr("all of them only for a wrong checksum"));
}

TEST_F(SickDrive, ThatWasNeverReadableIsNotSaidToHaveNeverAnswered)
{
    gateway.emplace(Wiring{.drive = {"--fault", "bad-bcc"}});

    master.emplace(*gateway, Arguments{"--tags", "55"});
    master->send_line("start 30s");
    EXPECT_TRUE(is("drive.unreadable"));
    EXPECT_THAT(evidence(), HasSubstr("none was ever good"));
}

TEST_F(SickDrive, WhoseLineHearsItselfIsNotBlamed)
{
    begins();
    gateway->drive().send_line("echo on");

    EXPECT_TRUE(is("drive.echo"));
    EXPECT_THAT(evidence(), HasSubstr("receives what it sends, and [[line]] echo is off"));
    EXPECT_THAT(steps(), HasSubstr("in the [[line]] of this drive"));
}

/// Of the timeout_ms that the doctor asks for, in milliseconds; 0: of none.
int timeout_asked_for(const std::string& said)
{
    const std::string words = "set timeout_ms = ";
    const std::size_t at = said.find(words);
    return at == std::string::npos ? 0 : std::stoi(said.substr(at + words.size()));
}

TEST_F(SickDrive, ThatIsAlwaysLateIsReportedWithTheTimeoutThatItNeeds)
{
    begins();
    gateway->drive().send_line("slow 300");

    EXPECT_TRUE(is("drive.late"));
    EXPECT_TRUE(eventually([&] { return timeout_asked_for(evidence()) != 0; }));
    const int needed = timeout_asked_for(evidence());
    EXPECT_GE(needed, 300);
    EXPECT_LT(needed, 1000) << "it is measured when the answer comes, not when the next question is asked";

    write_file(gateway->config(), replaced(gateway->config_text(), "[[station]]",
                                           fmt::format("timeout_ms = {}\n[[station]]", needed)));
    EXPECT_EQ(gateway->dpctl({"reload"}).status, 0);
    EXPECT_TRUE(is("well")) << "what the doctor advises helps";
}

TEST_F(SickDrive, ThatRefusesOurChecksumHasThatAsItsOwnCause)
{
    begins();
    gateway->drive().send_line("nak 02C2");

    EXPECT_TRUE(is("drive.not_accepted"));
    EXPECT_THAT(evidence(), HasSubstr("wrong checksum (EE 02)"));
    EXPECT_THAT(steps(), HasSubstr("from the gateway to the drive"));
}

TEST_F(SickDrive, ThatRefusesTheFormOfARequestIsDistinguishedFromAChecksum)
{
    begins();
    gateway->drive().send_line("nak 07C7");

    EXPECT_TRUE(is("drive.not_understood"));
}

TEST_F(SickDrive, WhosePortVanishesIsNamedAndWellAgainWhenItReturns)
{
    begins();
    gateway->unplug_drive();

    EXPECT_TRUE(is("drive.gone"));
    EXPECT_THAT(evidence(), HasSubstr("of line p3 is not there"));
    EXPECT_THAT(gateway->dpctl({"status"}).out, HasSubstr("port missing"));
    EXPECT_THAT(steps(), HasSubstr("/dev/serial/by-id"));

    gateway->plug_drive();
    EXPECT_TRUE(is("well"));
}

TEST_F(SickDrive, WithALoosePlugComesAndGoes)
{
    begins();
    gateway->drive().send_line("lose 1/2");

    EXPECT_TRUE(is("drive.unsteady"));
    EXPECT_THAT(steps(), HasSubstr("plugs at both ends"));
}

TEST(DoctorOfTheDrive, ThatHasNoneOfTheTagsIsOfAnotherType)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "1201,1202"}};
    ASSERT_TRUE(master.does("start 30s"));

    EXPECT_TRUE(first_cause_is(gateway, "station.other_device"));
}

TEST(DoctorOfTheDrive, NamesATableThatGivesAnotherTypeThanTheDrive)
{
    Misconfigured wrong{"tags = ", "# tags = "};
    Gateway& gateway = *wrong;
    write_file(gateway.folder("word.csv"), "tag,type\n55,WORD\n");
    write_file(gateway.config(), gateway.config_text().replace(gateway.config_text().find("tags = "), 6,
                                                               "tags = \"word.csv\" #"));
    EXPECT_EQ(gateway.dpctl({"reload"}).status, 0);
    Master master{gateway, {"--tags", "55"}};
    ASSERT_TRUE(master.does("start 30s"));

    EXPECT_TRUE(first_cause_is(gateway, "station.other_type"));
}

TEST(DoctorOfTheDrive, NamesOneThatFellSilent)
{
    Gateway gateway;
    Master master{gateway, {"--tags", "55,56w"}};
    ASSERT_TRUE(master.does("start 30s"));
    EXPECT_TRUE(first_cause_is(gateway, "well"));

    gateway.drive().send_line("silence");
    EXPECT_TRUE(first_cause_is(gateway, "drive.silent"));
}

TEST(DoctorOfTheDrive, FindsAUnitThatIsAnotherOne)
{
    Misconfigured wrong{"unit = \"03\"", "unit = \"05\"", {.units = {"03"}}};
    Gateway& gateway = *wrong;
    Master master{gateway, {"--tags", "55"}};
    master.send_line("start 100s");
    EXPECT_TRUE(first_cause_is(gateway, "drive.never"));
    EXPECT_THAT(evidence(gateway), HasSubstr("unit 05"));

    EXPECT_EQ(gateway.dpctl({"doctor", "--probe"}).status, 1) << "the station is in exchange";
    const Outcome probe = gateway.dpctl({"doctor", "--probe", "--yes"});
    EXPECT_EQ(probe.status, 0) << probe.err;
    EXPECT_THAT(probe.out, HasSubstr("ei-ascii unit 03 at 38.4 kbit/s, 7E1"));
    EXPECT_THAT(probe.err,
                ContainsRegex("searching for the drive of unwinder on .*: [0-9]+ s at most; Ctrl-C ends it"));
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
    EXPECT_EQ(which.status, 1);
    EXPECT_THAT(which.err, HasSubstr("for example: unwinder")) << "here it is no option";

    Process probe{gateway.dpctl_command({"doctor", "--probe", "rewinder"})};
    EXPECT_TRUE(probe.says("at most; Ctrl-C ends it"));
    EXPECT_EQ(probe.end(SIGINT), 1);
    EXPECT_TRUE(gateway.daemon().says("rewinder: the search for the drive was ended"));
    EXPECT_FALSE(probe.transcript().await("a drive answers", 0, {}))
        << "the drive of unwinder is not the one";
    EXPECT_TRUE(eventually([&] { return gateway.station(0).at("drive").at("link") == "answers"; }));
    EXPECT_THAT(gateway.dpctl({"read", "55", "--station", "unwinder"}).out, HasSubstr("12.50"));
}

TEST(DoctorOfTheDrive, FindsARateThatIsAnotherOne)
{
    Wiring wiring;
    wiring.drive_baud = 19'200;
    Misconfigured wrong{"baud = 19200", "baud = 9600\ntimeout_ms = 50", std::move(wiring)};
    Gateway& gateway = *wrong;
    EXPECT_TRUE(eventually([&] { return gateway.station().at("drive").at("link") == "silent"; }));

    const Outcome probe = gateway.dpctl({"doctor", "--probe"});
    EXPECT_EQ(probe.status, 0) << probe.err;
    EXPECT_THAT(probe.out, HasSubstr("ei-ascii unit 00 at 19.2 kbit/s, 7E1"));
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
            {"--family", "technology-box", "--ident", "0x1649", "--tags", "55,56w", "--watchdog", "200"}};
        ASSERT_TRUE(master.does("start 30s"));
        ASSERT_TRUE(master.does("out 1 = 500"));
        EXPECT_TRUE(gateway.drive().says("tag 56 written 5.00"));
        const Outcome silenced = gateway.dpctl({"tec", "set", "RIDE_THROUGH", "99"});
        EXPECT_EQ(silenced.status, 1);
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
