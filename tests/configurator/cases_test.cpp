// SPDX-License-Identifier: Apache-2.0
// Files of plants: what is said of them is what the slave does with them, and what a mapping makes of them is
// what the master sends already.
#include "page.hpp"

#include "dpslave/configurator/station_check.hpp"
#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string plant_file(const std::string& name)
{
    return content_of(kSource / "tests/gsd/cases" / name);
}

json check_of(const std::string& file, const std::string& profile = "")
{
    return ask({{"do", "check"}, {"file", to_base64(file)}, {"profile", profile}, {"name", "F.GSD"}});
}

json import_plant(const std::string& name, json more = json::object())
{
    more.update({{"do", "import"}, {"file", to_base64(plant_file(name))}});
    return ask(more);
}

struct Verdict {
    std::string file;
    std::string code; ///< of the refusal; empty: it is taken
    std::string telegram;
    unsigned line, octet; ///< 0: none
    std::string says;     ///< a part of the lines
};
void PrintTo(const Verdict& verdict, std::ostream* out)
{
    *out << verdict.file;
}

class PlantFile : public testing::TestWithParam<Verdict> {};

TEST_P(PlantFile, IsJudgedAsTheSlaveDoes)
{
    const Verdict& wanted = GetParam();
    const json reply = check_of(plant_file(wanted.file));
    EXPECT_EQ(reply["exit"], wanted.code.empty() ? 0 : 1) << texts(reply, "lines");
    ASSERT_TRUE(reply.contains("verdict")) << texts(reply, "lines");
    EXPECT_EQ(reply["verdict"]["taken"], wanted.code.empty());
    EXPECT_THAT(texts(reply, "lines"), HasSubstr(wanted.says));
    if (wanted.code.empty()) return;
    const json& refusal = reply["verdict"]["refusal"];
    EXPECT_EQ(refusal["code"], wanted.code);
    EXPECT_EQ(refusal["telegram"], wanted.telegram);
    EXPECT_EQ(refusal["line"], wanted.line);
    EXPECT_EQ(refusal["octet"], wanted.octet == 0 ? json() : json(wanted.octet));
}

INSTANTIATE_TEST_SUITE_P(
    OfThePlant, PlantFile,
    testing::Values(Verdict{"SEPM2408.GSD", "", "", 0, 0,
                            "judged as a file for 2408f: it fits with 4 words: map."},
                    Verdict{"PLNT0533.GSD", "", "", 0, 0,
                            "judged as a file for 584s or 590: it fits with 3 words, for example: "},
                    Verdict{"BOM0533.GSD", "", "", 0, 0, "The tags are in the master's project"},
                    Verdict{"LEAD2408.GSD", "prm_length", "Set_Prm", 31, 0,
                            "User_Prm_Data has a wrong length, expected 8 octets"},
                    Verdict{"WORD2408.GSD", "cfg_identifier", "Chk_Cfg", 36, 1, "expected 0x50, got 0x52"},
                    Verdict{"HAND.GSD", "cfg_too_few", "Chk_Cfg", 59, 0,
                            "expected 9 identifiers for as many tags, got 8"},
                    Verdict{"mod-two-tags-three-identifiers.GSD", "cfg_too_many", "Chk_Cfg", 44, 3,
                            "expected 2 identifiers"}),
    [](const auto& one) { return one.param.file.substr(0, one.param.file.find_first_of(".-")); });

TEST(PlantFiles, AreTakenWithTheKeysThatImportFinds)
{
    const json reply = import_plant("LEAD2408.GSD", {{"lossy", true}});
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "refusals");
    EXPECT_EQ(reply["mapping"]["tags_at"], 1);
    EXPECT_THAT(texts(reply, "messages"),
                HasSubstr("the station takes this file only with tags_at and identifiers of the mapping"));
    EXPECT_EQ(reply["mapping"]["identifiers"], json({"52", "60"}));
    EXPECT_EQ(reply["mapping"]["list"], json({"in:1", "in:5", "in:3", "out:24"}));

    const json words = import_plant("WORD2408.GSD", {{"lossy", true}});
    EXPECT_FALSE(words["mapping"].contains("tags_at")) << "the file does not differ there";
    EXPECT_EQ(words["mapping"]["identifiers"], json({"52", "60"}));
}

TEST(PlantFiles, KeepTheTagsThatTheyHave)
{
    const json separate = import_plant("SEPM2408.GSD", {{"lossy", true}});
    EXPECT_EQ(separate["mapping"]["list"], json({"in:1", "in:5", "in:3", "out:24"}));
    EXPECT_FALSE(separate["mapping"].contains("identifiers"));

    const json typed = import_plant("PLNT0533.GSD", {{"profile", "590"}});
    EXPECT_EQ(typed["exit"], 0) << texts(typed, "refusals");
    EXPECT_EQ(typed["mapping"]["tags"], json({55, 56, 288}));
    EXPECT_FALSE(typed["mapping"].contains("list")) << "a direction is never guessed";
    EXPECT_THAT(texts(typed, "messages"),
                HasSubstr("the directions of the tags are in the master's project"));
}

TEST(PlantFiles, HaveTheDirectionsOfTheMastersLastChkCfg)
{
    const json reply =
        import_plant("PLNT0533.GSD", {{"profile", "590"}, {"cfg", "73 50 60 50"}, {"lossy", true}});
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "refusals");
    EXPECT_EQ(reply["mapping"]["list"], json({"in:55", "out:56", "in:288"}));
    EXPECT_EQ(reply["mapping"]["demand"], true);

    const json foreign = import_plant("PLNT0533.GSD", {{"profile", "590"}, {"cfg", "50 70 50"}});
    EXPECT_EQ(foreign["exit"], 1);
    EXPECT_THAT(texts(foreign, "refusals"), HasSubstr("50 70 50 is not made of the modules of the file"));
}

TEST(PlantFiles, ThatNoKeyMakesTheStationTakeAreRefused)
{
    for (const char* name : {"HAND.GSD", "mod-two-tags-three-identifiers.GSD"}) {
        const json reply =
            import_plant(name, {{"profile", name[0] == 'H' ? "2408f" : "590"}, {"lossy", true}});
        EXPECT_EQ(reply["exit"], 1) << name;
        EXPECT_THAT(texts(reply, "refusals"), HasSubstr("Chk_Cfg would be refused")) << name;
    }
}

/// What a master sends and waits for by a file that was made or is a plant's: by the show command.
json sent(const std::string& file, const std::string& profile)
{
    const json shown = ask({{"do", "show"}, {"file", to_base64(file)}, {"profile", profile}});
    return {{"set_prm", shown["set_prm"]}, {"chk_cfg", shown["chk_cfg"]}, {"map", shown["map"]}};
}

/// Modules and lengths, by the second hand.
json keys_of(const std::string& file)
{
    const SecondHand read = second_hand(file);
    json all{{"modules", json::array()}};
    for (const char* key :
         {"Modular_Station", "Max_Module", "Max_Input_Len", "Max_Output_Len", "Max_Data_Len"})
        all[key] = read.number(key);
    for (const auto& module : read.modules) all["modules"].push_back({module.name, module.identifiers});
    return all;
}

TEST(PlantFiles, AreMadeAgainAsTheMasterKnowsThem)
{
    for (const auto& [name, profile] :
         {std::pair{"SEPM2408.GSD", "2408f"}, std::pair{"PLNT0533.GSD", "590"},
          std::pair{"LEAD2408.GSD", "2408f"}, std::pair{"WORD2408.GSD", "2408f"},
          std::pair{"BOM0533.GSD", "590"}}) {
        const json first = import_plant(name, {{"profile", profile}, {"lossy", true}});
        const json made = ask({{"do", "make"}, {"mapping", first["mapping"]}});
        ASSERT_EQ(made["exit"], 0) << name << texts(made, "refusals") << first["mapping"];
        const std::string file = from_base64(made["octets"]);
        const json again =
            ask({{"do", "import"}, {"file", to_base64(file)}, {"profile", profile}, {"lossy", false}});
        EXPECT_EQ(again["exit"], 0) << name << texts(again, "refusals");
        EXPECT_EQ(again["mapping"], first["mapping"]) << name;
        EXPECT_EQ(sent(file, profile), sent(plant_file(name), profile)) << name;
        EXPECT_EQ(keys_of(file), keys_of(plant_file(name))) << name;
        // The mapping is a file too.
        const json kept = ask({{"do", "read_mapping"}, {"file", first["octets"]}});
        EXPECT_EQ(kept["mapping"], first["mapping"]) << name << texts(kept, "messages");
    }
}

TEST(PlantFiles, AreNotImportedWithoutAWordWhereAMasterWouldSendSomethingElse)
{
    const json refused = import_plant("SEPM2408.GSD");
    EXPECT_EQ(refused["exit"], 1);
    EXPECT_THAT(texts(refused, "refusals"),
                AllOf(HasSubstr("Min_Slave_Intervall"), HasSubstr("Max_Diag_Data_Len"),
                      Not(HasSubstr("Hardware_Release"))));
    EXPECT_EQ(refused["mapping"]["list"], json({"in:1", "in:5", "in:3", "out:24"}))
        << "it is there all the same";
    const json taken = import_plant("SEPM2408.GSD", {{"lossy", true}});
    EXPECT_EQ(taken["exit"], 0);
    EXPECT_THAT(texts(taken, "messages"), HasSubstr("Min_Slave_Intervall = 1 becomes 20"));
}

TEST(Recognition, ReadsWhatTheFileSaysBeforeAnybodyIsAsked)
{
    const auto profiles = [](const std::string& file) { return check_of(file)["profiles"]; };
    std::string named = plant_file("PLNT0533.GSD");
    EXPECT_EQ(profiles(named), json({"584s", "590"})) << "Model_Name 584S/590";
    EXPECT_EQ(profiles(plant_file("SEPM2408.GSD")), json({"2408f"})) << "a word of Model_Name";
    EXPECT_EQ(profiles(plant_file("HAND.GSD")), json({"2408f"})) << "the comment of our own files";
    EXPECT_EQ(profiles(made_file({{"profile", "590"}, {"list", {"in:55"}}})), json({"590"}));
    const json foreign = check_of("#Profibus_DP\r\nGSD_Revision = 1\r\nVendor_Name = \"Siemens AG\"\r\n"
                                  "Model_Name = \"ET 200B\"\r\nIdent_Number = 0x8044\r\n");
    EXPECT_THAT(foreign["profiles"], IsEmpty());
    EXPECT_THAT(texts(foreign, "lines"), HasSubstr("only the form was judged"));
}

TEST(Recognition, OfAT630OpensItsFileForReadingCheckingAndComparingAndNotForEditing)
{
    const std::string file =
        "#Profibus_DP\r\nGSD_Revision = 1\r\nVendor_Name = \"EUROTHERM\"\r\nModel_Name = \"T630\"\r\n"
        "Ident_Number = 0x0534\r\nModule = \"m\" 0x50\r\nEndModule\r\n";
    const json checked = check_of(file);
    EXPECT_THAT(checked["profiles"], IsEmpty());
    EXPECT_THAT(texts(checked, "lines"), HasSubstr("only the form was judged"));
    EXPECT_EQ(ask({{"do", "show"}, {"file", to_base64(file)}})["exit"], 0);
    EXPECT_EQ(ask({{"do", "diff"}, {"file", to_base64(file)}, {"other", to_base64(file)}})["exit"], 0);
    const json edited = ask({{"do", "import"}, {"file", to_base64(file)}, {"profile", "2408f"}});
    EXPECT_EQ(edited["exit"], 1);
    EXPECT_THAT(texts(edited, "refusals"), HasSubstr("T630"));
}

TEST(Check, JudgesOneListOfModulesWhereItIsAsked)
{
    const auto judged = [](const std::vector<std::string>& modules) {
        configurator::CheckOptions how;
        how.profile = "590";
        how.modules = modules;
        return json::parse(configurator::reply_of(
            configurator::check({shipped, "profiles", {}}, plant_file("PLNT0533.GSD"), "F.GSD", how)));
    };
    EXPECT_EQ(judged({"Process-Data-Input", "#3", "process-data-output"})["exit"], 0);
    const json fewer = judged({"Process-Data-Input"});
    EXPECT_EQ(fewer["exit"], 1);
    EXPECT_EQ(fewer["verdict"]["refusal"]["code"], "cfg_too_few");
    const json demand =
        judged({"Process-Data-Input", "Process-Data-Input", "Process-Data-Output", "Demand-Data"});
    EXPECT_EQ(demand["verdict"]["refusal"]["octet"], 4) << "Demand Data can only be the first";
    EXPECT_EQ(judged({"Speed"})["exit"], 2);
}

TEST(Check, RefusesIdentifiersThatOnlyLookLikeThoseOfTheDevice)
{
    std::string file = made_file({{"profile", "590"}, {"list", {"in:55", "out:56"}}});
    file.replace(file.find("0x50,0x60"), 9, "0xD0,0xE0");
    const json reply = check_of(file);
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_EQ(reply["verdict"]["refusal"]["code"], "cfg_identifier");
    EXPECT_EQ(reply["verdict"]["refusal"]["octet"], 1);
}

} // namespace
} // namespace dpslave::test
