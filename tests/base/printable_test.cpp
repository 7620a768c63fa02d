// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/printable.hpp"

#include <gtest/gtest.h>

namespace dpslave {
namespace {

TEST(Printable, LeavesTextOfAnyLanguageAlone)
{
    for (const char* const text :
         {"", "SPEED DEMAND 12.34 %", "Z\u00FCrich", "\u0394\u03A9 \u00B0C", "\U0001F6E0"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, ShowsEveryControlCharacterAsItsCode)
{
    EXPECT_EQ(printable("\x1B[2J"), "\\x1B[2J");
    EXPECT_EQ(printable("one\ntwo\r\tthree"), "one\\x0Atwo\\x0D\\x09three");
    EXPECT_EQ(printable(std::string_view{"\0\x7F", 2}), "\\x00\\x7F");
    EXPECT_EQ(printable("\u009B31m\u0085"), "\\x9B31m\\x85") << "C1, as UTF-8";
    EXPECT_EQ(printable("\x9B"
                        "31m"),
              "\\x9B31m")
        << "C1, as one octet";
}

TEST(Printable, ShowsWhatChangesTheDirectionOfWritingOrIsNotSeenAsItsCode)
{
    EXPECT_EQ(printable("a\u202Egpj.b"), "a\\u202Egpj.b");
    for (const char* const one :
         {"\u061C", "\u200E", "\u200F", "\u202A", "\u202B", "\u202C", "\u202D", "\u202E", "\u2066", "\u2067",
          "\u2068", "\u2069", "\u2028", "\u2029", "\uFEFF", "\uFFF9"})
        EXPECT_EQ(printable(one).substr(0, 2), "\\u");
    EXPECT_EQ(printable("\U000E0041"), "\\uE0041");
}

TEST(Printable, TakesOctetsThatAreNoUtf8ForIso8859)
{
    EXPECT_EQ(printable("Z\xFCrich"), "Z\u00FCrich");
    EXPECT_EQ(printable("100 \xB0"
                        "C \u00FC"),
              "100 \u00B0C \u00FC")
        << "of both in one text";
    EXPECT_EQ(printable("\xC3"), "\u00C3") << "cut short";
    EXPECT_EQ(printable("\xC0\xAF"), "\u00C0\u00AF") << "overlong";
    EXPECT_EQ(printable("\xED\xA0\x80"), "\u00ED\u00A0\\x80") << "a surrogate";
}

TEST(Printable, LetsNothingThroughThatATerminalExecutes)
{
    for (int first = 0; first < 256; ++first)
        for (int second = 0; second < 256; ++second) {
            const std::string shown =
                printable(std::string{static_cast<char>(first), static_cast<char>(second)});
            for (std::string_view rest = shown; !rest.empty();) {
                const std::size_t length = character_length(rest);
                ASSERT_GT(length, 0u) << first << ' ' << second;
                ASSERT_FALSE(is_control(rest.substr(0, length))) << first << ' ' << second;
                rest.remove_prefix(length);
            }
        }
}

TEST(Utf8, IsKeptAndAnyOtherTextIsIso8859)
{
    EXPECT_EQ(utf8("Z\u00FCrich"), "Z\u00FCrich");
    EXPECT_EQ(utf8("Z\xFCrich"), "Z\u00FCrich");
    EXPECT_EQ(utf8("\n\t"), "\n\t") << "ends of lines stay";
}

TEST(PrintableJson, IsTheSameValueWithoutCharactersThatATerminalExecutes)
{
    EXPECT_EQ(printable_json("{\"a\": \"Z\u00FCrich\"}\n"), "{\"a\": \"Z\u00FCrich\"}\n");
    EXPECT_EQ(printable_json("[\"\u009B\u202E\x7F\"]"), "[\"\\u009B\\u202E\\u007F\"]");
    EXPECT_EQ(printable_json("[\"\U000E0041\"]"), "[\"\\uDB40\\uDC41\"]");
}

} // namespace
} // namespace dpslave
