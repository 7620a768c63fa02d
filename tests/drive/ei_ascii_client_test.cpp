// SPDX-License-Identifier: Apache-2.0
#include "fake_drive.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;
using test::FakeDrive;
using test::Fault;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr UnitAddress kDc{0, 0}; ///< a 590+
constexpr UnitAddress kAc{0, 1}; ///< a 650V
constexpr UnitAddress kAbsent{1, 15};

Tag row(int number, TagType type, unsigned decimals = 0)
{
    Tag tag;
    tag.number = static_cast<std::uint16_t>(number);
    tag.type = type;
    tag.decimals = static_cast<std::uint8_t>(decimals);
    return tag;
}

class EiClient : public testing::Test {
protected:
    EiClient()
    {
        line.drives = {&dc, &ac};
        dc.parameters["ow"].text = ">0000";                              // tag 536
        dc.parameters["ox"] = {.text = ">1B0B", .read_only = true};      // tag 537
        dc.parameters["i0"] = {.text = "12.5", .min = -100, .max = 100}; // tag 288
        ac.parameters["7h"].text = "50.";                                // tag 269
        ac.parameters["9o"].text = "30.";                                // tag 348
        ac.parameters["8c"].text = "2.";                                 // tag 300
    }

    AccessError read(UnitAddress unit, const Tag& tag)
    {
        std::uint16_t value = 0xDEAD;
        const AccessError error = client.read(unit, tag, {&value, 1});
        word = value;
        return error;
    }

    AccessError write(UnitAddress unit, const Tag& tag, std::uint16_t value)
    {
        return client.write(unit, tag, {&value, 1});
    }

    std::chrono::nanoseconds time_of(const std::function<void()>& what)
    {
        const Instant before = line.time;
        what();
        return line.time - before;
    }

    FakeDrive dc{'0', '0'}, ac{'0', '1'};
    test::SimulatedLine line;
    EiAsciiClient client{
        line,
        {.baud = 9600, .timeout = 200ms},
        {{kDc, MnemonicRule::dc_590plus}, {kAc, MnemonicRule::ac}, {kAbsent, MnemonicRule::ac}}};
    std::uint16_t word = 0;
    const Tag sequence = row(536, TagType::word);
    const Tag status = row(537, TagType::word);
    const Tag demand = row(288, TagType::number, 1);
};

TEST_F(EiClient, ReadsAWordInThePollFormOfTheReference)
{
    EXPECT_EQ(read(kDc, status), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
    EXPECT_EQ(line.sent, "\x04"
                         "0000ox\x05");
    EXPECT_EQ(client.last_trouble(), "");
}

TEST_F(EiClient, WritesAWordInTheSelectFormOfTheReference)
{
    EXPECT_EQ(write(kDc, sequence, 0x0203), AccessError::none);
    EXPECT_EQ(dc.parameters["ow"].text, ">0203");
    EXPECT_EQ(line.sent, "\x04"
                         "0000\x02"
                         "ow>0203\x03\x24");
}

TEST_F(EiClient, AsksEachDriveOfTheLineByItsOwnAddressAndRule)
{
    EXPECT_EQ(read(kAc, row(348, TagType::number, 2)), AccessError::none);
    EXPECT_EQ(word, 3000);
    EXPECT_EQ(read(kDc, demand), AccessError::none);
    EXPECT_EQ(word, 125);
    EXPECT_EQ(write(kAc, row(269, TagType::number, 1), 164), AccessError::none);
    EXPECT_EQ(ac.parameters["7h"].text, "16.4");
}

TEST_F(EiClient, WritesAnEnumAsTheFamilyDoes)
{
    EXPECT_EQ(write(kAc, row(300, TagType::enumeration), 10), AccessError::none);
    EXPECT_EQ(ac.parameters["8c"].text, "10.");
    EXPECT_EQ(write(kDc, row(288, TagType::enumeration), 10), AccessError::none);
    EXPECT_EQ(dc.parameters["i0"].text, ">0A");
}

TEST_F(EiClient, TakesTheMnemonicOfTheTableBeforeTheRule)
{
    Tag tag = row(1, TagType::word);
    tag.mnemonic = "ox";
    EXPECT_EQ(read(kDc, tag), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, HasNoWordForATagWithoutMnemonic)
{
    EXPECT_EQ(read(kDc, row(40000, TagType::word)), AccessError::invalid_tag);
    EXPECT_THAT(client.last_trouble(), HasSubstr("no mnemonic for tag 40000"));
    EXPECT_EQ(write(kDc, row(40000, TagType::word), 1), AccessError::invalid_tag);
    EXPECT_EQ(line.sent, "");
}

TEST_F(EiClient, TakesAReplyWhoseBccLooksLikeNak)
{
    const std::pair<const char*, int> bcc_is_15[] = {{"16.9", 169}, {"17.8", 178}, {"18.7", 187}};
    Tag pv = row(1, TagType::number, 1);
    pv.mnemonic = "PV";
    for (const auto& [text, counts] : bcc_is_15) {
        dc.parameters["PV"].text = text;
        EXPECT_EQ(read(kDc, pv), AccessError::none) << client.last_trouble();
        EXPECT_EQ(word, counts);
    }
}

TEST_F(EiClient, CallsAnEotAnInvalidTag)
{
    EXPECT_EQ(read(kDc, row(100, TagType::word)), AccessError::invalid_tag);
    EXPECT_THAT(client.last_trouble(), HasSubstr("knows no tag 100"));
}

TEST_F(EiClient, DistinguishesAWriteOnlyParameterFromAMissingOne)
{
    dc.parameters["a0"].write_only = true;
    EXPECT_EQ(read(kDc, row(0, TagType::word)), AccessError::unsupported_type);
    EXPECT_THAT(client.last_trouble(), HasSubstr(">04C8"));
}

TEST_F(EiClient, NamesWhyAWriteIsRefusedByReadingEe)
{
    EXPECT_EQ(write(kDc, status, 1), AccessError::read_only);
    EXPECT_EQ(client.last_trouble(), "NAK, EE >05C8 (write to a read-only parameter)");
    EXPECT_EQ(write(kDc, demand, 1001), AccessError::out_of_range);
    EXPECT_THAT(client.last_trouble(), HasSubstr(">08C8"));
    EXPECT_EQ(write(kDc, row(100, TagType::word), 1), AccessError::invalid_tag);
    EXPECT_THAT(client.last_trouble(), HasSubstr(">01C7"));
}

TEST_F(EiClient, AWriteThatCountsOnceAndIsRefusedReachesTheDriveOnce)
{
    const auto once = [&](const Tag& tag, std::uint16_t value) {
        dc.selected.clear();
        const std::array<std::uint16_t, 1> written{value};
        return client.write_once(kDc, tag, written);
    };
    dc.ee = ">07C8"; // of something that was before
    EXPECT_EQ(once(status, 1), AccessError::read_only);
    EXPECT_THAT(dc.selected, ElementsAre("EE", "ox", "EE")) << "0 before it, and again for the next one";
    EXPECT_EQ(once(row(100, TagType::word), 1), AccessError::invalid_tag);
    EXPECT_EQ(dc.selected.size() - static_cast<std::size_t>(std::ranges::count(dc.selected, "EE")), 1U);
    EXPECT_EQ(once(demand, 1001), AccessError::out_of_range);
    EXPECT_EQ(std::ranges::count(dc.selected, "i0"), 1);
    EXPECT_EQ(once(demand, 1000), AccessError::none);
    EXPECT_EQ(std::ranges::count(dc.selected, "i0"), 1);
}

TEST_F(EiClient, WithoutAnAnswerForEeAWriteThatCountsOnceIsNotMade)
{
    dc.faults = {Fault::none, Fault::silent}; // EE is written, and not read
    const std::array<std::uint16_t, 1> written{1000};
    EXPECT_EQ(client.write_once(kDc, demand, written), AccessError::no_answer);
    EXPECT_EQ(dc.parameters["i0"].writes, 0U);
}

TEST_F(EiClient, SaysOfAWriteThatCountsWhetherItsWordWasSentAndSendsItOnce)
{
    Tag counts = demand;
    const std::array<std::uint16_t, 1> written{1000};
    const auto write = [&](std::vector<Fault> faults) {
        line.time += 1min; // nothing is owed any more
        line.sent.clear();
        dc.faults = {faults.begin(), faults.end()};
        const AccessError error = client.write_once(kDc, counts, written);
        dc.faults.clear();
        return error;
    };
    EXPECT_EQ(write({Fault::none, Fault::none, Fault::silent}), AccessError::no_answer);
    EXPECT_TRUE(client.has_sent());
    EXPECT_EQ(line.sent.find("i0"), line.sent.rfind("i0")) << "and it is not repeated";
    EXPECT_EQ(write({Fault::none, Fault::silent}), AccessError::no_answer);
    EXPECT_FALSE(client.has_sent()) << "EE is not read";
    EXPECT_THAT(line.sent, Not(HasSubstr("i0")));
    counts = row(100, TagType::word);
    EXPECT_EQ(write({Fault::none, Fault::none, Fault::none, Fault::silent}), AccessError::no_answer)
        << "a NAK, and EE is not read behind it";
    EXPECT_TRUE(client.has_sent());
    line.sent.clear();
    line.time += 1min;
    EXPECT_EQ(client.write_once(kDc, counts, written), AccessError::invalid_tag) << "EE says why";
    EXPECT_THAT(line.sent, Not(HasSubstr("cs"))) << "and it is not written a second time";
    line.unplugged = true;
    EXPECT_EQ(client.write_once(kDc, demand, written), AccessError::no_answer);
    EXPECT_FALSE(client.has_sent());
}

TEST_F(EiClient, TakesAValueAtTheVeryLimitOfTheDrive)
{
    EXPECT_EQ(write(kDc, demand, 1000), AccessError::none);
    EXPECT_EQ(write(kDc, demand, static_cast<std::uint16_t>(-1000)), AccessError::none);
    EXPECT_EQ(dc.parameters["i0"].text, "-100.");
    EXPECT_EQ(write(kDc, demand, static_cast<std::uint16_t>(-1001)), AccessError::out_of_range);
    EXPECT_EQ(dc.parameters["i0"].text, "-100.");
}

TEST_F(EiClient, MapsEveryEeOfARefusedWrite)
{
    const std::pair<const char*, AccessError> list[] = {
        {">01C7", AccessError::invalid_tag},       {">02C2", AccessError::not_understood},
        {">03C2", AccessError::not_understood},    {">04C8", AccessError::unsupported_type},
        {">05C8", AccessError::read_only},         {">07C7", AccessError::not_understood},
        {">07C8", AccessError::value_not_encoded}, {">08C8", AccessError::out_of_range},
        {">00C0", AccessError::not_understood},
    };
    for (const auto& [ee, error] : list) {
        dc.refuse_next = {ee, ee, ee}; // asked again, the drive says the same
        EXPECT_EQ(write(kDc, sequence, 1), error) << ee;
        EXPECT_THAT(client.last_trouble(), HasSubstr(ee));
    }
}

TEST_F(EiClient, TakesARefusalWithoutReadableEeForNoAnswer)
{
    dc.refuse_next.push_back(">05C8");
    dc.faults = {Fault::none, Fault::silent};
    EXPECT_EQ(write(kDc, sequence, 1), AccessError::no_answer);
    EXPECT_THAT(client.last_trouble(), HasSubstr("EE could not be read"));
}

TEST_F(EiClient, TakesARefusalByADriveWithoutEeForNotUnderstood)
{
    dc.refuse_next = {"nonsense"};
    EXPECT_EQ(write(kDc, sequence, 1), AccessError::not_understood);
    EXPECT_EQ(client.last_trouble(), "NAK, and the drive has no EE that says why");
}

TEST_F(EiClient, WaitsOneTimeOutForASilentDriveAndNoLonger)
{
    const auto took = time_of([this] { EXPECT_EQ(read(kAbsent, status), AccessError::no_answer); });
    EXPECT_GE(took, 200ms);
    EXPECT_LE(took, 200ms + 9 * line.character()) << "and the time of the request on the wire";
    EXPECT_EQ(client.last_trouble(), "no answer");
}

TEST_F(EiClient, GivesUpABrokenOffAnswerAfterTheGapBetweenCharacters)
{
    dc.faults = {Fault::half_answer};
    const auto took = time_of([this] { EXPECT_EQ(read(kDc, status), AccessError::no_answer); });
    EXPECT_LT(took, 8 * line.character() + dc.turnaround + 5 * line.character() + 22ms);
    EXPECT_EQ(client.last_trouble(), "the answer broke off");
}

TEST_F(EiClient, WaitsLongerBetweenCharactersOnASlowLine)
{
    test::SimulatedLine slow{300};
    slow.drives = {&dc};
    EiAsciiClient on_slow{slow, {.baud = 300, .timeout = 200ms}, {{kDc, MnemonicRule::dc_590plus}}};
    std::uint16_t value = 0;
    EXPECT_EQ(on_slow.read(kDc, status, {&value, 1}), AccessError::none);
    EXPECT_EQ(value, 0x1B0B);
}

TEST_F(EiClient, DoesNotAcceptAnAnswerWithAWrongBcc)
{
    dc.faults = {Fault::bad_bcc};
    EXPECT_EQ(read(kDc, status), AccessError::no_answer);
    EXPECT_EQ(client.last_trouble(), "a wrong BCC");
    EXPECT_EQ(read(kDc, status), AccessError::none);
}

TEST_F(EiClient, DoesNotAcceptAnAnswerForAnotherParameter)
{
    dc.faults = {Fault::wrong_parameter};
    EXPECT_EQ(read(kDc, status), AccessError::no_answer);
    EXPECT_EQ(client.last_trouble(), "asked for 'ox', answered for 'zz'");
}

TEST_F(EiClient, IsInStepAgainAfterAStrayOctet)
{
    dc.faults = {Fault::stray_octet};
    EXPECT_EQ(read(kDc, status), AccessError::no_answer);
    EXPECT_EQ(read(kDc, status), AccessError::none) << "the rest of the bad answer was drained";
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, SkipsTheNoiseOfATransceiver)
{
    dc.faults = {Fault::glitch};
    EXPECT_EQ(read(kDc, status), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, DropsWhatCameBeforeItsRequest)
{
    line.comes_by_itself("\x02ox>0001\x03\x2C");
    line.time += 1s;
    EXPECT_EQ(read(kDc, status), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, ReturnsFromALineThatBabbles)
{
    line.comes_by_itself(std::string(5000, 'U'));
    line.time += 1ms;
    const auto took = time_of([this] { EXPECT_EQ(read(kAbsent, status), AccessError::no_answer); });
    EXPECT_LT(took, 500ms);
}

TEST_F(EiClient, ReturnsWithinItsDeadlineFromALineWithEndlessNoise)
{
    // The timeout and the request, the longest answer with a gap, then twice that for what is drained.
    const auto longest = 200ms + 8 * line.character() + (1 + 2) * 85 * line.character() + 2 * 21ms;
    for (const char octet : {'U', '\xFF', '\x15', '\x02', '\x04'})
        for (const auto every : {std::chrono::nanoseconds{1ms}, std::chrono::nanoseconds{19ms}}) {
            line.babbles(octet, every);
            const auto read_took = time_of([this] { (void)read(kAbsent, status); });
            EXPECT_LE(read_took, longest) << int{octet};
            const auto probe_took = time_of([this] { (void)client.probe(kAbsent); });
            EXPECT_LE(probe_took, longest) << int{octet};
            const auto write_took = time_of([this] { (void)write(kAbsent, status, 1); });
            EXPECT_LE(write_took, 2 * longest) << int{octet} << ": a NAK, then EE";
        }
}

TEST_F(EiClient, AnEotThatNoDriveStandsBehindIsNoiseAndNoVerdictOnTheTag)
{
    line.comes_by_itself("\x04", 15ms);

    EXPECT_EQ(read(kAbsent, status), AccessError::no_answer);
    EXPECT_EQ(client.last_trouble(), "an EOT, but no answer for EE after it: noise");
}

TEST_F(EiClient, GivesUpADriveThatSendsTooSlowlyAtItsDeadline)
{
    line.comes_by_itself("\x02ox>", 15ms);
    line.babbles('0', 19ms, 30ms);
    const auto took = time_of([this] { EXPECT_EQ(read(kAbsent, status), AccessError::no_answer); });
    EXPECT_LE(took, 200ms + 8 * line.character() + 85 * line.character() + 21ms);
    EXPECT_EQ(client.last_trouble(), "an answer that does not end");
}

TEST_F(EiClient, WaitsForAnAnswerBehindNoise)
{
    for (int i = 0; i < 15; ++i) line.comes_by_itself("\xFF", i * 10ms);
    dc.turnaround = 180ms;
    EXPECT_EQ(read(kDc, status), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, SaysSoWhenTheLineIsUnplugged)
{
    line.unplugged = true;
    EXPECT_EQ(read(kDc, status), AccessError::no_answer);
    EXPECT_THAT(client.last_trouble(), HasSubstr("does not accept"));
    EXPECT_NE(client.probe(kDc), AccessError::none);
}

TEST_F(EiClient, RefusesMoreDecimalsThanTheTableHasAndSaysWhich)
{
    dc.parameters["i0"].text = "12.345";
    EXPECT_EQ(read(kDc, demand), AccessError::contradicted);
    EXPECT_EQ(client.last_trouble(),
              "it answers '12.345', but its row says INT, 1 decimal: it has more decimals than the tag "
              "table gives; the tag is refused until the table is corrected and loaded again");
}

TEST_F(EiClient, ReportsAValueThatDoesNotFitInsteadOfClampingIt)
{
    dc.parameters["i0"].text = "3276.8";
    EXPECT_EQ(read(kDc, demand), AccessError::does_not_fit);
    dc.parameters["i0"].text = "3276.7";
    EXPECT_EQ(read(kDc, demand), AccessError::none);
    EXPECT_EQ(word, 0x7FFF);
    EXPECT_EQ(write(kDc, row(288, TagType::boolean), 2), AccessError::out_of_range);
    EXPECT_EQ(dc.parameters["i0"].writes, 0u);
}

TEST_F(EiClient, DoesNotTransportAString)
{
    EXPECT_EQ(read(kDc, row(288, TagType::string)), AccessError::unsupported_type);
    EXPECT_EQ(write(kDc, row(288, TagType::string), 0), AccessError::unsupported_type);
    EXPECT_EQ(line.sent, "");
}

TEST_F(EiClient, TakesAnUnlistedTagThatAnswersInHexadecimalForAWord)
{
    EXPECT_EQ(read(kDc, unlisted_tag(537)), AccessError::none);
    EXPECT_EQ(word, 0x1B0B);
}

TEST_F(EiClient, ReadsAnUnlistedTagBeforeItWritesItForTheFirstTime)
{
    EXPECT_EQ(write(kDc, unlisted_tag(536), 0x0201), AccessError::none);
    EXPECT_EQ(dc.parameters["ow"].text, ">0201");
    EXPECT_EQ(dc.requests, 2u);
    EXPECT_EQ(write(kDc, unlisted_tag(536), 0x0203), AccessError::none);
    EXPECT_EQ(dc.requests, 3u) << "now it is known to be a WORD";
}

TEST_F(EiClient, NeverWritesAnUnlistedNumberAndSaysWhatTheTableNeeds)
{
    EXPECT_EQ(write(kDc, unlisted_tag(288), 1), AccessError::no_scale);
    EXPECT_EQ(dc.parameters["i0"].writes, 0u);
    EXPECT_EQ(read(kDc, unlisted_tag(288)), AccessError::no_scale);
    EXPECT_THAT(client.last_trouble(), HasSubstr("add a row with type and decimals"));
    EXPECT_THAT(client.last_trouble(), HasSubstr("'12.5'"));
    EXPECT_EQ(client.last_answer(), "12.5");
}

TEST_F(EiClient, TakesALongTextOfAnUnlistedTagForNoWord)
{
    dc.parameters["i0"].text = std::string(40, 'A');
    EXPECT_EQ(read(kDc, unlisted_tag(288)), AccessError::unsupported_type);
}

TEST_F(EiClient, NeverTakesANumberWhoseRowHasNoDecimals)
{
    Tag bare = demand;
    bare.decimals_known = false;
    EXPECT_EQ(read(kDc, bare), AccessError::no_scale);
    EXPECT_THAT(client.last_trouble(), HasSubstr("fill in column decimals"));
    EXPECT_EQ(write(kDc, bare, 1), AccessError::no_scale);
    EXPECT_EQ(dc.parameters["i0"].writes, 0u);
}

TEST_F(EiClient, NeverTakesANumberWhoseRowIsNotConfirmed)
{
    Tag suspected = demand;
    suspected.confirmed = false;
    EXPECT_EQ(read(kDc, suspected), AccessError::no_scale);
    EXPECT_THAT(client.last_trouble(), HasSubstr("set confirmed to yes"));
    EXPECT_EQ(write(kDc, suspected, 1), AccessError::no_scale);
    EXPECT_EQ(dc.parameters["i0"].writes, 0u);
}

TEST_F(EiClient, TakesAWordWhateverARowWithoutAScaleSays)
{
    Tag bare = row(536, TagType::number);
    bare.decimals_known = false;
    dc.parameters["ow"].text = ">12AB";
    EXPECT_EQ(read(kDc, bare), AccessError::none);
    EXPECT_EQ(word, 0x12AB);
    EXPECT_EQ(write(kDc, bare, 0x0205), AccessError::none);
    EXPECT_EQ(dc.parameters["ow"].text, ">0205");
}

TEST_F(EiClient, GivesTagsWithoutARowTheOneScaleOfTheStation)
{
    EXPECT_EQ(read(kDc, unlisted_tag(288, 2)), AccessError::none);
    EXPECT_EQ(word, 1250);
    EXPECT_EQ(write(kDc, unlisted_tag(288, 2), 575), AccessError::none);
    EXPECT_EQ(dc.parameters["i0"].text, "5.75");
    EXPECT_EQ(read(kDc, unlisted_tag(537, 2)), AccessError::none);
    EXPECT_EQ(word, 0x1B0B) << "an answer with > is a word";
    dc.parameters["i0"].text = "5.755";
    EXPECT_EQ(read(kDc, unlisted_tag(288, 2)), AccessError::contradicted);
}

TEST_F(EiClient, LooksAgainBeforeItWritesToADriveThatMayBeAnotherOne)
{
    ASSERT_EQ(write(kDc, unlisted_tag(536), 0x0201), AccessError::none);
    ASSERT_EQ(client.probe(kDc), AccessError::none); // a lost drive is probed until it answers
    dc.parameters["ow"] = {.text = "7.5"};

    EXPECT_EQ(write(kDc, unlisted_tag(536), 0x0203), AccessError::no_scale);
    EXPECT_EQ(dc.parameters["ow"].writes, 0u);
}

TEST_F(EiClient, TakesTheWireTimeOfTheReference)
{
    const struct {
        unsigned baud;
        const char* text;
        double read_ms, write_ms;
    } list[] = {
        {9600, ">1234", 18.75, 16.67},   {19200, ">1234", 9.38, 8.33},  {38400, ">1234", 4.69, 4.17},
        {57600, ">1234", 3.12, 2.78},    {115200, ">1234", 1.56, 1.39}, {9600, ">01", 16.67, 14.58},
        {9600, "-123.45", 20.83, 18.75},
    };
    for (const auto& entry : list) {
        test::SimulatedLine wire{entry.baud};
        wire.drives = {&dc};
        dc.turnaround = 0ns;
        EiAsciiClient on_wire{wire, {.baud = entry.baud}, {{kDc, MnemonicRule::dc_590plus}}};
        const std::string text = entry.text;
        const Tag tag = text == ">01"    ? row(536, TagType::boolean)
                        : text[0] == '>' ? row(536, TagType::word)
                                         : row(536, TagType::number, 2);
        dc.parameters["ow"].text = text;
        std::uint16_t value = 0;
        Instant before = wire.time;
        ASSERT_EQ(on_wire.read(kDc, tag, {&value, 1}), AccessError::none);
        EXPECT_NEAR(std::chrono::duration<double>(wire.time - before).count() * 1000, entry.read_ms, 0.006);
        before = wire.time;
        ASSERT_EQ(on_wire.write(kDc, tag, {&value, 1}), AccessError::none);
        EXPECT_NEAR(std::chrono::duration<double>(wire.time - before).count() * 1000, entry.write_ms, 0.006);
        EXPECT_EQ(dc.parameters["ow"].text, text);
    }
}

TEST_F(EiClient, TakesNoBlocks)
{
    const std::array<std::uint16_t, 2> words{1, 2};
    EXPECT_EQ(client.block_rule().max_written, 1);
    EXPECT_EQ(client.write(kDc, sequence, words), AccessError::unsupported_type);
    EXPECT_NE(client.last_trouble(), "");
    EXPECT_EQ(line.sent, "");
}

TEST_F(EiClient, ProbesTheIdentityAndTakesAValueForProof)
{
    EXPECT_EQ(client.probe(kDc), AccessError::none);
    EXPECT_EQ(line.sent, "\x04"
                         "0000II\x05");
    dc.parameters.erase("II");
    EXPECT_EQ(client.probe(kDc), AccessError::none) << "EOT, but EE has a value";
    dc.faults = {Fault::bad_bcc};
    dc.parameters["II"].text = ">0650";
    EXPECT_NE(client.probe(kDc), AccessError::none);
    EXPECT_NE(client.probe(kAbsent), AccessError::none);
}

} // namespace
} // namespace dpslave::drive
