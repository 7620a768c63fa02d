// SPDX-License-Identifier: Apache-2.0
/// Tests what is no sign of life of a drive: characters without a checksum, whoever says them.
#include "written_line.hpp"

#include "dpslave/drive/ei_ascii_client.hpp"

#include <gtest/gtest.h>

namespace dpslave::drive {
namespace {

using namespace std::chrono_literals;

/// It says the same behind each question.
class OneCharacterLine final : public test::WrittenLine {
public:
    explicit OneCharacterLine(char character) : character_(1, character) {}
    bool write(Bytes octets) override
    {
        comes(character_, octets.size() * 1ms + 20ms);
        return true;
    }

private:
    std::string character_;
};

class LoneCharacter : public testing::TestWithParam<char> {};

TEST_P(LoneCharacter, BehindEachQuestionIsNoAnswerAndNoSignOfLife)
{
    constexpr UnitAddress kUnit{0, 1};
    OneCharacterLine line{GetParam()};
    EiAsciiClient client{
        line, {.baud = test::WrittenLine::kBaud, .timeout = 200ms}, {{kUnit, MnemonicRule::none}}};
    Tag tag;
    tag.number = 1;
    tag.mnemonic = "dW";
    std::uint16_t word = 0;
    for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(client.read(kUnit, tag, {&word, 1}), AccessError::no_answer) << i;
        EXPECT_EQ(client.probe(kUnit), AccessError::no_answer) << i;
        line.time += 1s;
    }
    EXPECT_EQ(client.counts(kUnit).valid_at, Instant{});
}

INSTANTIATE_TEST_SUITE_P(Of, LoneCharacter, testing::Values('\x04', '\x06', '\x15', 'x'));

} // namespace
} // namespace dpslave::drive
