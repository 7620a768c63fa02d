// SPDX-License-Identifier: Apache-2.0
/// The page's requests, asked as the page asks them.
#include "page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ConfiguratorCall, RefusesWhatIsNoRequestWithASentence)
{
    for (const char* request : {"", "\xFF\xFE", "[]", "17", R"({"do": 3})", R"({"do": "dance"})",
                                R"({"do": "check"})", R"({"do": "check", "file": "!"})"}) {
        const json reply = ask_text(request);
        EXPECT_EQ(reply["exit"], 2) << request;
        EXPECT_EQ(reply["refusals"].size(), 1U) << request;
    }
}

TEST(ConfiguratorCall, ListsTheProfilesWithTheirLimits)
{
    const json reply = ask_text(R"({"do": "profiles"})");

    EXPECT_EQ(reply["exit"], 0);
    ASSERT_EQ(reply["profiles"].size(), 9U);
    std::map<std::string, json> by_name;
    for (const json& profile : reply["profiles"]) by_name[profile["name"]] = profile;
    EXPECT_EQ(by_name["2408f"]["max_words"], 117);
    EXPECT_EQ(by_name["590"]["ident"], 0x0533);
    EXPECT_EQ(by_name["590"]["max_parameters"], 12);
    EXPECT_EQ(by_name["605"]["lists"], (json{"in", "out", "in-out"}));
    EXPECT_TRUE(by_name["2408f"]["ident"].is_null());
}

TEST(ConfiguratorCall, GivesTheSampleAsAMapping)
{
    const json reply = ask_text(R"({"do": "samples"})");

    ASSERT_EQ(reply["samples"].size(), 1U);
    EXPECT_EQ(reply["samples"][0]["mapping"]["profile"], "2408f");
    EXPECT_EQ(reply["samples"][0]["mapping"]["list"],
              (json{"in:1", "out:6", "out:8", "out:9", "out:18", "out:17"}));
}

TEST(ConfiguratorCall, ChecksAFileAndNamesLineAndSeverity)
{
    const json reply = ask_text(R"({"do": "check", "name": "A.GSD", "file": "bm90aGluZwo="})"); // "nothing"

    EXPECT_EQ(reply["exit"], 1);
    ASSERT_FALSE(reply["findings"].empty());
    EXPECT_EQ(reply["findings"][0]["severity"], "error");
    EXPECT_THAT(reply["lines"][0].get<std::string>(),
                HasSubstr("A.GSD: error: there is no line #Profibus_DP"));
}

TEST(ConfiguratorCall, ListsTheTagsInTheOrderOfTheChapterWithWhatATreeNeeds)
{
    const json reply = ask({{"do", "tags"}, {"profile", "2408f"}});

    ASSERT_EQ(reply["tags"].size(), 1050U);
    std::map<int, json> by_number;
    for (const json& tag : reply["tags"]) by_number[tag["number"]] = tag;
    EXPECT_EQ(by_number[1]["name"], "Process variable");
    EXPECT_EQ(by_number[5]["access"], "read_only");
    EXPECT_EQ(by_number[5]["writable"], false);
    EXPECT_EQ(by_number[24]["writable"], true);
    EXPECT_EQ(by_number[199]["never_written"], true);
    EXPECT_EQ(by_number[75]["status_word"], true);
    EXPECT_NE(by_number[1]["section"], "");
}

TEST(ConfiguratorCall, TakesATagTableOfTheUser)
{
    const std::string table = "tag,name,type,decimals\n55,Dancer position,INT,2\n";
    const json tags = ask({{"do", "tags"}, {"profile", "590"}, {"table", table}});
    ASSERT_EQ(tags["tags"].size(), 1U);
    EXPECT_EQ(tags["tags"][0]["name"], "Dancer position");

    const json made =
        ask({{"do", "make"}, {"mapping", {{"profile", "590"}, {"list", {"in:55"}}}}, {"table", table}});
    EXPECT_EQ(made["parameters"][0]["name"], "Dancer position");

    const json wrong = ask({{"do", "tags"}, {"profile", "590"}, {"table", "rubbish"}});
    EXPECT_EQ(wrong["exit"], 1);
    EXPECT_FALSE(wrong["refusals"].empty());
}

TEST(ConfiguratorCall, MakesTheFileAndSaysWhichOctetsBelongToWhichParameter)
{
    const json mapping{{"profile", "605"}, {"list", {"out:272", "in:271", "in-out:300"}}, {"demand", true}};
    const json reply = ask({{"do", "make"}, {"mapping", mapping}});

    ASSERT_EQ(reply["exit"], 0);
    const SecondHand file = second_hand(from_base64(reply["octets"]));
    EXPECT_EQ(reply["set_prm"], json(file.octets("User_Prm_Data")));
    EXPECT_EQ(reply["chk_cfg"], json(file.cfg()));
    const json& parameter = reply["parameters"][2];
    EXPECT_EQ(parameter["tag"], 300);
    EXPECT_EQ(parameter["set_prm"], json({7, 2})) << "behind three octets and two tags";
    EXPECT_EQ(parameter["chk_cfg"], json({3, 1}));
    EXPECT_EQ(parameter["in"], json({10, 2}));
    EXPECT_EQ(parameter["out"], json({10, 2}));
    EXPECT_TRUE(reply["parameters"][0]["in"].is_null());
    EXPECT_EQ(reply["used"]["words"], 12);
    EXPECT_EQ(reply["map"]["inputs"].size(), 6U);
}

TEST(ConfiguratorCall, PreviewsWhatIsRefusedAndNamesTheFindingByItsCode)
{
    const json mapping{{"profile", "2408f"}, {"list", {"in:1", "out:199"}}};
    const json reply = ask({{"do", "preview"}, {"mapping", mapping}});

    EXPECT_EQ(reply["exit"], 0);
    EXPECT_FALSE(reply.contains("octets"));
    EXPECT_EQ(reply["set_prm"], json({0, 1, 0, 199}));
    ASSERT_EQ(reply["findings"].size(), 2U);
    EXPECT_EQ(reply["findings"][0]["code"], "ident_missing");
    EXPECT_EQ(reply["findings"][1]["code"], "never_written");
    EXPECT_EQ(reply["findings"][1]["at"], 1);
    EXPECT_EQ(ask({{"do", "make"}, {"mapping", mapping}})["exit"], 1);
}

TEST(ConfiguratorCall, TakesAnEmptyListAsNoParameterAndNotAsTheStandardMapping)
{
    json mapping{{"profile", "2408f"}, {"ident", 0x1652}, {"list", json::array()}};
    const json preview = ask({{"do", "preview"}, {"mapping", mapping}});

    EXPECT_EQ(preview["parameters"], json::array());
    EXPECT_EQ(preview["used"]["words"], 0);
    EXPECT_FALSE(preview.contains("text"));
    EXPECT_EQ(preview["findings"][0]["code"], "no_mapping");
    EXPECT_EQ(ask({{"do", "make"}, {"mapping", mapping}})["exit"], 1);

    mapping["demand"] = true;
    const json made = ask({{"do", "make"}, {"mapping", mapping}});
    EXPECT_EQ(made["chk_cfg"], json({0x73}));
    const json imported = ask({{"do", "import"}, {"file", made["octets"]}, {"profile", "2408f"}});
    EXPECT_EQ(imported["mapping"], mapping);
    EXPECT_EQ(ask({{"do", "read_mapping"}, {"file", imported["octets"]}})["mapping"], mapping);
}

TEST(ConfiguratorCall, LeavesTheListOutWhereAMappingFileHasNone)
{
    const std::string file = "profile = \"2408f\"\nident = 0x1652\n";
    const json read = ask({{"do", "read_mapping"}, {"file", to_base64(file)}});

    EXPECT_FALSE(read["mapping"].contains("list"));
    EXPECT_EQ(ask({{"do", "make"}, {"mapping", read["mapping"]}})["parameters"].size(), 8U);
}

TEST(ConfiguratorCall, WarnsAbove32OctetsAndAbove32Words)
{
    json list = json::array();
    for (int tag = 1; tag <= 33; ++tag) list.push_back("in:" + std::to_string(tag));
    const json reply =
        ask({{"do", "preview"}, {"mapping", {{"profile", "2408f"}, {"ident", 1}, {"list", list}}}});

    std::vector<std::string> codes;
    for (const json& finding : reply["findings"]) codes.push_back(finding["code"]);
    EXPECT_THAT(codes, testing::IsSupersetOf({"over_32_octets", "over_32_words"}));
    EXPECT_EQ(reply["used"]["words"], 33);
    EXPECT_EQ(reply["used"]["max_words"], 117);
}

TEST(ConfiguratorCall, ShowsTheMapOfAFile)
{
    const std::string file = made_file({{"profile", "590"}, {"list", {"in:55", "out:57"}}});
    const json reply = ask({{"do", "show"}, {"file", to_base64(file)}, {"profile", "590"}});

    EXPECT_EQ(reply["exit"], 0);
    EXPECT_EQ(reply["device"]["ident"], 0x0533);
    EXPECT_EQ(reply["map"]["inputs"][0]["tag"], 55);
    EXPECT_EQ(reply["chk_cfg"], json({0x50, 0x60}));
}

TEST(ConfiguratorCall, NamesTheTagsByTheFilesOwnCommentsWhereNoTableHasThem)
{
    const std::string table = "tag,name,type\n7,Dancer position,INT\n8,Line speed,INT\n";
    const auto made = [&](const char* entry) {
        return ask({{"do", "make"},
                    {"mapping", {{"profile", "605"}, {"list", {entry}}}},
                    {"table", table}})["octets"];
    };
    const json shown = ask({{"do", "show"}, {"file", made("in:7")}});
    const json compared = ask({{"do", "diff"}, {"file", made("in:7")}, {"other", made("in:8")}});

    EXPECT_EQ(shown["map"]["inputs"][0]["what"], "Dancer position");
    EXPECT_THAT(compared["meaning"].dump(),
                testing::AllOf(HasSubstr("tag 7 Dancer position"), HasSubstr("tag 8 Line speed")));
}

TEST(ConfiguratorCall, GivesMaxTsdrOfTheFileByRate)
{
    const json plain = ask({{"do", "preview"}, {"mapping", {{"profile", "590"}, {"list", {"in:1"}}}}});
    const json longer =
        ask({{"do", "preview"}, {"mapping", {{"profile", "590"}, {"list", {"in:1"}}, {"max_tsdr", 80}}}});

    EXPECT_EQ(plain["max_tsdr"][0], (json{{"baud", 9600}, {"bits", 60}}));
    EXPECT_EQ(longer["max_tsdr"][0], (json{{"baud", 9600}, {"bits", 80}}));
    EXPECT_EQ(longer["max_tsdr"].back(), plain["max_tsdr"].back()) << "150 at 1.5 Mbit/s is more than 80";
}

TEST(ConfiguratorCall, WritesAMappingAsAFileAndReadsItAgain)
{
    const json mapping{{"profile", "2408f"}, {"list", {"out:24", "in:1"}},
                       {"demand", true},     {"ident", 0x1234},
                       {"max_tsdr", 400},    {"description", "Ofen \"3\" \\ \u00FC"},
                       {"model", "M"}};
    const json written = ask({{"do", "mapping"}, {"mapping", mapping}});
    EXPECT_THAT(from_base64(written["octets"]), HasSubstr("\"out:24\", # Setpoint 1\n"));

    EXPECT_EQ(ask({{"do", "read_mapping"}, {"file", written["octets"]}})["mapping"], mapping);
    const json wrong = ask({{"do", "read_mapping"}, {"file", to_base64("profile = 5")}, {"name", "m.toml"}});
    EXPECT_EQ(wrong["exit"], 1);
    EXPECT_THAT(texts(wrong, "messages"), HasSubstr("m.toml:1:"));
}

TEST(ConfiguratorCall, RefusesAMappingWithWrongKeysByName)
{
    for (const auto& [mapping, key] :
         std::vector<std::pair<json, std::string>>{{json::object(), "profile"},
                                                   {{{"profile", 5}}, "profile"},
                                                   {{{"profile", "590"}, {"list", "in:1"}}, "list"},
                                                   {{{"profile", "590"}, {"list", {1}}}, "list"},
                                                   {{{"profile", "590"}, {"demand", 1}}, "demand"},
                                                   {{{"profile", "590"}, {"ident", 0}}, "ident"},
                                                   {{{"profile", "590"}, {"ident", 1e99}}, "ident"},
                                                   {{{"profile", "590"}, {"max_tsdr", 65536}}, "max_tsdr"},
                                                   {{{"profile", "590"}, {"model", "a\nb"}}, "model"}}) {
        const json reply = ask({{"do", "make"}, {"mapping", mapping}});
        EXPECT_EQ(reply["exit"], 2) << mapping;
        EXPECT_THAT(texts(reply, "refusals"), HasSubstr('"' + key + "\" of the mapping")) << mapping;
    }
}

} // namespace
} // namespace dpslave::test
