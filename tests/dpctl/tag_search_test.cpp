// SPDX-License-Identifier: Apache-2.0
#include "control/bench.hpp"
#include "control/lines.hpp"
#include "dpctl/tags/render_tags.hpp"
#include "dpctl/tags/tag_search.hpp"
#include "support/paths.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace dpslave::dpctl {
namespace {

using testing::HasSubstr;

constexpr const char* kTable = R"(tag,name,type,decimals,min,max,access,mnemonic,register,values,section,notes
270,Autotune enable,ENUM,,,,rw,AT,,0=No tune;1=Tune,Autotune,written in the Demand Data example
12,Speed feedback,REAL,2,-300.00,300.00,ro,,32780,,Speed,
12,Rotations,,,,,,,,,,
75,Summary output status,WORD,,,,,,,bit0=Alarm 1;bit4=Manual,Status,
1119,Speed demand 1,INT,1,0.0,100.0,wo,,,,Speed,
8356,Program 1 segment 3: Segment type,ENUM,,,,rw,,,0=End;5=Call,Program 1,
8360,Program 1 segment 4: Segment type,ENUM,,,,rw,,,0=End;5=Call,Program 1,base 8328 offset 32
8363,Program 1 segment 4: Program number or end type,INT,0,0,65535,rw,,,,Program 1,
8744,Program 4 segment 1: Segment type,ENUM,,,,rw,,,0=End;5=Call,Program 4,
20000,Far away,INT,0,,,rw,,,,,
)";

class TagLookup : public testing::Test {
protected:
    TagLookup()
    {
        std::ofstream{folder.path() / "own.csv"} << kTable;
        tables = load_table(folder.path() / "own.csv");
    }
    std::vector<int> numbers(const std::vector<std::string>& query, bool all = false) const
    {
        std::vector<int> found;
        for (const TagHit& hit : search(tables.files, query, all).hits) found.push_back(hit.tag->number);
        return found;
    }
    std::string shown(const std::vector<std::string>& query) const
    {
        return render_tags(search(tables.files, query, false), false);
    }
    using Numbers = std::vector<int>;
    test::TempFolder folder;
    TagFiles tables;
};

TEST_F(TagLookup, FindsANumberInDecimalAndHexadecimal)
{
    ASSERT_TRUE(tables.faults.empty()) << tables.faults[0];
    EXPECT_EQ(numbers({"270"}), Numbers{270});
    EXPECT_EQ(numbers({"0x10E"}), Numbers{270});
    EXPECT_EQ(numbers({">10e"}), Numbers{270});
    EXPECT_EQ(numbers({"270", "12"}), (Numbers{270, 12}));
    EXPECT_EQ(numbers({"271"}), Numbers{});
}

TEST_F(TagLookup, FindsWordsInNameAliasAndSectionInAnyCase)
{
    EXPECT_EQ(numbers({"autotune"}), Numbers{270});
    EXPECT_EQ(numbers({"ROTATIONS"}), Numbers{12});
    EXPECT_EQ(numbers({"speed"}), (Numbers{12, 1119}));
    EXPECT_EQ(numbers({"speed", "feed"}), Numbers{12});
    EXPECT_EQ(numbers({"speed status"}), Numbers{});
}

TEST_F(TagLookup, ANumberInAQueryBelongsToTheWordBeforeIt)
{
    EXPECT_EQ(numbers({"program", "1", "segment", "4", "type"}), Numbers{8360});
    EXPECT_EQ(numbers({"program 4 segment 1 type"}), Numbers{8744});
    EXPECT_EQ(numbers({"prog", "1", "seg", "4", "end", "type"}), Numbers{8363});
    EXPECT_EQ(numbers({"segment", "5"}), Numbers{});
    EXPECT_EQ(numbers({"segment", "40"}), Numbers{});
}

TEST_F(TagLookup, LeavesNamesThatSayMoreToAll)
{
    EXPECT_EQ(search(tables.files, {"program", "1", "segment", "4", "type"}, false).left_out, 1u);
    EXPECT_EQ(numbers({"program", "1", "segment", "4", "type"}, true), (Numbers{8360, 8363}));
    EXPECT_THAT(shown({"program", "1", "segment", "4", "type"}),
                HasSubstr("\n1 name more with these words; --all shows them\n"));
}

TEST_F(TagLookup, ShowsAllColumnsOfATag)
{
    EXPECT_EQ(shown({"270"}), test::lines(R"(
own.csv: tag 270 (0x010E) Autotune enable
  type         ENUM
  values       0 = No tune
               1 = Tune
  access       read and write
  Demand Data  read 4366 (0x110E), write 8462 (0x210E)
  Modbus       register 270
  mnemonic     AT
  section      Autotune
  notes        written in the Demand Data example
)"));
    EXPECT_EQ(shown({"12"}), test::lines(R"(
own.csv: tag 12 (0x000C) Speed feedback
  also         Rotations
  type         REAL, 2 decimals
  limits       -300.00 to 300.00
  access       read only
  Demand Data  read 4108 (0x100C)
  Modbus       registers 32780 and 32781, IEEE
  section      Speed
)"));
    EXPECT_THAT(shown({"75"}), HasSubstr("  bits         0 = Alarm 1\n               4 = Manual\n"));
    EXPECT_THAT(shown({"75"}), HasSubstr("  access       not known: the device decides\n"));
}

TEST_F(TagLookup, NamesTheWordsOfDemandDataAlsoAbove2047)
{
    EXPECT_THAT(shown({"1119"}), HasSubstr("  Demand Data  write 9311 (0x245F)\n"));
    EXPECT_THAT(shown({"8360"}),
                HasSubstr("  Demand Data  read 12288 (0x3000), write 16384 (0x4000), with 8360 "
                          "(0x20A8) in\n               register 2\n"));
    EXPECT_THAT(shown({"20000"}), HasSubstr("  Demand Data  none: it takes tags up to 16383\n"));

    tables.files[0].extended_demand = false;
    EXPECT_THAT(shown({"8360"}), HasSubstr("  Demand Data  none: it takes tags up to 2047\n"));
}

TEST_F(TagLookup, SaysThatTheGatewayNeverWritesATag)
{
    tables.files[0].never_written = {270};

    EXPECT_THAT(shown({"270"}), HasSubstr("  access       read only: the gateway never writes it\n"));
    EXPECT_THAT(shown({"270"}), HasSubstr("  Demand Data  read 4366 (0x110E)\n"));
}

TEST_F(TagLookup, PrintsManyInOneLineEach)
{
    std::ofstream many{folder.path() / "many.csv"};
    many << "tag,name,type\n";
    for (int i = 1; i <= 11; ++i) many << i << ",Input " << i << ",INT\n";
    many.close();
    tables = load_table(folder.path() / "many.csv");

    const std::string picture = shown({"input"});

    EXPECT_EQ(picture.find("TABLE     TAG  HEX   NAME      TYPE  ACCESS"), 0u) << picture;
    EXPECT_THAT(picture, HasSubstr("\nmany.csv   11  000B  Input 11  INT   not known: the device decides\n"));
    EXPECT_THAT(picture, HasSubstr("\nall about one of them: dpctl tag NUMBER\n"));
}

TEST(TagLists, AreInTheOrderOfTheTableAndSayWhenATagCanBeWritten)
{
    const test::TempFolder folder;
    std::ofstream{folder.path() / "own.csv"} << "tag,name,type,when\n61,Mode B,ENUM,configuration\n"
                                                "60,Mode A,ENUM,stopped\n7,Mode C,ENUM,\n";
    const TagFiles tables = load_table(folder.path() / "own.csv");
    std::vector<int> numbers;
    for (const TagHit& hit : search(tables.files, {"mode"}, true).hits) numbers.push_back(hit.tag->number);
    EXPECT_THAT(numbers, testing::ElementsAre(61, 60, 7));
    EXPECT_THAT(render_tags(search(tables.files, {"60"}, false), false),
                HasSubstr("  writable     only while the drive is stopped\n"));
    EXPECT_THAT(render_tags(search(tables.files, {"61"}, false), false),
                HasSubstr("  writable     only in configuration mode\n"));
    EXPECT_THAT(render_tags(search(tables.files, {"7"}, false), false), testing::Not(HasSubstr("writable")));
}

TEST_F(TagLookup, GivesTheSameAsJson)
{
    EXPECT_EQ(tags_json(search(tables.files, {"270"}, false)),
              Json::parse(R"({"tags":[{"table":"own.csv","tag":270,
        "hex":"010E","name":"Autotune enable","aliases":[],"type":"ENUM","decimals":0,"follows_display":false,
        "unsigned":false,"min":null,"max":null,"access":"read and write","when":"","mnemonic":"AT","modbus_register":270,
        "demand_data":{"read":"110E","write":"210E","extended":false},
        "values":[{"number":0,"text":"No tune"},{"number":1,"text":"Tune"}],"bits":[],"section":"Autotune",
        "notes":"written in the Demand Data example"}]})"));
    const Json speed = tags_json(search(tables.files, {"12"}, false))["tags"][0];
    EXPECT_EQ(speed["min"], "-300.00");
    EXPECT_EQ(speed["aliases"], Json::parse(R"(["Rotations"])"));
    EXPECT_EQ(tags_json(search(tables.files, {"20000"}, false))["tags"][0]["demand_data"], nullptr);
}

TEST_F(TagLookup, SaysWhatIsWrongWithATable)
{
    std::ofstream{folder.path() / "bad.csv"} << "tag,name,type\nx,Odd,INT\n";

    const TagFiles bad = load_table(folder.path() / "bad.csv");

    EXPECT_TRUE(bad.files.empty());
    ASSERT_EQ(bad.faults.size(), 1u);
    EXPECT_THAT(bad.faults[0], HasSubstr("bad.csv:2:1: "));
}

// ---------------------------------------------------------------- what is shipped

const std::filesystem::path kProfiles = test::source_path("config/profiles");

TEST(ShippedTables, HaveTheAddressesOfTheHandbookExamples)
{
    const TagFiles shipped = load_table_of(kProfiles, "2408f");
    ASSERT_EQ(shipped.files.size(), 1u) << (shipped.faults.empty() ? "" : shipped.faults[0]);
    const auto only = [&shipped](const std::vector<std::string>& query) {
        const TagHits found = search(shipped.files, query, false);
        return found.hits.size() == 1 ? static_cast<int>(found.hits[0].tag->number) : -1;
    };

    EXPECT_EQ(only({"program", "1", "segment", "4", "type"}), 8360);         // 8328 + 4 x 8
    EXPECT_EQ(only({"program", "2", "general", "holdback", "value"}), 8465); // 8464 + 1
    EXPECT_EQ(only({"program", "4", "segment", "16", "end", "type"}), 8867); // 8736 + 16 x 8 + 3; X-22
    EXPECT_EQ(only({"270"}), 270);
    const TagHits autotune = search(shipped.files, {"autotune", "enable"}, false);
    ASSERT_EQ(autotune.hits.size(), 1u);
    EXPECT_EQ(autotune.hits[0].tag->number, 270);
    EXPECT_THAT(render_tags(autotune, false), HasSubstr("  profiles     2408f\n"));
}

TEST(ShippedTables, AreListedWithTheirProfilesAndTheDevicesThatHaveNone)
{
    const TagFiles shipped = load_tables(kProfiles);
    EXPECT_TRUE(shipped.faults.empty()) << shipped.faults[0];

    const Json listed = tables_json(shipped.files);
    const std::string picture = render_tables(shipped.files, false);

    for (const Json& table : listed["tables"])
        if (table["table"] == "2400.csv") {
            EXPECT_EQ(table["profiles"], Json::parse(R"(["2404f","2408f"])"));
        }
    std::vector<std::string> without;
    for (const Json& device : listed["without"]) without.push_back(device["profile"]);
    EXPECT_THAT(without, testing::IsSupersetOf({"584s", "590", "620"}));
    for (const std::string& profile : without) EXPECT_THAT(picture, HasSubstr("\n  " + profile + " "));
    EXPECT_THAT(
        picture,
        HasSubstr(
            "no public tag table exists. Their tags and scaling are those of the drive's product manual"));
}

TEST(ShippedTables, AFolderWithoutTablesIsAFault)
{
    const TagFiles none = load_tables("/nonexistent/profiles");

    EXPECT_TRUE(none.files.empty());
    ASSERT_EQ(none.faults.size(), 1u);
    EXPECT_EQ(none.faults[0],
              "/nonexistent/tags: No such file or directory; name the folder of profiles beside it with "
              "--profiles DIR");
}

} // namespace
} // namespace dpslave::dpctl
