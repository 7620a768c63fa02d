// SPDX-License-Identifier: Apache-2.0
// HA389815 appendix B, A-112 to A-114; header, number of flags and widths as X-12 decides.
#include "dpslave/gsd/type_file.hpp"

#include <gmock/gmock.h>

namespace dpslave::gsd {
namespace {

using testing::ElementsAre;

constexpr const char* kPrinted = "Typbeschreibungsdatei DP-Normslave\r\n"
                                 "V4.0;\r\n"
                                 "EUROTHERM 584/590/620;\r\n"
                                 "EUROTHERM ;\r\n"
                                 "SONSTIGE  ;\r\n"
                                 "ET200     ;\r\n"
                                 "DPS/CLASS1     ;\r\n"
                                 "1331 ;\r\n"
                                 "N;\r\nJ;\r\nN;\r\nN;\r\nN;\r\nN;\r\nN;\r\nN;\r\nN;\r\n"
                                 "n;\r\nn;\r\nn;\r\nn;\r\nn;\r\n"
                                 "00020;\r\n"
                                 "0001011111;\r\n"
                                 "032;\r\n032;\r\n032;\r\n016;\r\n031;\r\n"
                                 "PV000;\r\nPSL000;\r\nKV000;\r\nSY;\r\nDKM000;\r\n";

std::vector<std::string> lines_of(std::string content)
{
    std::vector<std::string> lines;
    for (auto end = content.find("\r\n"); end != std::string::npos; end = content.find("\r\n")) {
        lines.push_back(content.substr(0, end));
        content.erase(0, end + 2);
    }
    EXPECT_EQ(content, "") << "the last line has an end";
    return lines;
}

TEST(TypeFile, HasTheFiveNamesOfAppendixB)
{
    std::vector<std::string> names;
    for (const TypeFile& file : type_files(TypeName::printed)) names.push_back(file.name);
    EXPECT_THAT(names,
                ElementsAre("EU0533TE.200", "EU0533TD.200", "EU0533TF.200", "EU0533TS.200", "EU0533TI.200"));
}

TEST(TypeFile, HasTheLinesOfAppendixBInEveryLanguage)
{
    for (const TypeFile& file : type_files(TypeName::printed)) EXPECT_EQ(file.content, kPrinted) << file.name;
}

TEST(TypeFile, FillsItsFieldsWithBlanksToTheirWidths)
{
    const auto lines = lines_of(type_files(TypeName::printed)[0].content);
    const std::size_t widths[] = {21, 10, 10, 10, 15, 5}; // name, vendor, family, type, class, ident
    for (std::size_t i = 0; i < std::size(widths); ++i) {
        EXPECT_EQ(lines.at(2 + i).size(), widths[i] + 1) << lines.at(2 + i);
        EXPECT_EQ(lines.at(2 + i).back(), ';');
    }
}

TEST(TypeFile, HasFourteenFlagsAndEndsEachLineButTheFirstWithASemicolon)
{
    const auto lines = lines_of(type_files(TypeName::printed)[0].content);
    ASSERT_EQ(lines.size(), 8U + 14U + 12U);
    EXPECT_EQ(lines[0].find(';'), std::string::npos);
    for (std::size_t i = 1; i < lines.size(); ++i) EXPECT_EQ(lines[i].find(';'), lines[i].size() - 1) << i;
}

TEST(TypeFile, SpellsTheIdentInDecimal)
{
    EXPECT_EQ(std::stoi(lines_of(type_files(TypeName::printed)[0].content).at(7)), 0x0533);
}

TEST(TypeFile, OffersANameOf17CharactersAndChangesNothingElse)
{
    auto lines = lines_of(type_files(TypeName::brief)[0].content);
    EXPECT_EQ(lines.at(2), "EURO 584/590/620 ;");
    EXPECT_EQ(lines.at(2).size(), 17U + 1U);
    lines[2] = "EUROTHERM 584/590/620;";
    EXPECT_EQ(lines, lines_of(kPrinted));
}

} // namespace
} // namespace dpslave::gsd
