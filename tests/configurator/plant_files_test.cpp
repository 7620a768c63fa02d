// SPDX-License-Identifier: Apache-2.0
// Files of plants with one change each: what a list of modules, a limit, a parameter of a module or a slip
// makes of the verdict, of the mapping and of the file that is made again.
#include "page.hpp"

#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A file of tests/gsd/cases in which each `what` is `by`. A text that is not there is a failure of the test.
std::string changed(const std::string& name, const std::vector<std::pair<std::string, std::string>>& changes)
{
    std::string text = content_of(kSource / "tests/gsd/cases" / name);
    for (const auto& [what, by] : changes) {
        const auto at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        for (auto next = at; next != std::string::npos; next = text.find(what, next + by.size()))
            text.replace(next, what.size(), by);
    }
    return text;
}

json check(const std::string& file, const std::string& profile)
{
    return ask({{"do", "check"}, {"file", to_base64(file)}, {"profile", profile}, {"name", "F.GSD"}});
}
json import(const std::string& file, const std::string& profile, json more = json::object())
{
    more.update({{"do", "import"}, {"file", to_base64(file)}, {"profile", profile}});
    return ask(more);
}
json make(const json& mapping)
{
    return ask({{"do", "make"}, {"mapping", mapping}});
}

TEST(FileOfAPlant, WithIdentifiersOfAnotherFormNamesTheModuleAndTheKeyThatTakesIt)
{
    const json reply = check(changed("PLNT0533.GSD", {{"0x50", "0xD0"}, {"0x60", "0xE0"}}), "590");
    EXPECT_EQ(reply["verdict"]["refusal"]["code"], "cfg_identifier");
    EXPECT_EQ(reply["verdict"]["refusal"]["got"], "0xD0");
    EXPECT_THAT(texts(reply, "lines"),
                HasSubstr("write into its [[station]]: identifiers = [\"D0\", \"E0\"]"));
}

TEST(FileOfAPlant, WhoseLimitEndsItsListsNamesTheLimit)
{
    const auto lines = [](const std::vector<std::pair<std::string, std::string>>& changes) {
        return texts(check(changed("PLNT0533.GSD", changes), "590"), "lines");
    };
    EXPECT_THAT(lines({{"Max_Module = 0x0d", "Max_Module = 2"}}),
                HasSubstr("Max_Module in line 38 allows 2, and 3 modules are more."));
    EXPECT_THAT(lines({{"Max_Input_Len = 0x20", "Max_Input_Len = 2"},
                       {"Max_Output_Len = 0x20", "Max_Output_Len = 2"}}),
                HasSubstr(" allows 2, and the modules make 4 octets."))
        << "three words, and room for one in each direction";
}

TEST(FileOfAPlant, WithAPresetModuleThatMayBeTakenOutIsAChoice)
{
    const json reply =
        check(changed("PLNT0533.GSD",
                      {{"Module = \"Demand-Data\" 0x73", "Module = \"Demand-Data\" 0x73\r\nPreset = 1"}}),
              "590");
    EXPECT_EQ(reply["verdict"]["taken"], true) << texts(reply, "lines");
}

TEST(FileOfAPlant, WhoseMasterHasTheDirectionsIsNotWarnedOfOne)
{
    const json reply = check(changed("PLNT0533.GSD", {}), "590");
    EXPECT_THAT(texts(reply, "lines"), Not(HasSubstr("read only")));
}

TEST(FileOfAPlant, HasTheParametersOfItsModulesBehindThoseOfTheDevice)
{
    const std::string own = "\r\nExt_Module_Prm_Data_Len = 2\r\nExt_User_Prm_Data_Const(0) = 0x00,0x01";
    const std::string file =
        changed("PLNT0533.GSD", {{"Process-Data-Input\" 0x50", "Process-Data-Input\" 0x50" + own},
                                 {"Process-Data-Output\" 0x60", "Process-Data-Output\" 0x60" + own}});
    const json reply = check(file, "590");
    EXPECT_EQ(reply["verdict"]["refusal"]["code"], "prm_length");
    EXPECT_EQ(reply["verdict"]["refusal"]["got"], "30") << "24, and two for each of three modules";
    EXPECT_EQ(import(file, "590")["exit"], 1);
}

TEST(FileOfAPlant, OfTheNewStyleNeedsNoLength)
{
    const json reply = check(changed("SEPM2408.GSD", {{"User_Prm_Data_Len = 8", ""},
                                                      {"User_Prm_Data =", "Ext_User_Prm_Data_Const(0) ="}}),
                             "2408f");
    EXPECT_EQ(reply["verdict"]["taken"], true) << texts(reply, "lines");
    EXPECT_EQ(reply["verdict"]["words"], 4);
}

TEST(FileOfAPlant, WithAModuleThatCannotBeReadIsNotImported)
{
    const json reply = import(changed("PLNT0533.GSD", {{"0x50", "0x5O"}}), "590", {{"lossy", true}});
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "refusals"),
                HasSubstr("the identifiers of the module \"Process-Data-Input\" cannot be read"));
}

TEST(FileOfAPlant, WhoseModulesNoStationCanHaveSaysWhy)
{
    const json octets = import(changed("PLNT0533.GSD", {{"0x60", "0x21"}, {"0x50", "0x11"}}), "590");
    EXPECT_THAT(texts(octets, "refusals"), HasSubstr("\"11\" counts octets: a parameter is a whole word."));
}

TEST(FileOfAPlant, OfAMasterIsSaidToBeOneAndNothingElse)
{
    const std::string file = changed("PLNT0533.GSD", {{"Station_Type = 0", "Station_Type = 1"}});
    const json reply = check(file, "590");
    EXPECT_FALSE(reply.contains("verdict"));
    EXPECT_THAT(texts(reply, "lines"), Not(HasSubstr("judged as")));
    EXPECT_THAT(texts(import(file, "590"), "refusals"), HasSubstr("that of a master"));
}

TEST(FileOfAPlant, KeepsItsModulesWhereTheChkCfgOfTheMasterIsKnown)
{
    const json reply = import(changed("PLNT0533.GSD", {}), "590", {{"cfg", "50 50 60"}});
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "refusals");
    EXPECT_EQ(reply["mapping"]["list"], json({"in:55", "in:56", "out:288"}));
    EXPECT_EQ(reply["mapping"]["modules"].size(), 3U);
    EXPECT_EQ(make(reply["mapping"])["exit"], 0);
}

TEST(FileOfAPlant, ThatIsForADp1SlaveIsNotImportedWithoutAWord)
{
    const json reply = import(
        changed("SEPM2408.GSD", {{"Min_Slave_Intervall = 1", "Min_Slave_Intervall = 20\r\nDPV1_Slave = 1"}}),
        "2408f");
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "refusals"), HasSubstr("DPV1_Slave"));
}

TEST(FileOfAPlant, WithAnotherIdentNamesTheProfilesOfItsModel)
{
    const json reply = import(changed("PLNT0533.GSD", {{"0x0533", "0x9999"}}), "");
    EXPECT_EQ(reply["candidates"], json({"584s", "590"}));
}

TEST(FileOfAPlant, WithAModuleThatTheStationDoesNotTakeSaysNoDirection)
{
    const std::string file = changed("PLNT0533.GSD", {{"0x50", "0x51"}});
    EXPECT_THAT(texts(check(file, "590"), "lines"),
                HasSubstr("takes the module \"Process-Data-Input\" in no list"));
    const json reply = import(file, "590");
    EXPECT_EQ(reply["mapping"]["tags"], json({55, 56, 288}));
    EXPECT_FALSE(reply["mapping"].contains("list")) << "outputs alone would be a guess";
}

TEST(FileOfAPlant, WhoseTagsMayBeginAtSeveralPlacesIsGivenNoNumber)
{
    std::string zeros = "0";
    for (int i = 1; i < 64; ++i) zeros += ",0";
    const std::string file =
        made_file({{"profile", "605"}}) + "User_Prm_Data_Len = 64\r\nUser_Prm_Data = " + zeros + "\r\n";
    const json reply = check(file, "605");
    EXPECT_EQ(reply["verdict"]["taken"], false);
    EXPECT_THAT(texts(reply, "lines"),
                testing::AllOf(HasSubstr("which of several places it is"), Not(HasSubstr("tags_at ="))));
}

TEST(Mapping, WhoseTagsHaveNoDirectionIsMadeForADeviceWithAMappingOfItsOwnToo)
{
    const json mapping{{"profile", "2408f"}, {"ident", 0x2408}, {"tags", {1, 5, 3, 24}}};
    const json reply = make(mapping);
    EXPECT_EQ(reply["exit"], 0) << texts(reply, "refusals");
    const json again = import(from_base64(reply["octets"]), "2408f");
    EXPECT_EQ(again["mapping"]["tags"], mapping["tags"]) << texts(again, "refusals");
}

TEST(Mapping, WhoseModulesAndParametersDifferIsRefused)
{
    const json out{{"name", "A"}, {"identifiers", "60"}}, in{{"name", "B"}, {"identifiers", "50"}};
    json preset = out;
    preset["preset"] = true;
    const json keys{{"profile", "2408f"}, {"ident", 0x2408}};
    const auto made = [&](json list, json modules, bool demand = false) {
        json mapping = keys;
        mapping.update({{"list", std::move(list)}, {"modules", std::move(modules)}, {"demand", demand}});
        return make(mapping);
    };
    for (const json& reply :
         {made({"in:5"}, {preset}), made({"in:1", "in:5"}, {out}), made({"in:1"}, {in, out}, true)}) {
        EXPECT_EQ(reply["exit"], 1);
        EXPECT_THAT(texts(reply, "refusals"),
                    HasSubstr("the modules of the mapping do not make its parameters"));
    }
    EXPECT_EQ(made({"in:1", "out:24"}, {in, out})["exit"], 0);
}

TEST(Mapping, WhoseFileAToolWouldRefuseIsNotMade)
{
    const json reply = make({{"profile", "590"}, {"list", {"in:55"}}, {"max_input_len", 0}});
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "refusals"), HasSubstr("the file would be faulty: the module"));
}

TEST(Mapping, WithModulesAloneHasNoTagsOfTheProfile)
{
    const json reply = make(
        {{"profile", "2408f"}, {"ident", 0x2408}, {"modules", {{{"name", "A"}, {"identifiers", "50"}}}}});
    EXPECT_EQ(reply["exit"], 1) << "no tag stands in it";
}

TEST(Mapping, OfAStationWithoutAnIdentifierForItsDirectionSaysWhichIsMissing)
{
    const json reply = make({{"profile", "590"}, {"identifiers", {"60"}}, {"list", {"in:55"}}});
    EXPECT_THAT(texts(reply, "refusals"), HasSubstr("no identifier for an input"));
}

} // namespace
} // namespace dpslave::test
