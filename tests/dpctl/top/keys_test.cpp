// SPDX-License-Identifier: Apache-2.0
// The keys of a terminal, from the octets that it sends (ECMA-48, 5.4; xterm ctlseqs, "PC-Style Function
// Keys").
#include "dpctl/top/keys.hpp"

#include <gtest/gtest.h>

#include <ostream>

namespace dpslave::dpctl {

void PrintTo(const Key& key, std::ostream* out)
{
    *out << static_cast<int>(key.kind) << " '" << key.text << "'";
}

namespace {

using Kind = Key::Kind;

std::vector<Key> typed(std::string_view octets)
{
    return KeyReader{}.read(octets);
}

struct KeyRow {
    const char* name;
    std::string octets;
    Kind kind;
};
class KeyOfATerminal : public testing::TestWithParam<KeyRow> {};

TEST_P(KeyOfATerminal, IsKnownByItsOctets)
{
    EXPECT_EQ(typed(GetParam().octets), (std::vector<Key>{{GetParam().kind, {}}}));
}

INSTANTIATE_TEST_SUITE_P(
    All, KeyOfATerminal,
    testing::Values(
        KeyRow{"Up", "\x1B[A", Kind::up}, KeyRow{"UpOfAnApplication", "\x1BOA", Kind::up},
        KeyRow{"UpWithShift", "\x1B[1;2A", Kind::up}, KeyRow{"Down", "\x1B[B", Kind::down},
        KeyRow{"DownOfAnApplication", "\x1BOB", Kind::down}, KeyRow{"PageUp", "\x1B[5~", Kind::page_up},
        KeyRow{"PageDown", "\x1B[6~", Kind::page_down}, KeyRow{"Enter", "\r", Kind::enter},
        KeyRow{"EnterAsALineFeed", "\n", Kind::enter}, KeyRow{"Backspace", "\x7F", Kind::backspace},
        KeyRow{"CtrlH", "\b", Kind::backspace}, KeyRow{"CtrlU", "\x15", Kind::clear},
        KeyRow{"Escape", "\x1B", Kind::escape}, KeyRow{"Insert", "\x1B[2~", Kind::unknown},
        KeyRow{"F1", "\x1BOP", Kind::unknown}, KeyRow{"Tab", "\t", Kind::unknown},
        KeyRow{"Nul", std::string(1, '\0'), Kind::unknown}, KeyRow{"C1", "\u009B", Kind::unknown},
        KeyRow{"RightToLeftOverride", "\u202E", Kind::unknown}, KeyRow{"NoUtf8", "\xFF", Kind::unknown}),
    [](const auto& row) { return row.param.name; });

TEST(KeyReader, GivesEachCharacterOfOneRead)
{
    EXPECT_EQ(
        typed("a\u00FC\u4E2D"),
        (std::vector<Key>{{Kind::character, "a"}, {Kind::character, "\u00FC"}, {Kind::character, "\u4E2D"}}));
}

TEST(KeyReader, JoinsWhatTwoReadsBring)
{
    KeyReader reader;

    EXPECT_EQ(reader.read("\x1B["), std::vector<Key>{});
    EXPECT_EQ(reader.read("B\xC3"), (std::vector<Key>{{Kind::down, {}}}));
    EXPECT_EQ(reader.read("\xBC"), (std::vector<Key>{{Kind::character, "\u00FC"}}));
}

TEST(KeyReader, TakesAnEscapeBeforeAnotherKeyForTheKeyEsc)
{
    EXPECT_EQ(typed("\x1Bq"), (std::vector<Key>{{Kind::escape, {}}, {Kind::character, "q"}}));
}

TEST(KeyReader, DoesNotWaitForeverForTheEndOfASequence)
{
    KeyReader reader;
    EXPECT_EQ(reader.read("\x1B[" + std::string(13, '1')), std::vector<Key>{});

    EXPECT_EQ(reader.read("1q"),
              (std::vector<Key>{{Kind::unknown, {}}, {Kind::character, "1"}, {Kind::character, "q"}}));
}

} // namespace
} // namespace dpslave::dpctl
