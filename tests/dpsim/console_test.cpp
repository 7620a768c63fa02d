// SPDX-License-Identifier: Apache-2.0
// The script language of `dpsim master` on a simulated clock.
#include "dpsim/master/console.hpp"
#include "master_bench.hpp"

#include <gmock/gmock.h>

#include <map>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

/// An option board whose process data is one input word.
MasterSettings board_without_outputs()
{
    MasterSettings s;
    s.cfg = {0x73, 0x50};
    return s;
}

/// A slave that says yes to everything and answers Data_Exchange with `inputs`: frames made by hand below.
class ConsoleTest : public testing::Test {
protected:
    static Octets sd2(Octets body)
    {
        std::uint8_t fcs = 0;
        for (const std::uint8_t octet : body) fcs = static_cast<std::uint8_t>(fcs + octet);
        const auto le = static_cast<std::uint8_t>(body.size());
        Octets frame{0x68, le, le, 0x68};
        frame.insert(frame.end(), body.begin(), body.end());
        frame.push_back(fcs);
        frame.push_back(0x16);
        return frame;
    }
    Octets answer(const Octets& request)
    {
        if (silent) return {};
        if (request[0] == 0x10) return wire("10 02 05 00 07 16");
        if (request[4] == 0xFF) return {};
        if (request[4] == 0x05) {
            requests.emplace_back(request.begin() + 7, request.end() - 2);
            Octets body{0x02, 0x05, static_cast<std::uint8_t>(high_priority ? 0x0A : 0x08)};
            const Octets inputs = drive ? drive(requests.back()) : Octets(10, 0);
            body.insert(body.end(), inputs.begin(), inputs.end());
            return sd2(body);
        }
        if (request[7] != 0x3C) return wire("E5");
        Octets body = wire("82 85 08 3E 3C");
        body.insert(body.end(), diagnosis.begin(), diagnosis.end());
        return sd2(body);
    }
    /// One command, with the bus running for as long as it waits (at most 60 s).
    void run(const std::string& line)
    {
        console.command(line, "script:1: ", now);
        for (const Instant end = now + 60s; now < end;) {
            console.on_time(now);
            master.on_time(now);
            console.on_time(now);
            for (const std::string& said : console.take_lines()) text += said + "\n";
            if (!console.busy()) return;
            if (const auto telegram = master.take_transmit(now)) {
                now += 1ms;
                if (const Octets reply = answer(*telegram); !reply.empty()) master.on_bytes(reply, now);
                continue;
            }
            now = std::max(now + 1us, std::min(master.next_deadline(), console.next_deadline()));
        }
        ADD_FAILURE() << line << " never ended";
    }

    Instant now{1s};
    Master master{board_without_outputs()};
    Console console{master, now};
    bool silent = false, high_priority = false;
    Octets diagnosis = wire("00 0C 00 02 05 33");
    std::vector<Octets> requests;
    std::function<Octets(const Octets&)> drive;
    std::string text;
};

TEST_F(ConsoleTest, StartsAndWaitsForAnInput)
{
    drive = [&](const Octets&) {
        return requests.size() > 20 ? wire("00 00 00 00 00 00 00 00 04 E2") : Octets(10, 0);
    };
    run("start");
    run("wait 2s for in1 = 1250");
    run("expect in 1 = 1250");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_THAT(text, HasSubstr("station is in data exchange"));
}

TEST_F(ConsoleTest, FailsWithASentenceWhenAnExpectationIsNotMet)
{
    run("start");
    run("expect in 1 = 7");
    EXPECT_NE(console.exit(), 0);
    EXPECT_THAT(text, HasSubstr("script:1: expect in 1 = 7: in 1 is 0 (0x0000)"));
}

TEST_F(ConsoleTest, ForgivesWhatWasOnlyTried)
{
    run("start");
    run("try expect in 1 = 7");
    EXPECT_EQ(console.exit(), 0);
}

TEST_F(ConsoleTest, FailsWhenAConditionDoesNotComeInTime)
{
    run("start");
    run("wait 500ms for in 1 > 0");
    EXPECT_NE(console.exit(), 0);
    EXPECT_THAT(text, HasSubstr("not in time, in 1 is 0"));
}

TEST_F(ConsoleTest, ReportsThatNoStationAnswers)
{
    silent = true;
    run("start 1s");
    EXPECT_NE(console.exit(), 0);
    EXPECT_THAT(text, HasSubstr("station 5 does not answer"));
}

TEST_F(ConsoleTest, ExplainsTheDiagnosisWhenTheStartIsRefused)
{
    diagnosis = wire("06 05 00 FF 05 33");
    run("start");
    EXPECT_NE(console.exit(), 0);
    EXPECT_THAT(text, HasSubstr("Chk_Cfg was refused"));
    EXPECT_THAT(text, HasSubstr("Cfg_Fault"));
    run("try expect diag cfg-fault");
    EXPECT_THAT(text, HasSubstr("as expected, the diagnosis is 06 05 00 FF 05 33"));
}

TEST_F(ConsoleTest, SetsOutputWords)
{
    master.stop();
    run("out 1 = 500");
    EXPECT_THAT(text, HasSubstr("there are 0 output words"));
}

/// A gateway with Demand Data: answers an order only after some cycles, the old answer stays until then.
class DemandConsoleTest : public ConsoleTest {
protected:
    DemandConsoleTest()
    {
        drive = [this](const Octets& out) {
            if (out[0] >> 4 == 0) {
                answered = Octets(10, 0);
                since = requests.size();
            } else if (requests.size() > since + 3) {
                answered = reply_to(out);
            }
            return answered;
        };
    }
    virtual Octets reply_to(const Octets& out)
    {
        Octets in(10, 0);
        in[0] = static_cast<std::uint8_t>((rejects ? 0x70 : 0x10) | (out[0] & 0x07));
        in[1] = out[1];
        in[7] = rejects ? 1 : 42;
        return in;
    }
    bool rejects = false;
    Octets answered = Octets(10, 0);
    std::size_t since = 0;
};

TEST_F(DemandConsoleTest, ReadsATag)
{
    run("start");
    run("demand read 55");
    run("expect demand = 42");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_THAT(text, HasSubstr("tag 55 = 42"));
    EXPECT_EQ(hex(requests.back()), "10 37 00 00 00 00 00 00");
}

TEST_F(DemandConsoleTest, PutsNoCommandBetweenTwoOrdersOfOneTag)
{
    run("start");
    run("demand read 55");
    const std::size_t before = requests.size();
    run("demand write 55 1000");
    EXPECT_EQ(hex(requests[before]), "00 00 00 00 00 00 00 00");
    EXPECT_EQ(hex(requests.back()), "20 37 00 00 00 00 03 E8");
    EXPECT_EQ(console.exit(), 0) << text;
}

TEST_F(DemandConsoleTest, ShowsARejectionWithItsReason)
{
    rejects = true;
    run("start");
    run("demand write 55 1000");
    run("expect demand reject 1");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_THAT(text, HasSubstr("tag 55 rejected, 1: read-only parameter"));
    run("demand none");
    run("expect demand none");
    EXPECT_EQ(console.exit(), 0) << text;
}

TEST_F(DemandConsoleTest, SetsTheFourRegistersAsTheyAre)
{
    run("start");
    run("demand raw 8462 0 0 1");
    run("wait 5s for demand reg 1 = 4366");
    EXPECT_EQ(hex(requests.back()), "21 0E 00 00 00 00 00 01");
    run("demand raw 0x104C");
    run("wait 5s for demand reg 1 = 4172");
    run("expect demand reg 4 & 0x0008 = 8");
    EXPECT_EQ(console.exit(), 0) << text;
    run("demand");
    EXPECT_THAT(text, HasSubstr("request 104C 0000 0000 0000"));
    EXPECT_THAT(text, HasSubstr("answer  104C 0000 0000 002A"));
}

/// An instrument with the extended commands: each tag holds what was written, or its own number.
class ExtendedConsoleTest : public DemandConsoleTest {
protected:
    Octets reply_to(const Octets& out) override
    {
        const std::uint16_t tag = be16(out, 2);
        Octets in(10, 0);
        if (out[0] == 0x40) held[tag] = be16(out, 6);
        const bool refused = tag == missing;
        const auto value = refused ? std::uint16_t{0} : held.try_emplace(tag, tag).first->second;
        const auto first = static_cast<std::uint16_t>(!as_example ? (refused ? 0x7000 : 0x1000)
                                                                  : (refused ? 0x7000 + tag : out[0] << 8));
        in[0] = high(first);
        in[1] = low(first);
        in[2] = out[2];
        in[3] = out[3];
        in[6] = high(value);
        in[7] = low(value);
        return in;
    }
    std::map<std::uint16_t, std::uint16_t> held;
    std::uint16_t missing = 9000;
    bool as_example = false;
};

TEST_F(ExtendedConsoleTest, ReadsAndWritesATagAbove2047)
{
    run("start");
    run("demand read-ext 8328");
    EXPECT_EQ(hex(requests.back()), "30 00 20 88 00 00 00 00");
    run("expect demand = 8328");
    run("demand write-ext 8328 -2");
    EXPECT_EQ(hex(requests.back()), "40 00 20 88 00 00 FF FE");
    run("expect demand = -2");
    EXPECT_EQ(console.exit(), 0) << text;
    run("demand write-ext 9000 1");
    run("expect demand reject 0");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_THAT(text, HasSubstr("tag 9000 rejected, 0: invalid tag number"));
}

TEST_F(ExtendedConsoleTest, UnderstandsTheAnswersOfWorkedExample2)
{
    as_example = true;
    run("start");
    run("demand read-ext 8329");
    run("expect demand = 8329");
    run("demand read-ext 9000");
    run("expect demand reject 0");
    EXPECT_EQ(console.exit(), 0) << text;
}

TEST_F(ExtendedConsoleTest, UploadsABlockOneTagARequestAfterCommand0)
{
    run("start");
    const std::size_t before = requests.size();
    run("demand upload 8328 136");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_EQ(hex(requests[before]), "00 00 00 00 00 00 00 00");
    std::vector<std::uint16_t> asked;
    for (std::size_t i = before; i < requests.size(); ++i)
        if (requests[i][0] == 0x30 && (asked.empty() || asked.back() != be16(requests[i], 2)))
            asked.push_back(be16(requests[i], 2));
    ASSERT_EQ(asked.size(), 136U) << "each once";
    EXPECT_EQ(asked.front(), 8328);
    EXPECT_EQ(asked.back(), 8463);
    EXPECT_THAT(text, HasSubstr("tag 8336 = 8336 8337 8338 8339 8340 8341 8342 8343\n"));
    EXPECT_THAT(text, HasSubstr("136 values uploaded, tags 8328 to 8463"));
}

TEST_F(ExtendedConsoleTest, DownloadsTheBlockThatWasUploadedOrOtherValues)
{
    run("start");
    run("demand upload 8328 3");
    run("demand download 8464");
    EXPECT_EQ(held.at(8464), 8328);
    EXPECT_EQ(held.at(8466), 8330);
    EXPECT_THAT(text, HasSubstr("3 values downloaded, tags 8464 to 8466"));
    run("demand download 8328 5 0x0006 -7");
    EXPECT_EQ(held.at(8328), 5);
    EXPECT_EQ(held.at(8329), 6);
    EXPECT_EQ(held.at(8330), 0xFFF9);
    EXPECT_EQ(console.exit(), 0) << text;
}

TEST_F(ExtendedConsoleTest, EndsATransferAtTheFirstTagThatIsRefused)
{
    missing = 8330;
    run("start");
    run("demand download 8328 1 2 3 4");
    EXPECT_NE(console.exit(), 0);
    EXPECT_THAT(text, HasSubstr("tag 8330 rejected, 0: invalid tag number after 2 values"));
    EXPECT_EQ(held.count(8331), 0U);
}

TEST_F(ExtendedConsoleTest, SaysWhatIsWrongWithATransfer)
{
    run("start");
    run("demand download 8328");
    EXPECT_THAT(text, HasSubstr("nothing was uploaded yet"));
    run("demand upload 65535 2");
    EXPECT_THAT(text, HasSubstr("the last tag would be above 65535"));
    run("demand upload 8328");
    EXPECT_THAT(text, HasSubstr("demand upload 8328 136"));
    run("demand raw 1 2 3 4 5");
    EXPECT_THAT(text, HasSubstr("demand raw 8462 0 0 1"));
}

TEST_F(ConsoleTest, PrintsAChangedDiagnosisOnceInWords)
{
    run("start");
    high_priority = true;
    diagnosis = wire("00 0C 00 02 05 33 03 40 30");
    run("wait 2s for diag ext 03 40 30");
    run("run 1s");
    EXPECT_EQ(console.exit(), 0) << text;
    const auto first = text.find("summary output status 4030, manual mode, sensor break, IP1 fault");
    EXPECT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find("summary output status", first + 1), std::string::npos) << text;
    diagnosis = wire("00 0C 00 02 05 33 03 00 00");
    run("wait 2s for diag ext 03 00 00");
    EXPECT_THAT(text, HasSubstr("summary output status 0000, no bit"));
    run("try expect diag ext 03 00");
    EXPECT_THAT(text, HasSubstr("expect diag ext 03 00: the diagnosis is 00 0C 00 02 05 33 03 00 00"));
}

TEST_F(ConsoleTest, ReadsAndExplainsTheDiagnosis)
{
    run("start");
    run("diag");
    EXPECT_THAT(text, HasSubstr("ident 0x0533, owned by master 2"));
    EXPECT_THAT(text, HasSubstr("WD_On"));
}

TEST_F(ConsoleTest, SendsRawOctetsAndShowsTheReply)
{
    run("send 10 05 02 49 50 16");
    run("expect reply 10 02 05 00 07 16");
    EXPECT_EQ(console.exit(), 0) << text;
    silent = true;
    run("send 10 06 02 49 51 16");
    run("expect reply none");
    EXPECT_EQ(console.exit(), 0) << text;
}

TEST_F(ConsoleTest, StaysInDataExchangeUntilItIsStopped)
{
    run("start");
    run("run 1s");
    run("expect state data-exchange");
    run("stop");
    run("expect state stopped");
    EXPECT_EQ(console.exit(), 0) << text;
    EXPECT_GT(master.counters().cycles, 90U) << "a cycle takes 10 ms";
}

TEST_F(ConsoleTest, SaysWhatIsWrongWithACommand)
{
    run("jump");
    EXPECT_THAT(text, HasSubstr("no command 'jump'"));
    run("wait for rain");
    EXPECT_THAT(text, HasSubstr("wait 2s for in 1 = 1250"));
    run("demand read 3000");
    EXPECT_THAT(text, HasSubstr("tags 0 to 2047"));
    run("send 123");
    EXPECT_THAT(text, HasSubstr("odd number"));
}

} // namespace
} // namespace dpslave::sim
