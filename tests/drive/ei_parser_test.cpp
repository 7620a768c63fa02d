// SPDX-License-Identifier: Apache-2.0
/// Answers of EI-ASCII octet by octet, and what flaws and error numbers are in words.
#include "octets.hpp"

#include "dpslave/drive/ei_ascii.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive::ei {
namespace {

AnswerParser::Status feed_all(AnswerParser& parser, const char* frame)
{
    auto status = AnswerParser::Status::more;
    for (const std::uint8_t octet : test::octets(frame)) status = parser.feed(octet);
    return status;
}

TEST(EiAnswerByOctets, MayHaveEveryPrintableCharacterInItAndNoOther)
{
    for (unsigned character = 0; character <= 0xFF; ++character) {
        if (character == kEtx) continue;
        AnswerParser parser{AnswerParser::To::poll};
        feed_all(parser, "02 50 56");
        const bool printable = character >= 0x20 && character <= 0x7E;
        EXPECT_EQ(parser.feed(static_cast<std::uint8_t>(character)),
                  printable ? AnswerParser::Status::more : AnswerParser::Status::broken)
            << character;
    }
}

TEST(EiAnswerByOctets, IsCompleteWhateverFollowsABccAndOnlyNoiseBehindALoneOctet)
{
    for (unsigned next = 0; next <= 0xFF; ++next) {
        const auto octet = static_cast<std::uint8_t>(next);
        AnswerParser value{AnswerParser::To::poll}, nak{AnswerParser::To::poll};
        ASSERT_EQ(feed_all(value, "02 50 56 03 05"), AnswerParser::Status::complete);
        EXPECT_EQ(value.feed(octet), AnswerParser::Status::complete) << next;

        ASSERT_EQ(feed_all(nak, "15"), AnswerParser::Status::complete);
        const bool noise = next == 0x00 || next == 0x7F || next == 0xFF;
        EXPECT_EQ(nak.feed(octet), noise ? AnswerParser::Status::complete : AnswerParser::Status::broken)
            << next;
        EXPECT_EQ(nak.flaw(), noise ? Flaw::none : Flaw::octets_after) << next;
    }
}

TEST(EiAnswerByOctets, StaysBrokenWhateverFollows)
{
    AnswerParser parser{AnswerParser::To::poll};
    ASSERT_EQ(feed_all(parser, "02 50 56 31 36 2E 34 03 19"), AnswerParser::Status::broken);

    EXPECT_EQ(feed_all(parser, "00"), AnswerParser::Status::broken);
    EXPECT_EQ(feed_all(parser, "02 50 56 31 36 2E 34 03 18"), AnswerParser::Status::broken);
    EXPECT_EQ(parser.flaw(), Flaw::bad_bcc);
}

TEST(EiAnswerByOctets, StaysBrokenBehindACharacterThatIsNotAllowed)
{
    AnswerParser parser{AnswerParser::To::poll};
    ASSERT_EQ(feed_all(parser, "02 50 56 31 04"), AnswerParser::Status::broken);

    EXPECT_EQ(feed_all(parser, "31"), AnswerParser::Status::broken);
    EXPECT_EQ(parser.flaw(), Flaw::bad_text);
}

TEST(EiAnswerByOctets, BeginsBehindNoiseOfEachKind)
{
    for (const char* noise : {"00", "7F", "FF"}) {
        AnswerParser parser{AnswerParser::To::poll};
        EXPECT_EQ(feed_all(parser, noise), AnswerParser::Status::more) << noise;
        EXPECT_FALSE(parser.started());
        EXPECT_EQ(feed_all(parser, "02 50 56 03 05"), AnswerParser::Status::complete) << noise;
    }
}

TEST(EiAnswerByOctets, HasBegunWithItsFirstOctet)
{
    AnswerParser parser{AnswerParser::To::poll};
    EXPECT_FALSE(parser.started());
    feed_all(parser, "02");
    EXPECT_TRUE(parser.started());
}

TEST(EiFlaw, IsSaidInWords)
{
    EXPECT_EQ(text(Flaw::none), "no flaw");
    EXPECT_EQ(text(Flaw::unexpected_start),
              "an answer that begins with no STX, EOT, ACK or NAK, or with the wrong one");
    EXPECT_EQ(text(Flaw::bad_text), "a character inside the answer that is not allowed there");
    EXPECT_EQ(text(Flaw::too_long), "an answer that does not end");
    EXPECT_EQ(text(Flaw::bad_bcc), "a wrong BCC");
    EXPECT_EQ(text(Flaw::octets_after), "characters directly after an EOT, ACK or NAK");
}

TEST(EiLastError, HasTheMeaningsOfTheManual)
{
    const struct {
        std::uint16_t ee;
        std::string_view meaning;
    } list[] = {
        {0x00C0, "no error"},
        {0x01C7, "invalid mnemonic"},
        {0x02C2, "checksum (BCC) error"},
        {0x03C2, "framing or overrun error"},
        {0x04C8, "read of a write-only parameter"},
        {0x05C8, "write to a read-only parameter"},
        {0x07C7, "invalid message format"},
        {0x07C8, "invalid data"},
        {0x08C8, "data out of range"},
        {0x06C8, "no meaning known"},
        {0x09C8, "no meaning known"},
    };
    for (const auto& entry : list) EXPECT_EQ(meaning_of_ee(entry.ee), entry.meaning) << std::hex << entry.ee;
}

} // namespace
} // namespace dpslave::drive::ei
