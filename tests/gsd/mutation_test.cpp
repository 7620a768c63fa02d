// SPDX-License-Identifier: Apache-2.0
// Whatever octets come, reading, checking and mapping end and stay in bounds. Deterministic: one seed.
#include "second_hand.hpp"

#include "dpslave/gsd/io_map.hpp"
#include "dpslave/gsd/sent.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace dpslave {
namespace {

/// Reads, checks both ways, maps; returns something that depends on all of it.
std::size_t digest(const std::string& content)
{
    const gsd::Document document = gsd::parse(content);
    const std::size_t lines = static_cast<std::size_t>(std::count(content.begin(), content.end(), '\n')) + 1;
    std::size_t sum = gsd::sent_by_master(document, gsd::plugged_modules(document)).user.octets.size();
    for (const auto reading : {gsd::Reading::tolerant, gsd::Reading::strict})
        for (const gsd::Finding& finding : gsd::check(document, reading, "EURO0533.GSD")) {
            EXPECT_LE(finding.line, lines);
            EXPECT_FALSE(finding.what.empty());
            EXPECT_EQ(finding.what.find('\n'), std::string::npos) << finding.what;
            sum += finding.line;
        }
    const gsd::IoMap map = gsd::io_map(document, {});
    return sum + map.in_octets + map.out_octets;
}

class Mutations : public testing::TestWithParam<const char*> {
protected:
    std::mt19937 random_{0x0533};
    std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

    void mutate(std::string& text)
    {
        static const std::string pieces[] = {"Module = \"x\" ",
                                             "EndModule\r\n",
                                             "\\\r\n",
                                             "\"",
                                             "=",
                                             "(",
                                             ")",
                                             ";",
                                             "#Profibus_DP\r\n",
                                             "0x",
                                             ",",
                                             "\xEF\xBB\xBF",
                                             "\xE2\x80",
                                             std::string(300, '9'),
                                             "ExtUserPrmData=1 \"a\"\r\nBitArea(",
                                             "\r",
                                             "\n",
                                             "Bit(7) -",
                                             "Ext_User_Prm_Data_Ref(4294967295) = 1\r\n"};
        const std::size_t at = below(text.size());
        switch (random_() % 6) {
            case 0: text.erase(at, below(40)); break;
            case 1: text.insert(at, pieces[below(std::size(pieces))]); break;
            case 2:
                if (!text.empty()) text[at] = static_cast<char>(random_() & 0xFF);
                break;
            case 3: text.insert(at, text.substr(below(text.size()), below(80))); break;
            case 4: text.resize(at); break;
            default: text.insert(at, 1, static_cast<char>(random_() & 0xFF)); break;
        }
    }
};

TEST_P(Mutations, AreReadToTheirEnd)
{
    const std::string good = test::content_of(test::kSource / "gsd" / GetParam());
    ASSERT_FALSE(good.empty());
    for (int round = 0; round < 600; ++round) {
        std::string text = good;
        for (std::size_t i = 0, count = 1 + below(8); i < count; ++i) mutate(text);
        EXPECT_EQ(digest(text), digest(text)) << "round " << round;
    }
}

TEST_P(Mutations, OfEveryBeginningAreReadToTheirEnd)
{
    const std::string good = test::content_of(test::kSource / "gsd" / GetParam());
    for (std::size_t length = 0; length < good.size(); length += 3) digest(good.substr(0, length));
}

INSTANTIATE_TEST_SUITE_P(Of, Mutations,
                         testing::Values("manual/584s-590/EURO0533.GSD", "manual/620/EURO0533.GSD",
                                         "605/605_1649.GSD"),
                         [](const auto& one) { return test::case_name(one.param); });

TEST(Noise, IsReadToItsEnd)
{
    std::mt19937 random{1};
    for (int round = 0; round < 300; ++round) {
        std::string text = round % 2 == 0 ? "#Profibus_DP\n" : "";
        for (std::size_t i = 0, size = random() % 2000; i < size; ++i)
            text += static_cast<char>(random() & 0xFF);
        EXPECT_EQ(digest(text), digest(text));
    }
}

TEST(LongInput, IsCheckedToItsEnd)
{
    std::string text = "#Profibus_DP\r\n";
    for (int i = 0; i < 20000; ++i)
        text += "Unit_Diag_Bit(" + std::to_string(i) + ") = \"x\"\r\nColour = 1\r\n";
    const gsd::Document document = gsd::parse(text);
    EXPECT_EQ(document.keywords.size(), 40000U);
    const gsd::Findings findings = gsd::check(document, gsd::Reading::tolerant);
    EXPECT_EQ(std::count_if(findings.begin(), findings.end(),
                            [](const gsd::Finding& finding) { return finding.line > 0; }),
              20000)
        << "each unknown keyword; a diagnosis of unknown length has room for every bit";
}

} // namespace
} // namespace dpslave
