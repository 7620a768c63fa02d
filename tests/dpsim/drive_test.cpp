// SPDX-License-Identifier: Apache-2.0
// A drive on an EI-ASCII line (EI-ASCII reference, sections 1 and 4); octets and checks written by hand.
#include "dpsim/drive/drive_commands.hpp"
#include "octets.hpp"

#include <gmock/gmock.h>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;

const char* const kTable = "tag,name,type,decimals,min,max,access,mnemonic,start\n"
                           "55,feedback,INT,2,-300.00,300.00,ro,,12.50\n"
                           "56,setpoint,INT,2,-105.00,105.00,rw,,0\n"
                           "120,reset,BOOL,,,,wo,,0\n"
                           "348,own name,INT,2,,,rw,9o,0\n"
                           "536,control,WORD,,,,rw,,0000\n";

const char* const kPoll55 = "04 30 30 30 30 62 6A 05";     // bj at 00
const char* const kReply55 = "02 62 6A 31 32 2E 35 03 13"; // 12.5
const char* const kPollEe = "04 30 30 30 30 45 45 05";
const char* const kWrite56 = "04 30 30 30 30 02 62 6B 31 32 2E 35 03 12"; // bk12.5

std::string error_reply(const char* code) // STX EE>code ETX and the check by hand
{
    std::uint8_t check = 'E' ^ 'E' ^ '>' ^ 0x03;
    std::string text = "02 45 45 3E";
    for (const char* c = code; *c != '\0'; ++c) {
        check = static_cast<std::uint8_t>(check ^ static_cast<unsigned char>(*c));
        text += " " + hex(Octets{static_cast<std::uint8_t>(*c)});
    }
    return text + " 03 " + hex(Octets{check});
}

class Drive : public testing::Test {
protected:
    Drive()
    {
        EXPECT_TRUE(line.add_unit("00", *parse_tags(kTable, "table.csv")));
        line.set_logging(true);
    }
    /// What the drive says to these octets within 2 s; empty = silence.
    Octets hears(const Octets& octets)
    {
        now += 20ms;
        line.on_bytes(octets, now);
        const Instant due = line.next_deadline();
        if (due == kNever || due > now + 2s) return {};
        now = due;
        return line.take_reply(now).value_or(Octets{});
    }
    Octets hears(const char* octets) { return hears(wire(octets)); }

    Instant now{1s};
    DriveLine line{Model::dc590, 2ms};
    DriveCommands commands{line};
};

TEST_F(Drive, AnswersAPollWithTheValue)
{
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, AnswersOnlyAfterTheTurnaround)
{
    line.on_bytes(wire(kPoll55), now);
    EXPECT_EQ(line.next_deadline(), now + 2ms);
    EXPECT_FALSE(line.take_reply(now + 1999us));
    EXPECT_EQ(line.take_reply(now + 2ms), wire(kReply55));
}

TEST_F(Drive, TakesAWriteAndReportsIt)
{
    EXPECT_EQ(hears(kWrite56), wire("06"));
    EXPECT_EQ(line.units()[0].find(56)->value.counts, 1250);
    EXPECT_THAT(line.take_log(), ElementsAre("tag 56 written 12.50"));
}

TEST_F(Drive, TakesTheWorkedWriteOfTag536)
{
    EXPECT_EQ(hears("04 30 30 30 30 02 6F 77 3E 30 32 30 33 03 24"), wire("06"));
    EXPECT_EQ(line.units()[0].find(536)->value.counts, 0x0203);
}

TEST_F(Drive, UsesTheMnemonicOfTheTableBeforeThatOfTheRule)
{
    ASSERT_TRUE(line.add_unit("11", *parse_tags(kTable, "table.csv")));
    EXPECT_EQ(hears("04 31 31 31 31 02 39 6F 33 30 2E 03 78"), wire("06")); // 9o30. of the 650V manual, at 11
    EXPECT_EQ(line.units()[1].find(348)->value.counts, 3000);
}

TEST_F(Drive, DeniesATagByTheRuleOfItsModelWhereItFollowsAnother)
{
    line = DriveLine{Model::dc590, 2ms, Naming{Rule::pno}};
    ASSERT_TRUE(line.add_unit("00", *parse_tags(kTable, "table.csv")));
    EXPECT_EQ(hears(kPoll55), wire("04"));
    EXPECT_EQ(hears("04 30 30 30 30 33 37 05"), wire("02 33 37 31 32 2E 35 03 1F")); // 37: 55 in hexadecimal
}

TEST_F(Drive, RepeatsThePollAfterNakWithTheNewValue)
{
    hears(kPoll55);
    commands.command("set 55 30.00", now);
    EXPECT_EQ(hears("15"), wire("02 62 6A 33 30 2E 03 26"));
}

TEST_F(Drive, GoesOnToTheNextReadableParameterAfterAck)
{
    hears("04 30 30 30 30 62 6B 05");                              // bk
    EXPECT_EQ(hears("06"), wire("02 39 6F 30 2E 03 4B"));          // 9o: tag 120 is write only
    EXPECT_EQ(hears("06"), wire("02 6F 77 3E 30 30 30 30 03 25")); // ow
    EXPECT_EQ(hears("06"), wire("04")) << "there is none behind it";
}

TEST_F(Drive, TakesAFurtherWriteWithoutAddress)
{
    hears(kWrite56);
    EXPECT_EQ(hears("02 62 6B 31 2E 30 03 25"), wire("06")); // bk1.0
    EXPECT_EQ(line.units()[0].find(56)->value.counts, 100);
}

TEST_F(Drive, EndsTheConnectionWithEot)
{
    hears(kPoll55);
    EXPECT_TRUE(hears("04").empty());
    EXPECT_TRUE(hears("15").empty());
    EXPECT_TRUE(hears("02 62 6B 31 2E 30 03 25").empty());
}

TEST_F(Drive, TakesAnAddressThatFollowsAnEarlierEot)
{
    hears("04");
    EXPECT_EQ(hears("30 30 30 30 62 6A 05"), wire(kReply55));
}

TEST_F(Drive, LooksPastAStrayOctetBehindTheCheck)
{
    EXPECT_EQ(hears(std::string{kWrite56}.append(" 00").c_str()), wire("06"));
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, TakesACheckThatLooksLikeEotForWhatItIs)
{
    // "bk>0": 62 ^ 6B ^ 3E ^ 30 ^ 03 = 04. The number is no number, but the message is one.
    EXPECT_EQ(hears("04 30 30 30 30 02 62 6B 3E 30 03 04"), wire("15"))
        << "refused for its data, not taken for an EOT";
    EXPECT_EQ(line.units()[0].error, Ee::invalid_data);
}

struct Refusal {
    const char* name;
    const char* message;
    const char* answer;
    const char* error;
};

class DriveRefusal : public Drive, public testing::WithParamInterface<Refusal> {};

TEST_P(DriveRefusal, IsReportedByEe)
{
    EXPECT_EQ(hears(GetParam().message), wire(GetParam().answer));
    EXPECT_EQ(hears(kPollEe), wire(error_reply(GetParam().error)));
}

INSTANTIATE_TEST_SUITE_P(
    EeTable, DriveRefusal,
    testing::Values(Refusal{"PollOfAnUnknownMnemonic", "04 30 30 30 30 7A 7A 05", "04", "01C7"},
                    Refusal{"WriteOfAnUnknownMnemonic", "04 30 30 30 30 02 7A 7A 31 2E 03 1C", "15", "01C7"},
                    Refusal{"WrongCheck", "04 30 30 30 30 02 62 6B 31 32 2E 35 03 13", "15", "02C2"},
                    Refusal{"PollOfAWriteOnlyParameter", "04 30 30 30 30 64 63 05", "04",
                            "04C8"}, // dc = tag 120 by the rule
                    Refusal{"WriteOfAReadOnlyParameter", "04 30 30 30 30 02 62 6A 31 2E 03 14", "15", "05C8"},
                    Refusal{"NoData", "04 30 30 30 30 02 62 6B 03 0A", "15", "07C7"},
                    Refusal{"NoPoint", "04 30 30 30 30 02 62 6B 35 03 3F", "15", "07C8"},
                    Refusal{"BeyondTheLimit", "04 30 30 30 30 02 62 6B 31 30 36 2E 03 13", "15", "08C8"}),
    [](const auto& test) { return test.param.name; });

TEST_F(Drive, SaysNoErrorFirstAndAfterAnyWriteToEe)
{
    EXPECT_EQ(hears(kPollEe), wire("02 45 45 3E 30 30 43 30 03 4E"));
    hears("04 30 30 30 30 7A 7A 05");
    EXPECT_EQ(hears(kPollEe), wire("02 45 45 3E 30 31 43 37 03 48"));
    EXPECT_EQ(hears("04 30 30 30 30 02 45 45 3E 30 30 30 30 03 3D"), wire("06"));
    EXPECT_EQ(hears(kPollEe), wire("02 45 45 3E 30 30 43 30 03 4E"));
}

TEST_F(Drive, IsSilentForAnotherAddressAndForAMalformedMessage)
{
    EXPECT_TRUE(hears("04 30 30 31 31 62 6A 05").empty());
    EXPECT_TRUE(hears("04 30 31 30 30 62 6A 05").empty()) << "group not doubled";
    EXPECT_TRUE(hears("04 30 30 30 30 62 80 05").empty()) << "no character of seven bits";
    EXPECT_TRUE(hears("04 30 30 30 30 62 05").empty()) << "one character is no mnemonic";
}

TEST_F(Drive, DropsAMessageThatStopsInItsMiddle)
{
    hears("04 30 30 30 30 02 62 6B 31 2E 03"); // the check never comes
    now += 600ms;
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, DropsAReplyThatIsOvertakenByANewMessage)
{
    line.on_bytes(wire(kPoll55), now);
    line.on_bytes(wire("04"), now + 1ms);
    EXPECT_EQ(line.next_deadline(), kNever);
}

TEST_F(Drive, AnswersForSeveralUnitsEachWithItsOwnValues)
{
    ASSERT_TRUE(line.add_unit("1A", *parse_tags(kTable, "table.csv")));
    commands.command("unit 1A", now);
    commands.command("set 55 -1.00", now);
    EXPECT_EQ(hears("04 31 31 41 41 62 6A 05"), wire("02 62 6A 2D 31 2E 03 39"));
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
    EXPECT_FALSE(line.add_unit("1A", {})) << "taken";
    EXPECT_FALSE(line.add_unit("80", {})) << "groups end at 7";
    EXPECT_FALSE(line.add_unit("0G", {}));
}

TEST_F(Drive, IsSilentOnRequestAndCarriesNothingOut)
{
    commands.command("silence", now);
    EXPECT_TRUE(hears(kPoll55).empty());
    EXPECT_TRUE(hears(kWrite56).empty());
    commands.command("ok", now);
    EXPECT_EQ(line.units()[0].find(56)->value.counts, 0);
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, SilencesOneUnitAlone)
{
    ASSERT_TRUE(line.add_unit("01", *parse_tags(kTable, "table.csv")));
    commands.command("unit 01", now);
    commands.command("silence", now);
    EXPECT_TRUE(hears("04 30 30 31 31 62 6A 05").empty());
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, RefusesWritesOnRequest)
{
    commands.command("nak 05C8", now);
    EXPECT_EQ(hears(kWrite56), wire("15"));
    EXPECT_EQ(line.units()[0].error, Ee::read_only);
    EXPECT_EQ(line.units()[0].find(56)->value.counts, 0);
}

TEST_F(Drive, SpoilsTheCheckOnRequest)
{
    commands.command("bad-bcc", now);
    EXPECT_EQ(hears(kPoll55), wire("02 62 6A 31 32 2E 35 03 12"));
}

TEST_F(Drive, SendsGarbageOnRequest)
{
    commands.command("garbage", now);
    const Octets said = hears(kPoll55);
    EXPECT_EQ(said.size(), 9U);
    EXPECT_NE(said, wire(kReply55));
}

TEST_F(Drive, IsSlowOnRequest)
{
    commands.command("slow 50ms", now);
    line.on_bytes(wire(kPoll55), now);
    EXPECT_EQ(line.next_deadline(), now + 52ms);
}

TEST_F(Drive, AnswersLateOnRequestEvenWhenItWasAskedSomethingElse)
{
    commands.command("late 900ms 1/2 tag 55", now);
    EXPECT_EQ(hears(kPoll55), wire(kReply55)) << "each second one is late";
    line.on_bytes(wire(kPoll55), now);
    line.on_bytes(wire(kPollEe), now + 100ms);
    EXPECT_EQ(line.next_deadline(), now + 902ms) << "one answer behind the other";
    EXPECT_EQ(line.take_reply(now + 902ms), wire(kReply55));
    EXPECT_FALSE(line.take_reply(now + 903ms)) << "it takes its time for each";
    EXPECT_EQ(line.take_reply(now + 904ms), wire(error_reply("00C0").c_str()));
}

TEST_F(Drive, LosesAnAnswerOnRequestAndHasDoneWhatWasAsked)
{
    commands.command("lose once", now);
    EXPECT_EQ(hears(kWrite56), Octets{});
    EXPECT_EQ(line.units()[0].find(56)->value.counts, 1250);
    EXPECT_EQ(hears(kWrite56), wire("06"));
}

TEST_F(Drive, SaysSomethingBeforeOrInPlaceOfItsAnswerOnRequest)
{
    commands.command("spoil once", now);
    line.on_bytes(wire(kPoll55), now);
    EXPECT_EQ(line.take_reply(now + 2ms), wire("02 62 6A 31 32 2E 35 03 12"));
    EXPECT_EQ(line.take_reply(now + 4ms), wire(kReply55));
    commands.command("instead 04 once", now);
    EXPECT_EQ(hears(kPoll55), wire("04"));
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
    commands.command("noise 00FF once", now);
    EXPECT_EQ(hears(kPoll55), wire(("00 FF " + std::string{kReply55}).c_str()));
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, AnswersWithATextOfItsOwnOnRequest)
{
    commands.command("text 55 12.345", now);
    EXPECT_EQ(hears(kPoll55), wire("02 62 6A 31 32 2E 33 34 35 03 14"));
    commands.command("text 55", now);
    EXPECT_EQ(hears(kPoll55), wire(kReply55));
}

TEST_F(Drive, MovesAValueAlongARamp)
{
    commands.command("ramp 55 0.00 100.00 10", now);
    EXPECT_THAT(commands.command("get 55", now + 5s), ElementsAre("tag 55 = 50.00"));
    EXPECT_THAT(commands.command("get 55", now + 20s), ElementsAre("tag 55 = 100.00"));
}

TEST_F(Drive, MovesAValueBackAndForth)
{
    commands.command("wave 55 -10.00 10.00 2", now);
    EXPECT_THAT(commands.command("get 55", now + 2s), ElementsAre("tag 55 = 10.00"));
    EXPECT_THAT(commands.command("get 55", now + 3s), ElementsAre("tag 55 = 0.00"));
    EXPECT_THAT(commands.command("get 55", now + 4s), ElementsAre("tag 55 = -10.00"));
}

TEST_F(Drive, SaysWhatIsWrongWithACommand)
{
    EXPECT_THAT(commands.command("set 55 400.00", now), ElementsAre(HasSubstr("within its limits")));
    EXPECT_THAT(commands.command("set 99 1", now), ElementsAre(HasSubstr("no tag 99")));
    EXPECT_THAT(commands.command("dance", now), ElementsAre(HasSubstr("no command 'dance'")));
    EXPECT_THAT(commands.command("unit 77", now), ElementsAre(HasSubstr("no unit '77'")));
    EXPECT_THAT(commands.command("slow down", now), ElementsAre(HasSubstr("slow 50ms")));
    EXPECT_THAT(commands.command("late", now), ElementsAre(HasSubstr("late 900ms")));
    EXPECT_THAT(commands.command("late 900ms sometimes", now), ElementsAre(HasSubstr("chooses no replies")));
    EXPECT_THAT(commands.command("instead", now), ElementsAre(HasSubstr("instead 04")));
    EXPECT_THAT(commands.command("noise", now), ElementsAre(HasSubstr("noise 00FF")));
}

} // namespace
} // namespace dpslave::sim
