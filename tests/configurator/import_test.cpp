// SPDX-License-Identifier: Apache-2.0
// A mapping out of a GSD file (C-033).
#include "page.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

json import_of(const std::string& file, const std::string& profile = "")
{
    json request{{"do", "import"}, {"file", to_base64(file)}};
    if (!profile.empty()) request["profile"] = profile;
    return ask(request);
}

std::string with_line(std::string file, const std::string& line)
{
    return file.insert(file.find("Ident_Number"), line + "\r\n");
}

/// The identifiers of the only module.
std::string with_module(std::string file, const std::string& identifiers)
{
    const auto at = file.find("0x", file.find("Module = "));
    return file.replace(at, file.find("\r\n", at) - at, identifiers);
}

/// As another program would have written it: no comment says for which profile it was made.
std::string of_another_program(std::string file)
{
    const std::string said = "; Made for the profile ";
    return file.replace(file.find(said), said.size(), "; Once it was for ");
}

TEST(Import, FindsTheProfileByIdentAndModelTogether)
{
    EXPECT_EQ(import_of(of_another_program(
                  made_file({{"profile", "620"}, {"list", {"in:55"}}})))["mapping"]["profile"],
              "620");
    EXPECT_EQ(import_of(content_of(kSource / "gsd/605/605_1649.GSD"))["mapping"]["profile"], "605");
}

TEST(Import, RefusesWhatMayBeOfSeveralProfilesAndNamesThem)
{
    const json drives = import_of(of_another_program(made_file({{"profile", "590"}, {"list", {"in:55"}}})));
    EXPECT_EQ(drives["exit"], 1);
    EXPECT_EQ(drives["candidates"], json({"584s", "590"})) << "the same ident and the same model";
    EXPECT_THAT(texts(drives, "refusals"), HasSubstr("Name the profile, one of 584s, 590."));

    const json renamed = import_of(
        of_another_program(made_file({{"profile", "620"}, {"list", {"in:55"}}, {"model", "Unwinder"}})));
    EXPECT_EQ(renamed["candidates"], json({"584s", "590", "620"})) << "ident 0x0533 alone";

    const json controllers = import_of(of_another_program(
        made_file({{"profile", "2408f"}, {"ident", 0x1234}, {"demand", true}, {"list", json::array()}})));
    EXPECT_EQ(controllers["candidates"], json({"2404f", "2408f"})) << "no ident, the same model";
}

TEST(Import, KeepsTheOrderOfInputsAndOutputs)
{
    const json list{"out:3", "in:1", "in-out:9", "out:2"};
    const json reply = import_of(made_file({{"profile", "605"}, {"list", list}, {"demand", true}}));

    EXPECT_EQ(reply["exit"], 0);
    EXPECT_EQ(reply["mapping"], json({{"profile", "605"}, {"list", list}, {"demand", true}}));
    EXPECT_THAT(reply["lost"], IsEmpty());
    EXPECT_THAT(from_base64(reply["octets"]), HasSubstr("list = [\n  \"out:3\","));
}

TEST(Import, NamesWhatGetsLostWithItsLine)
{
    std::string file = made_file({{"profile", "605"}, {"list", {"in:1"}}});
    file = with_line(file, "User_Friendly_Thing = 17");
    file = with_line(file, "Unit_Diag_Bit(3) = \"Door open\"");
    const json reply = import_of(file);

    EXPECT_EQ(reply["exit"], 0);
    EXPECT_THAT(texts(reply, "messages"),
                testing::AllOf(HasSubstr("User_Friendly_Thing = 17 gets lost"),
                               HasSubstr("Unit_Diag_Bit(3) = \"Door open\" gets lost")));
    ASSERT_EQ(reply["lost"].size(), 2U);
    EXPECT_GT(reply["lost"][0]["line"], 0);
}

TEST(Import, TakesTheFilesOfTheManualsAndNamesTheirDifferences)
{
    const json reply = import_of(content_of(kSource / "gsd/manual/584s-590/EURO0533.GSD"), "590");
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "refusals");
    EXPECT_FALSE(reply["mapping"].contains("list")) << "its modules are put together by the master's tool";
}

TEST(Import, RefusesAnotherDeviceWithTheReason)
{
    const json other = import_of(made_file({{"profile", "605"}, {"list", {"in-out:9"}}}), "590");
    EXPECT_EQ(other["exit"], 1);
    EXPECT_THAT(texts(other, "refusals"),
                HasSubstr("Set_Prm would be refused: User_Prm_Data has a wrong length"));

    const json zeros = import_of(made_file({{"profile", "620"}, {"list", {"in:55"}}}), "605");
    EXPECT_EQ(zeros["exit"], 1) << "its tags stand three octets further";

    const json unknown = import_of("#Profibus_DP\nModel_Name = \"T630\"\nIdent_Number = 1\n");
    EXPECT_THAT(texts(unknown, "refusals"), HasSubstr("T630"));
}

TEST(Import, RefusesTheFileOfAnotherVendorWithTheReason)
{
    const std::string foreign = "#Profibus_DP\r\nGSD_Revision = 1\r\nVendor_Name = \"Siemens AG\"\r\n"
                                "Model_Name = \"ET 200B\"\r\nIdent_Number = 0x8044\r\n";
    const json refused = import_of(foreign);
    EXPECT_EQ(refused["exit"], 1);
    EXPECT_FALSE(refused.contains("candidates"));
    EXPECT_THAT(
        texts(refused, "refusals"),
        HasSubstr(R"(no profile has Ident_Number 0x8044, Model_Name "ET 200B" or Vendor_Name "Siemens AG")"));

    std::string older = foreign;
    older.replace(older.find("Siemens AG"), 10, "Eurotherm ");
    EXPECT_THAT(import_of(older)["candidates"], testing::Contains("2408f"))
        << "a vendor of these devices, and several of them have no ident";
}

TEST(Import, OfAMappingThatCannotBeMadeAgainSaysSoAndGivesItToBeCorrected)
{
    std::string file = made_file({{"profile", "605"}, {"list", {"in:1"}}});
    const std::size_t model = file.find('"', file.find("Model_Name"));
    file.insert(model + 1, 40, 'x');
    const json reply = import_of(file, "605");

    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "refusals"), HasSubstr("model"));
    EXPECT_EQ(reply["mapping"]["list"], json({"in:1"}));
}

TEST(Show, OfNoGsdFileIsRefusedInASentence)
{
    const json reply = ask({{"do", "show"}, {"file", to_base64("just a text\n")}});
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_EQ(texts(reply, "refusals"), "there is no line #Profibus_DP: this is no GSD file.\n");
    EXPECT_THAT(reply["messages"], IsEmpty());
}

TEST(Show, OfAFileWithASlipSaysTheLineAsTheCheckDoes)
{
    for (const char* const request : {"show", "import"}) {
        const json reply = ask({{"do", request}, {"file", to_base64("; a file\r\n#Profibus-DP\r\n")}});
        EXPECT_EQ(reply["exit"], 1);
        EXPECT_EQ(texts(reply, "refusals"),
                  "line 2: \"#Profibus-DP\": the line that begins a GSD file is #Profibus_DP.\n");
    }
}

/// The sentence is that of the check; without it a default would stand in silence.
TEST(Opened, AFileWithASlipIsReadAndTheLineIsNamed)
{
    const std::string good = made_file({{"profile", "605"}, {"list", {"in:1"}}});
    std::string slip = good;
    slip.replace(slip.find("Max_Diag_Data_Len"), 17, "Max_Diag_Dta_Len ");
    const auto line = 1 + std::count(slip.begin(), slip.begin() + static_cast<long>(slip.find("Dta")), '\n');
    const std::string sentence = "line " + std::to_string(line) +
                                 ": unknown keyword \"Max_Diag_Dta_Len\": the standard spells it "
                                 "\"Max_Diag_Data_Len\".\n";

    EXPECT_THAT(texts(ask({{"do", "show"}, {"file", to_base64(slip)}}), "messages"),
                HasSubstr("warning: " + sentence));
    EXPECT_THAT(texts(import_of(slip, "605"), "messages"), HasSubstr("warning: " + sentence));
    EXPECT_THAT(
        texts(ask({{"do", "diff"}, {"file", to_base64(good)}, {"other", to_base64(slip)}}), "messages"),
        testing::EndsWith("warning: the second file: " + sentence));
    EXPECT_THAT(texts(ask({{"do", "show"}, {"file", to_base64(good)}}), "messages"), IsEmpty());
}

TEST(Opened, AFileThatIsRefusedForASlipNamesIt)
{
    std::string file = made_file({{"profile", "605"}, {"list", {"in:1"}}});
    file.replace(file.find("Ident_Number"), 12, "Ident_Numbre");
    const json reply = import_of(file, "605");
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "messages"), HasSubstr("the standard spells it \"Ident_Number\"."));
}

TEST(Opened, AFileWithManySlipsNamesTenOfThem)
{
    std::string file = made_file({{"profile", "605"}, {"list", {"in:1"}}});
    for (int i = 0; i < 12; ++i) file += "Hello\r\n";
    const json reply = ask({{"do", "show"}, {"file", to_base64(file)}});
    EXPECT_EQ(reply["messages"].size(), 11U) << texts(reply, "messages");
    EXPECT_THAT(
        texts(reply, "messages"),
        testing::EndsWith("warning: 2 more lines are not understood: check the file to read them.\n"));
}

TEST(Opened, AnEmptySlotIsNamed)
{
    const std::string file = with_module(made_file({{"profile", "605"}, {"list", {"in:1"}}}), "0x00,0x50");
    EXPECT_THAT(texts(import_of(file, "605"), "refusals"),
                HasSubstr("Chk_Cfg would be refused: an identifier is not legal here, octet 1, expected "
                          "0x50, got 0x00, an empty slot"));
    EXPECT_THAT(texts(ask({{"do", "show"}, {"file", to_base64(file)}}), "lines"),
                HasSubstr("has 1 empty slot (identifier 0x00), which takes no place in the telegrams"));
}

TEST(Import, KeepsTheMaxTsdrOfTheMachine)
{
    const json mapping{{"profile", "620"}, {"list", {"in:55"}}, {"demand", false}, {"max_tsdr", 120}};
    EXPECT_EQ(import_of(made_file(mapping))["mapping"], mapping);
}

} // namespace
} // namespace dpslave::test
