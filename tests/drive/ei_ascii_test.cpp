// SPDX-License-Identifier: Apache-2.0
#include "octets.hpp"

#include "dpslave/drive/ei_ascii.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive::ei {
namespace {

using test::octets;

struct WorkedPoll {
    const char* name;
    UnitAddress unit;
    Mnemonic mnemonic;
    const char* request;
};
struct WorkedSelect {
    const char* name;
    UnitAddress unit;
    Mnemonic mnemonic;
    const char* text;
    const char* request;
};
struct WorkedReply {
    const char* name;
    const char* reply;
    Mnemonic mnemonic;
    const char* text;
};

class EiPoll : public testing::TestWithParam<WorkedPoll> {};
TEST_P(EiPoll, IsEotAddressMnemonicEnq)
{
    const Frame frame = poll(GetParam().unit, GetParam().mnemonic);
    EXPECT_EQ(hex(frame), GetParam().request);
}
INSTANTIATE_TEST_SUITE_P(
    Worked, EiPoll,
    testing::Values(WorkedPoll{"ReadPvAt01", {0, 1}, {'P', 'V'}, "04 30 30 31 31 50 56 05"},
                    WorkedPoll{"ReadIiAt01", {0, 1}, {'I', 'I'}, "04 30 30 31 31 49 49 05"},
                    WorkedPoll{"ReadTag537At00", {0, 0}, {'o', 'x'}, "04 30 30 30 30 6F 78 05"},
                    WorkedPoll{"HexadecimalUnitAndGroup", {7, 15}, {'P', 'V'}, "04 37 37 46 46 50 56 05"}),
    [](const auto& param) { return param.param.name; });

class EiSelect : public testing::TestWithParam<WorkedSelect> {};
TEST_P(EiSelect, IsEotAddressStxMnemonicTextEtxBcc)
{
    const Frame frame = select(GetParam().unit, GetParam().mnemonic, GetParam().text);
    EXPECT_EQ(hex(frame), GetParam().request);
}
INSTANTIATE_TEST_SUITE_P(
    Worked, EiSelect,
    testing::Values(
        WorkedSelect{"WriteSl", {0, 1}, {'S', 'L'}, "22.0", "04 30 30 31 31 02 53 4C 32 32 2E 30 03 02"},
        WorkedSelect{"WriteTag348", {0, 1}, {'9', 'o'}, "30.", "04 30 30 31 31 02 39 6F 33 30 2E 03 78"},
        WorkedSelect{
            "WriteTag536", {0, 0}, {'o', 'w'}, ">0203", "04 30 30 30 30 02 6F 77 3E 30 32 30 33 03 24"},
        WorkedSelect{
            "WriteTag271", {0, 0}, {'7', 'j'}, ">047F", "04 30 30 30 30 02 37 6A 3E 30 34 37 46 03 15"},
        WorkedSelect{"WriteTag269", {0, 0}, {'7', 'h'}, "50.0", "04 30 30 30 30 02 37 68 35 30 2E 30 03 47"},
        WorkedSelect{"ClearEe", {0, 0}, {'E', 'E'}, ">0000", "04 30 30 30 30 02 45 45 3E 30 30 30 30 03 3D"}),
    [](const auto& param) { return param.param.name; });

class EiReply : public testing::TestWithParam<WorkedReply> {};
TEST_P(EiReply, IsReadToItsBccAndNoFurther)
{
    const auto frame = octets(GetParam().reply);
    AnswerParser parser{AnswerParser::To::poll};
    for (std::size_t i = 0; i + 1 < frame.size(); ++i)
        ASSERT_EQ(parser.feed(frame[i]), AnswerParser::Status::more) << i;
    ASSERT_EQ(parser.feed(frame.back()), AnswerParser::Status::complete);
    EXPECT_EQ(parser.answer().kind, Answer::Kind::value);
    EXPECT_EQ(parser.answer().mnemonic, GetParam().mnemonic);
    EXPECT_EQ(parser.answer().text, GetParam().text);
}
TEST_P(EiReply, WithAnyOneBitWrongIsNotAccepted)
{
    const auto frame = octets(GetParam().reply);
    for (std::size_t i = 0; i < frame.size(); ++i)
        for (unsigned bit = 0; bit < 8; ++bit) {
            AnswerParser parser{AnswerParser::To::poll};
            auto status = AnswerParser::Status::more;
            for (std::size_t k = 0; k < frame.size() && status == AnswerParser::Status::more; ++k)
                status = parser.feed(k == i ? static_cast<std::uint8_t>(frame[k] ^ (1u << bit)) : frame[k]);
            const bool believed_value =
                status == AnswerParser::Status::complete && parser.answer().kind == Answer::Kind::value;
            EXPECT_FALSE(believed_value) << "octet " << i << " bit " << bit;
        }
}
INSTANTIATE_TEST_SUITE_P(
    Worked, EiReply,
    testing::Values(WorkedReply{"Pv16_4", "02 50 56 31 36 2E 34 03 18", {'P', 'V'}, "16.4"},
                    WorkedReply{
                        "FixedWidth9_87", "02 50 56 20 20 20 20 39 2E 38 37 03 1D", {'P', 'V'}, "    9.87"},
                    WorkedReply{"Ii2650", "02 49 49 3E 32 36 35 30 03 3C", {'I', 'I'}, ">2650"},
                    WorkedReply{"Tag537", "02 6F 78 3E 31 42 30 42 03 2B", {'o', 'x'}, ">1B0B"},
                    WorkedReply{"Ee00C0", "02 45 45 3E 30 30 43 30 03 4E", {'E', 'E'}, ">00C0"},
                    WorkedReply{"Ee01C7", "02 45 45 3E 30 31 43 37 03 48", {'E', 'E'}, ">01C7"},
                    WorkedReply{"Ee08C8", "02 45 45 3E 30 38 43 38 03 4E", {'E', 'E'}, ">08C8"},
                    WorkedReply{"Pv16_9WithBccNak", "02 50 56 31 36 2E 39 03 15", {'P', 'V'}, "16.9"},
                    WorkedReply{"Pv17_8WithBccNak", "02 50 56 31 37 2E 38 03 15", {'P', 'V'}, "17.8"},
                    WorkedReply{"Pv18_7WithBccNak", "02 50 56 31 38 2E 37 03 15", {'P', 'V'}, "18.7"},
                    WorkedReply{"BccEot", "02 50 56 31 2E 30 2E 03 04", {'P', 'V'}, "1.0."},
                    WorkedReply{"EmptyText", "02 50 56 03 05", {'P', 'V'}, ""}),
    [](const auto& param) { return param.param.name; });

AnswerParser::Status fed(AnswerParser& parser, const char* frame)
{
    auto status = AnswerParser::Status::more;
    for (const std::uint8_t octet : octets(frame)) status = parser.feed(octet);
    return status;
}

TEST(EiReplyWithChannel, IsAFrameOfItsOwn)
{
    // "Read 1PV at 01": this client sends no channel; the BCC of the example covers it all the same.
    EXPECT_EQ(bcc(octets("31 50 56 31 36 2E 34 03")), 0x29);
}

TEST(EiAnswer, AckAndNakAnswerASelect)
{
    AnswerParser ack{AnswerParser::To::select}, nak{AnswerParser::To::select};
    EXPECT_EQ(fed(ack, "06"), AnswerParser::Status::complete);
    EXPECT_EQ(ack.answer().kind, Answer::Kind::ack);
    EXPECT_EQ(fed(nak, "15"), AnswerParser::Status::complete);
    EXPECT_EQ(nak.answer().kind, Answer::Kind::nak);
}

TEST(EiAnswer, EotAndNakAnswerAPoll)
{
    AnswerParser eot{AnswerParser::To::poll}, nak{AnswerParser::To::poll};
    EXPECT_EQ(fed(eot, "04"), AnswerParser::Status::complete);
    EXPECT_EQ(eot.answer().kind, Answer::Kind::eot);
    EXPECT_EQ(fed(nak, "15"), AnswerParser::Status::complete);
    EXPECT_EQ(nak.answer().kind, Answer::Kind::nak);
}

TEST(EiAnswer, NoiseOfATransceiverIsSkipped)
{
    AnswerParser parser{AnswerParser::To::select};
    EXPECT_EQ(fed(parser, "FF 00 7F"), AnswerParser::Status::more);
    EXPECT_FALSE(parser.started());
    EXPECT_EQ(fed(parser, "06"), AnswerParser::Status::complete);
    EXPECT_EQ(fed(parser, "FF"), AnswerParser::Status::complete);
}

struct Broken {
    const char* name;
    AnswerParser::To to;
    const char* octets;
    Flaw flaw;
};
class EiBroken : public testing::TestWithParam<Broken> {};
TEST_P(EiBroken, IsNamed)
{
    AnswerParser parser{GetParam().to};
    EXPECT_EQ(fed(parser, GetParam().octets), AnswerParser::Status::broken);
    EXPECT_EQ(parser.flaw(), GetParam().flaw);
    EXPECT_FALSE(text(parser.flaw()).empty());
}
INSTANTIATE_TEST_SUITE_P(
    All, EiBroken,
    testing::Values(
        Broken{"WrongBcc", AnswerParser::To::poll, "02 50 56 31 36 2E 34 03 19", Flaw::bad_bcc},
        Broken{"EtxInsideTheMnemonic", AnswerParser::To::poll, "02 50 03", Flaw::bad_text},
        Broken{"EotInsideTheText", AnswerParser::To::poll, "02 50 56 31 04", Flaw::bad_text},
        Broken{"ParityErrorInsideTheText", AnswerParser::To::poll, "02 50 56 31 00", Flaw::bad_text},
        Broken{"EighthBitSet", AnswerParser::To::poll, "02 50 56 B1", Flaw::bad_text},
        Broken{"TailOfALateReply", AnswerParser::To::poll, "36 2E 34 03 18", Flaw::unexpected_start},
        Broken{"AckToAPoll", AnswerParser::To::poll, "06", Flaw::unexpected_start},
        Broken{"EotToASelect", AnswerParser::To::select, "04", Flaw::unexpected_start},
        Broken{"ReplyToASelect", AnswerParser::To::select, "02", Flaw::unexpected_start},
        Broken{"AckWithATail", AnswerParser::To::select, "06 31", Flaw::octets_after},
        Broken{"EotWithATail", AnswerParser::To::poll, "04 02", Flaw::octets_after}),
    [](const auto& param) { return param.param.name; });

TEST(EiAnswer, ThatDoesNotEndIsGivenUp)
{
    AnswerParser parser{AnswerParser::To::poll};
    auto status = fed(parser, "02 50 56");
    std::size_t fed_octets = 0;
    for (; status == AnswerParser::Status::more && fed_octets < 1000; ++fed_octets) status = parser.feed('1');
    EXPECT_EQ(parser.flaw(), Flaw::too_long);
    EXPECT_EQ(fed_octets, kMaxAnswerText + 1);
}

// ---- values

Tag number(unsigned decimals, bool is_unsigned = false)
{
    Tag tag;
    tag.type = TagType::number;
    tag.decimals = static_cast<std::uint8_t>(decimals);
    tag.is_unsigned = is_unsigned;
    return tag;
}

Tag typed(TagType type)
{
    Tag tag;
    tag.type = type;
    return tag;
}

std::string encoded(const Tag& tag, int word, EnumForm form = EnumForm::hexadecimal)
{
    const auto text = encode_value(tag, static_cast<std::uint16_t>(word), form);
    return text ? *text : std::string{ei::text(text.error())};
}

TEST(EiValue, OfANumberHasItsPointAndNoZeroThatSaysNothing)
{
    EXPECT_EQ(encoded(number(2), 3000), "30.");
    EXPECT_EQ(encoded(number(2), 30000), "300.");
    EXPECT_EQ(encoded(number(2), 0x8AD0), "-300.");
    EXPECT_EQ(encoded(number(1), 500), "50.");
    EXPECT_EQ(encoded(number(1), 164), "16.4");
    EXPECT_EQ(encoded(number(2), 5), "0.05");
    EXPECT_EQ(encoded(number(2), -5), "-0.05");
    EXPECT_EQ(encoded(number(2), 50), "0.5");
    EXPECT_EQ(encoded(number(4), -32768), "-3.2768");
    EXPECT_EQ(encoded(number(0), -32768), "-32768.");
    EXPECT_EQ(encoded(number(0), 0), "0.");
    EXPECT_EQ(encoded(number(3), 0), "0.");
    EXPECT_EQ(encoded(number(0, true), 65535), "65535.");
    EXPECT_EQ(encoded(number(0), 100), "100.");
}

TEST(EiValue, OfBitsIsHexadecimal)
{
    EXPECT_EQ(encoded(typed(TagType::word), 0x0203), ">0203");
    EXPECT_EQ(encoded(typed(TagType::word), 0), ">0000");
    EXPECT_EQ(encoded(typed(TagType::word), 0xFFFF), ">FFFF");
    EXPECT_EQ(encoded(typed(TagType::boolean), 0), ">00");
    EXPECT_EQ(encoded(typed(TagType::boolean), 1), ">01");
}

TEST(EiValue, OfAnEnumIsHexadecimalOnThe590PlusAndDecimalOnAcDrives)
{
    EXPECT_EQ(encoded(typed(TagType::enumeration), 0x1F), ">1F");
    EXPECT_EQ(encoded(typed(TagType::enumeration), 10, EnumForm::decimal), "10.");
}

TEST(EiValue, IsNeverClamped)
{
    EXPECT_EQ(encode_value(typed(TagType::boolean), 2, EnumForm::hexadecimal).error(),
              ValueFlaw::out_of_span);
    EXPECT_EQ(encode_value(typed(TagType::enumeration), 256, EnumForm::decimal).error(),
              ValueFlaw::out_of_span);
    EXPECT_EQ(encode_value(typed(TagType::string), 0, EnumForm::decimal).error(),
              ValueFlaw::unsupported_type);
}

struct Decoded {
    const char* text;
    Tag tag;
    int word; ///< as 16 bits
};
TEST(EiValue, IsUnderstoodInEveryFormThatDrivesUse)
{
    const Decoded list[] = {
        {"16.4", number(1), 164},
        {"    9.87", number(2), 987},
        {"30.", number(2), 3000},
        {"300.", number(2), 0x7530},
        {"-300.", number(2), 0x8AD0},
        {"300", number(2), 0x7530},
        {"1", number(2), 100},
        {"1.", number(2), 100},
        {"1.0", number(2), 100},
        {"1.00", number(2), 100},
        {"999.9", number(1), 0x270F},
        {"12.34", number(2), 0x04D2},
        {".5", number(1), 5},
        {"+7.", number(0), 7},
        {"-3.2768", number(4), 0x8000},
        {"-32768.", number(0), 0x8000},
        {"32767.", number(0), 0x7FFF},
        {"65535.", number(0, true), 0xFFFF},
        {"-0.", number(0), 0},
        {"00012.", number(0), 12},
        {">1B0B", typed(TagType::word), 0x1B0B},
        {">047f", typed(TagType::word), 0x047F},
        {">0", typed(TagType::word), 0},
        {">1", typed(TagType::boolean), 1},
        {">01", typed(TagType::boolean), 1},
        {"1.", typed(TagType::boolean), 1},
        {">0A", typed(TagType::enumeration), 10},
        {"10.", typed(TagType::enumeration), 10},
        {">FF", typed(TagType::enumeration), 255},
    };
    for (const Decoded& entry : list) {
        const auto word = decode_value(entry.tag, entry.text);
        ASSERT_TRUE(word) << entry.text << ": " << text(word.error());
        EXPECT_EQ(*word, static_cast<std::uint16_t>(entry.word)) << entry.text;
    }
}

struct Refused {
    const char* text;
    Tag tag;
    ValueFlaw flaw;
};
TEST(EiValue, ThatDoesNotFitTheTableIsRefusedByName)
{
    const Refused list[] = {
        {"12.345", number(2), ValueFlaw::too_many_decimals},
        {"12.10", number(1), ValueFlaw::too_many_decimals},
        {"327.68", number(2), ValueFlaw::out_of_span},
        {"-327.69", number(2), ValueFlaw::out_of_span},
        {"99999.", number(0), ValueFlaw::out_of_span},
        {"-1.", number(0, true), ValueFlaw::out_of_span},
        {"99999999999999999999.", number(4), ValueFlaw::out_of_span},
        {">1234", number(0), ValueFlaw::wrong_form},
        {"12.", typed(TagType::word), ValueFlaw::wrong_form},
        {">0x0", typed(TagType::word), ValueFlaw::not_a_value},
        {">12345", typed(TagType::word), ValueFlaw::not_a_value},
        {">", typed(TagType::word), ValueFlaw::not_a_value},
        {">02", typed(TagType::boolean), ValueFlaw::out_of_span},
        {">100", typed(TagType::enumeration), ValueFlaw::out_of_span},
        {"1.5", typed(TagType::enumeration), ValueFlaw::too_many_decimals},
        {"", number(0), ValueFlaw::not_a_value},
        {".", number(0), ValueFlaw::not_a_value},
        {"-", number(0), ValueFlaw::not_a_value},
        {"1.2.3", number(4), ValueFlaw::not_a_value},
        {"HELLO", number(0), ValueFlaw::not_a_value},
        {"HELLO", typed(TagType::string), ValueFlaw::unsupported_type},
    };
    for (const Refused& entry : list) {
        const auto word = decode_value(entry.tag, entry.text);
        ASSERT_FALSE(word) << entry.text;
        EXPECT_EQ(word.error(), entry.flaw) << entry.text << ": " << text(word.error());
    }
}

TEST(EiValue, ComesBackAsItWent)
{
    for (unsigned decimals = 0; decimals <= 4; ++decimals)
        for (unsigned word = 0; word <= 0xFFFF; ++word) {
            const Tag tag = number(decimals);
            const auto text = encode_value(tag, static_cast<std::uint16_t>(word), EnumForm::hexadecimal);
            ASSERT_TRUE(text);
            ASSERT_NE(text->find('.'), std::string::npos) << "the point is mandatory";
            const auto back = decode_value(tag, *text);
            ASSERT_TRUE(back) << *text;
            ASSERT_EQ(*back, word) << *text;
        }
}

TEST(EiLastError, IsComparedByItsHighOctet)
{
    const struct {
        std::uint16_t ee;
        AccessError on_write;
    } list[] = {
        {0x01C7, AccessError::invalid_tag},    {0x02C2, AccessError::not_understood},
        {0x03C2, AccessError::not_understood}, {0x04C8, AccessError::unsupported_type},
        {0x05C8, AccessError::read_only},      {0x05CA, AccessError::read_only},
        {0x07C7, AccessError::not_understood}, {0x07C8, AccessError::value_not_encoded},
        {0x08C8, AccessError::out_of_range},   {0x08C0, AccessError::out_of_range},
        {0x00C0, AccessError::read_only},      {0x42C8, AccessError::read_only},
    };
    for (const auto& entry : list)
        EXPECT_EQ(error_of_ee(entry.ee, true), entry.on_write) << std::hex << entry.ee;
    EXPECT_EQ(error_of_ee(0x00C0, false), AccessError::not_understood);
    EXPECT_EQ(error_of_ee(0x42C8, false), AccessError::not_understood);
    EXPECT_EQ(error_of_ee(0x04C8, false), AccessError::unsupported_type);
    EXPECT_EQ(error_of_ee(0x05C8, false), AccessError::read_only);
    EXPECT_EQ(meaning_of_ee(0x08C8), "data out of range");
    EXPECT_EQ(meaning_of_ee(0x07C7), "invalid message format");
    EXPECT_EQ(meaning_of_ee(0x07C8), "invalid data");
}

} // namespace
} // namespace dpslave::drive::ei
