// SPDX-License-Identifier: Apache-2.0
// Tests what the writer makes: character set, line ends, lengths.
#include "second_hand.hpp"

#include "dpslave/gsd/device.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using gsd::Device;
using test::findings_of;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using testing::StartsWith;

Device small()
{
    Device device;
    device.vendor = "EXAMPLE";
    device.model = "Small";
    device.revision = device.hardware = device.software = "1";
    device.ident = 0x4711;
    device.max_tsdr[index_of(Baud::k187_5)] = Tbit{60};
    device.min_slave_interval = 20;
    device.modules = {{"one word in", {0x50}}};
    device.max_module = 1;
    device.max_in = 2;
    device.max_data = 2;
    return device;
}

std::vector<std::string> lines_of(const std::string& content)
{
    std::vector<std::string> lines;
    std::istringstream stream{content};
    for (std::string line; std::getline(stream, line);) {
        EXPECT_TRUE(!line.empty() && line.back() == '\r') << line;
        lines.push_back(line.substr(0, line.size() - 1));
    }
    return lines;
}

TEST(GsdWriter, PutsTheSectionFirstBecauseTheOldestToolsWantItThere)
{
    Device device = small();
    device.comments = {"Made by hand"};
    EXPECT_THAT(gsd::write(device),
                StartsWith("#Profibus_DP\r\n; Made by hand\r\nGSD_Revision        = 3\r\n"));
}

TEST(GsdWriter, WritesWhatAStrictReaderLikes)
{
    EXPECT_THAT(findings_of(gsd::write(small()), gsd::Reading::strict, "EXMP4711.GSD"), IsEmpty());
}

TEST(GsdWriter, WritesTheSameOctetsForTheSameDevice)
{
    EXPECT_EQ(gsd::write(small()), gsd::write(small()));
}

TEST(GsdWriter, LeavesOutRatesThatAreNotSupported)
{
    const auto read = test::second_hand(gsd::write(small()));
    EXPECT_EQ(read.number("187.5_supp"), 1);
    EXPECT_EQ(read.number("MaxTsdr_187.5"), 60);
    EXPECT_FALSE(read.keys.count("500_supp"));
    EXPECT_FALSE(read.keys.count("MaxTsdr_500"));
}

TEST(GsdWriter, KeepsEveryLineButInfoTextWithin80Characters)
{
    Device device = small();
    device.vendor = device.model = std::string(32, 'W');
    device.description = std::string(gsd::kMaxDescription, 'd');
    device.comments = {"word " + std::string(200, 'x') + " words", "1," + std::string(90, '2') + ",3"};
    for (int i = 0; i < 40; ++i) device.comments[0] += " and another";
    device.prm_comments = {std::string(100, 'c')};
    device.user_prm_data.assign(237, 0xFF);
    device.modules = {{std::string(32, 'M'), std::vector<std::uint8_t>(17, 0x50)}};
    for (const std::string& line : lines_of(gsd::write(device)))
        EXPECT_LE(line.size(), line.starts_with("Info_Text") ? 300U : 80U) << line;
    EXPECT_EQ(gsd::parse(gsd::write(device)).text("Info_Text"), device.description);
}

TEST(GsdWriter, FoldsACommandAtItsBlanksAndALongListAtItsCommas)
{
    Device device = small();
    device.comments = {
        "dpctl gsd make --profile 590 --in 1 --out 2 --description text --model another-one --demand"};
    EXPECT_THAT(gsd::write(device),
                HasSubstr("; dpctl gsd make --profile 590 --in 1 --out 2 --description text --model\r\n"
                          "; another-one --demand\r\n"));
    device.comments = {
        "1111111111,2222222222,3333333333,4444444444,5555555555,6666666666,7777777777,8888888888"};
    EXPECT_THAT(gsd::write(device), HasSubstr("6666666666,7777777777,\r\n; 8888888888\r\n"));
}

TEST(GsdWriter, EndsNoCommentWithABackslashThatWouldContinueIt)
{
    Device device = small();
    device.comments = {"path C:\\"};
    device.prm_comments = {"tag \\"};
    EXPECT_THAT(gsd::write(device), testing::AllOf(HasSubstr("; path C:/\r\n"), HasSubstr("; tag /\r\n")));
}

TEST(GsdWriter, MakesACompactStationOfOneModuleAndPresetOnesOfMore)
{
    Device device = small();
    device.choice_of_modules = false;
    auto read = test::second_hand(gsd::write(device));
    EXPECT_EQ(read.number("Modular_Station"), 0);
    EXPECT_FALSE(read.keys.count("FixPresetModules"));
    EXPECT_THAT(read.cfg(), ElementsAre(0x50));

    device.modules.push_back({"one word out", {0x60}});
    device.max_module = 2;
    device.max_out = 2;
    read = test::second_hand(gsd::write(device));
    EXPECT_EQ(read.number("Modular_Station"), 1);
    EXPECT_EQ(read.number("FixPresetModules"), 1);
    EXPECT_THAT(read.cfg(), ElementsAre(0x50, 0x60));
}

TEST(GsdWriter, HasNoUserPrmDataWhereThereAreNoOctets)
{
    const auto read = test::second_hand(gsd::write(small()));
    EXPECT_EQ(read.number("User_Prm_Data_Len"), 0);
    EXPECT_FALSE(read.keys.count("User_Prm_Data"));
}

TEST(GsdWriter, ContinuesUserPrmDataEveryEightOctetsAsAppendixADoes)
{
    Device device = small();
    device.user_prm_data = {0, 1, 2, 3, 4, 5, 6, 7, 0xAB};
    EXPECT_THAT(gsd::write(device),
                HasSubstr("User_Prm_Data       = 0x00,0x01,0x02,0x03,0x04,0x05,0x06,0x07,\\\r\n"
                          "                      0xAB\r\n"));
}

TEST(Latin1, KeepsWhatItHasAndReplacesTheRest)
{
    EXPECT_EQ(gsd::latin1("Sp\xC3\xA4t 5 \xC2\xB0"), "Sp\xE4t 5 \xB0");
    EXPECT_EQ(gsd::latin1("\xE2\x84\xA6 \xF0\x9F\x98\x80"), "? ?");
    EXPECT_EQ(gsd::latin1("a \"b\"\tc\x7F"), "a 'b' c ");
    EXPECT_EQ(gsd::latin1("\xC3"), "?") << "cut short";
    EXPECT_EQ(gsd::latin1("\x84x\xE2\x84"), "?x??") << "no UTF-8";
}

} // namespace
} // namespace dpslave
