// SPDX-License-Identifier: Apache-2.0
// Tests what a 2408f or 2404f does by itself (handbook chapters 4, 7 and 8).
#include "modbus_bench.hpp"
#include "support/paths.hpp"

#include <algorithm>

namespace dpslave::sim {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class InstrumentTest : public InstrumentBench {
protected:
    std::uint16_t word(std::uint16_t tag)
    {
        std::vector<std::uint16_t> words;
        EXPECT_EQ(line.instruments()[0].read(tag, 1, words, now), Exception::none) << tag;
        return words.empty() ? std::uint16_t{0xDEAD} : words[0];
    }
};

TEST_F(InstrumentTest, ReportsWhichInstrumentItIs)
{
    EXPECT_EQ(word(122), 0x2480);
    EXPECT_EQ(instrument_ident("2404f"), 0x2440);
    EXPECT_EQ(instrument_ident("590"), std::nullopt);
}

TEST_F(InstrumentTest, TunesItselfUntilBit12OfTheControlStatusWordClears)
{
    EXPECT_EQ(word(76), 0x0000);
    EXPECT_EQ(asks("01 06 01 0E 00 01"), "01 06 01 0E 00 01");
    const Instant began = now - 5ms; // the reply came after the turnaround
    now = began + 2999ms;
    EXPECT_EQ(word(76), 0x1000);
    EXPECT_EQ(word(75), 0x0100) << "tune active";
    EXPECT_EQ(word(270), 1);
    now = began + 3s;
    EXPECT_EQ(word(76), 0x0100) << "completed successfully";
    EXPECT_EQ(word(75), 0x0000);
    EXPECT_EQ(word(270), 0);
}

TEST_F(InstrumentTest, SetsBit3WhenTheTuneFailsAndClearsItWithTheNext)
{
    type("tune 10s fails");
    asks("01 06 01 0E 00 01");
    now += 10s;
    EXPECT_EQ(word(76), 0x0008);
    type("tune 1s");
    type("panel 270 1");
    EXPECT_EQ(word(76), 0x1000);
    now += 1s;
    EXPECT_EQ(word(76), 0x0100);
}

TEST_F(InstrumentTest, EndsATuneThatIsSwitchedOff)
{
    asks("01 06 01 0E 00 01");
    asks("01 06 01 0E 00 00");
    EXPECT_EQ(word(76), 0x0000);
    EXPECT_EQ(word(75), 0x0000);
}

TEST_F(InstrumentTest, ShowsManualModeInItsStatusWords)
{
    type("panel 273 Manual");
    EXPECT_EQ(word(75), 0x0010);
    EXPECT_EQ(word(74), 0x0010);
    EXPECT_EQ(word(76), 0x8000);
    EXPECT_EQ(asks("01 06 00 03 00 64"), "01 06 00 03 00 64") << "output power can be written now";
    type("panel 273 Auto");
    EXPECT_EQ(word(75), 0x0000);
    EXPECT_EQ(asks("01 06 00 03 00 65"), "01 86 03");
}

TEST_F(InstrumentTest, SetsBitsOfTheSummaryOutputStatusFromTheConsole)
{
    for (const char* const bit : {"4", "5", "14"}) type(std::string{"bit 75 "} + bit + " on");
    EXPECT_EQ(word(75), 0x4030) << "the example of chapter 4";
    type("bit 75 5 off");
    EXPECT_EQ(word(75), 0x4010);
}

TEST_F(InstrumentTest, FollowsTheSelectedSetpoint)
{
    asks("01 06 00 18 03 E8"); // SP1 = 100.0
    EXPECT_EQ(word(2), 1000);
    EXPECT_EQ(word(5), 1000);
    asks("01 06 00 19 07 D0"); // SP2 = 200.0, not selected
    EXPECT_EQ(word(5), 1000);
    asks("01 06 00 0F 00 01");
    EXPECT_EQ(word(2), 2000);
    EXPECT_EQ(word(5), 2000);
    asks("01 06 00 02 0B B8"); // the target setpoint is the selected one
    EXPECT_EQ(word(25), 3000);
    EXPECT_EQ(word(24), 1000);
}

TEST_F(InstrumentTest, TakesAnOperatorsValueWithinLimitsAndAccess)
{
    EXPECT_THAT(type("panel 24 123.4"), IsEmpty());
    EXPECT_EQ(word(24), 1234);
    EXPECT_THAT(type("panel 5 1.0"), ElementsAre("tag 5 cannot be changed at present"));
    EXPECT_THAT(type("panel 24 500.1"), ElementsAre(HasSubstr("within its limits")));
    EXPECT_THAT(type("set 5 1.0"), IsEmpty()) << "set does what no operator can";
    EXPECT_EQ(word(5), 10);
}

TEST_F(InstrumentTest, RoundsInIntegerResolution)
{
    type("set 1 999.9");
    EXPECT_EQ(word(1), 9999);
    type("set 12550 Integer");
    EXPECT_EQ(word(1), 1000) << "999.9";
    type("set 525 2");
    type("set 1 12.34");
    EXPECT_EQ(word(1), 12);
    EXPECT_EQ(asks("01 06 00 18 00 0B"), "01 06 00 18 00 0B");
    type("set 12550 Full");
    EXPECT_EQ(word(24), 1100) << "11, at two decimals";
    EXPECT_EQ(word(1), 1234);
}

TEST_F(InstrumentTest, GivesTheDecimalsOfItsDisplayAndKeepsTheValues)
{
    EXPECT_EQ(word(24), 500);
    asks("01 06 02 0D 00 02");
    EXPECT_EQ(word(24), 5000);
    EXPECT_THAT(type("get 24"), ElementsAre("tag 24 = 50.00"));
    EXPECT_EQ(asks("01 06 00 18 C3 50"), "01 86 03") << "read as negative: 500.00 does not fit";
    asks("01 06 02 0D 00 00");
    EXPECT_EQ(word(24), 50);
    EXPECT_EQ(asks("01 06 00 18 01 F5"), "01 86 03") << "501 is beyond the limit of 500";
    EXPECT_EQ(word(3), 0) << "decimals that the table fixes stay";
}

TEST_F(InstrumentTest, WarnsOfWhatWouldStartAFactoryFunction)
{
    line.set_logging(false);
    EXPECT_EQ(asks("01 06 00 C7 00 02"), "01 06 00 C7 00 02") << "although its table says ro";
    EXPECT_THAT(line.take_log(), IsEmpty());
    asks("01 06 00 C7 00 03");
    EXPECT_THAT(line.take_log(), ElementsAre(HasSubstr("would have started a factory function")));
}

// ---- program store ----

TEST_F(InstrumentTest, HasProgram1AndItsCopyButNoneBehindIt)
{
    EXPECT_EQ(asks("01 03 20 88 00 08"), "01 03 10 00 03 00 05 00 01 00 01 00 01 00 00 00 00 00 00")
        << "8328";
    EXPECT_EQ(asks("01 03 21 0F 00 01"), "01 03 02 00 00") << "8463, the last word";
    EXPECT_EQ(asks("01 03 21 10 00 01"), "01 83 02") << "8464, program 2";
    EXPECT_EQ(asks("01 06 21 10 00 01"), "01 86 02");
    EXPECT_EQ(asks("01 03 20 00 00 01"), "01 03 02 00 00") << "8192, program 0";
}

TEST_F(InstrumentTest, TakesEveryWordOfProgram1)
{
    for (std::uint16_t i = 0; i < 136; ++i)
        ASSERT_EQ(line.instruments()[0].write_one(static_cast<std::uint16_t>(8328 + i),
                                                  static_cast<std::uint16_t>(1000 + i), now),
                  Exception::none);
    for (std::uint16_t i = 0; i < 136; ++i) EXPECT_EQ(word(static_cast<std::uint16_t>(8328 + i)), 1000 + i);
}

TEST_F(InstrumentTest, LetsProgram0BeWrittenInHoldOnlyAndReadAlways)
{
    EXPECT_EQ(asks("01 06 20 08 00 07"), "01 86 03") << "reset";
    type("panel 23 Run");
    EXPECT_EQ(asks("01 06 20 08 00 07"), "01 86 03") << "run";
    EXPECT_EQ(asks("01 03 20 08 00 02"), "01 03 04 00 01 00 64") << "a copy of program 1";
    type("panel 23 Hold");
    EXPECT_EQ(asks("01 06 20 08 00 07"), "01 06 20 08 00 07");
    EXPECT_EQ(asks("01 03 20 90 00 01"), "01 03 02 00 01") << "the program itself stays as it was";
    type("panel 23 Run");
    EXPECT_EQ(word(8200), 7) << "goes on with what was changed";
    type("panel 23 Reset");
    type("panel 23 Run");
    EXPECT_EQ(word(8200), 1) << "the change was not stored";
}

class FourPrograms : public InstrumentBench {
protected:
    FourPrograms() : InstrumentBench(4) {}
};

TEST_F(FourPrograms, EndAtTag8871)
{
    EXPECT_EQ(asks("01 06 22 A3 00 01"), "01 06 22 A3 00 01") << "8867, end type of segment 16 of program 4";
    EXPECT_EQ(asks("01 03 22 A7 00 01"), "01 03 02 00 00") << "8871";
    EXPECT_EQ(asks("01 03 22 A8 00 01"), "01 83 02");
}

TEST_F(FourPrograms, RunTheOneThatIsChosen)
{
    asks("01 06 22 20 00 2A"); // 8736, first word of program 4
    type("set 22 4");
    asks("01 06 00 17 00 02");
    EXPECT_EQ(asks("01 03 20 00 00 01"), "01 03 02 00 2A");
}

TEST(InstrumentWithoutProgrammer, HasNoProgramStore)
{
    Instrument instrument{1, 0x2480, *parse_tags(instrument_table(), "2400.csv"), 0};
    EXPECT_EQ(instrument.find(8192), nullptr);
    EXPECT_EQ(instrument.find(8871), nullptr);
    EXPECT_NE(instrument.find(12550), nullptr);
}

TEST(InstrumentOfTheShippedTable, HasAllTagsOfChapter8AndOneProgram)
{
    const auto tags = load_tags(test::source_path("config/tags/2400.csv"));
    ASSERT_TRUE(tags) << tags.error();
    Instrument one{1, 0x2480, *tags, 1}, four{1, 0x2480, *tags, 4};
    EXPECT_EQ(four.parameters().size(), 1050U);
    EXPECT_EQ(one.parameters().size(), 1050U - 3U * 136U);
    EXPECT_EQ(one.find(1)->tag.decimals, 1U) << "as the display shows it";
    for (std::uint16_t tag = 8192; tag <= 8871; ++tag) EXPECT_NE(four.find(tag), nullptr) << tag;
    EXPECT_EQ(one.find(5)->tag.access, TagAccess::read_only);
    EXPECT_EQ(one.write_one(270, 1, Instant{}), Exception::none);
    EXPECT_EQ(one.find(76)->value.counts, 0x1000);
}

} // namespace
} // namespace dpslave::sim
