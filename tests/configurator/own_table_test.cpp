// SPDX-License-Identifier: Apache-2.0
// A tag table of the user's own goes through make, mapping file and import: its names are not lost, or it is
// said that they are.
#include "page.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kTable = "tag,name,type,decimals,access,notes\n"
                           "7,Dancer position,INT,2,rw,\n"
                           "8,\"Torque, \"\"net\"\"\",INT,1,rw,\"C:\\new\"\n"
                           "9,\"Z\xC3\xBCge \\ \"\"\"\"#'''[x]\",INT,0,rw,\"two\nlines,\ttab\"\n";

json mapping_with(const json& list)
{
    return {{"profile", "605"}, {"list", list}, {"demand", false}};
}

json with_table(json request, const std::string& table = kTable)
{
    request["table"] = table;
    request["table_name"] = "mine.csv";
    return request;
}

json made_with_table(const json& mapping)
{
    return ask(with_table({{"do", "make"}, {"mapping", mapping}}));
}

/// Of the reply of `read_mapping`, as the page makes it.
json made_of(const json& read)
{
    return ask({{"do", "make"}, {"mapping", read["mapping"]}, {"table", read["table"]}});
}

TEST(OwnTable, StandsInTheMappingFileSoThatItMakesTheSameFileAgain)
{
    const json mapping = mapping_with({"in:7", "out:9", "in:8"});
    const json first = made_with_table(mapping);
    ASSERT_THAT(from_base64(first["octets"]), HasSubstr("; 1 in tag 7 Dancer position"));

    const json written = ask(with_table({{"do", "mapping"}, {"mapping", mapping}}));
    EXPECT_THAT(from_base64(written["octets"]), AllOf(HasSubstr("\"in:7\", # Dancer position\n"),
                                                      HasSubstr("\n[table]\nfile = \"mine.csv\"\n")));

    const json read = ask({{"do", "read_mapping"}, {"file", written["octets"]}, {"name", "m.toml"}});
    ASSERT_EQ(read["exit"], 0) << texts(read, "messages");
    EXPECT_EQ(read["mapping"], mapping);
    EXPECT_EQ(read["table"], kTable);
    EXPECT_EQ(read["table_name"], "mine.csv");
    EXPECT_EQ(made_of(read)["octets"], first["octets"]);
}

TEST(OwnTable, WithTheEndsOfLinesOfWindowsMakesTheSameFileAgain)
{
    const std::string table = "tag,name\r\n7,Dancer position\r\n8,Torque\r\n";
    const json mapping = mapping_with({"in:7", "in:8"});
    const json first = ask(with_table({{"do", "make"}, {"mapping", mapping}}, table));
    const json written = ask(with_table({{"do", "mapping"}, {"mapping", mapping}}, table));
    const json read = ask({{"do", "read_mapping"}, {"file", written["octets"]}});
    ASSERT_THAT(from_base64(first["octets"]), HasSubstr("; 2 in tag 8 Torque"));
    EXPECT_EQ(made_of(read)["octets"], first["octets"]);
}

TEST(OwnTable, OfAMappingFileIsRefusedWithItsLineWhereItCannotBeRead)
{
    const auto faults = [](const std::string& table) {
        const json reply = ask({{"do", "read_mapping"},
                                {"file", to_base64("profile = \"605\"\n[table]\n" + table)},
                                {"name", "m.toml"}});
        EXPECT_EQ(reply["exit"], 1) << table;
        return texts(reply, "messages");
    };
    EXPECT_THAT(faults("file = \"a.csv\"\nrows = \"\"\"\ntag,name\nseven,OWN\n\"\"\"\n"),
                HasSubstr("m.toml [table]:2:1: tag"));
    EXPECT_THAT(faults("file = \"a.csv\"\n"), HasSubstr("'rows' is missing in [table]"));
    EXPECT_THAT(faults("file = \"a.csv\"\nrows = 7\n"), HasSubstr("'rows' must be a text of lines"));
    EXPECT_THAT(faults("rows = \"tag\"\n"), HasSubstr("'file' is missing in [table]"));
}

TEST(OwnTable, TooLargeForAFileThatCanBeReadAgainIsRefusedWithASentence)
{
    std::string table = "tag,name,notes\n";
    for (int tag = 1; table.size() < 1024 * 1024 - 1000; ++tag)
        table += std::to_string(tag) + ",," + std::string(600, 'n') + '\n';
    const json request{{"do", "mapping"}, {"mapping", mapping_with(json::array())}};
    EXPECT_EQ(ask(with_table(request, table))["exit"], 0) << "there is room for it";
    table += "60000,," + std::string(1000, 'n') + '\n';
    const json refused = ask(with_table(request, table));
    EXPECT_EQ(refused["exit"], 1);
    EXPECT_FALSE(refused.contains("octets"));
    EXPECT_THAT(texts(refused, "refusals"), HasSubstr("larger than 1 MiB"));
}

TEST(OwnTable, GivenWithAnImportGoesIntoTheMapping)
{
    const json first = made_with_table(mapping_with({"out:9", "in:7", "in-out:8"}));
    const json imported = ask(with_table({{"do", "import"}, {"file", first["octets"]}, {"profile", "605"}}));
    ASSERT_EQ(imported["exit"], 0) << texts(imported, "refusals");
    EXPECT_THAT(imported["lost"], IsEmpty()) << texts(imported, "messages");
    EXPECT_EQ(imported["table"], kTable);

    const json read = ask({{"do", "read_mapping"}, {"file", imported["octets"]}});
    EXPECT_EQ(made_of(read)["octets"], first["octets"]);
}

TEST(OwnTable, NotGivenWithAnImportHasItsNamesNamedAsLost)
{
    const json first = made_with_table(mapping_with({"in:7", "out:9", "out:7"}));
    const json imported = ask({{"do", "import"}, {"file", first["octets"]}, {"profile", "605"}});
    EXPECT_EQ(imported["exit"], 0);
    ASSERT_EQ(imported["lost"].size(), 2U) << "one for each tag";
    EXPECT_EQ(imported["lost"][0]["keyword"], "name of tag 7");
    EXPECT_EQ(imported["lost"][0]["left"], "Dancer position");
    EXPECT_GT(imported["lost"][0]["line"], 0);
    EXPECT_THAT(texts(imported, "messages"), HasSubstr("name of tag 7 = Dancer position gets lost"));
}

TEST(OwnTable, WithAnotherNameForATagHasBothNamed)
{
    const json first = made_with_table(mapping_with({"in:7"}));
    const json imported = ask(
        with_table({{"do", "import"}, {"file", first["octets"]}, {"profile", "605"}}, "tag,name\n7,Speed\n"));
    EXPECT_THAT(texts(imported, "messages"), HasSubstr("name of tag 7 = Dancer position becomes Speed."));
}

TEST(Import, TakesACommentForANameOnlyWhereItIsOne)
{
    std::string file = made_file(mapping_with({"in:7"}));
    for (const char* line :
         {"; 1 in tag 7", "; 1 in tag 7 ", "; 1 in tag x y", "; in tag 7 Speed", "; 1 on tag 7 Speed",
          "; tag 7 Speed", "; 99999999999 in tag 7 Speed", "; 1 in tag 99999999999 Speed", "; 1", "; ", ";"})
        file += std::string{line} + "\r\n";
    EXPECT_THAT(ask({{"do", "import"}, {"file", to_base64(file)}, {"profile", "605"}})["lost"], IsEmpty());
}

TEST(OwnTable, GivesItsNamesToAComparison)
{
    const std::string left = made_file(mapping_with({"in:7"})), right = made_file(mapping_with({"in:8"}));
    const json reply = ask(with_table(
        {{"do", "diff"}, {"file", to_base64(left)}, {"other", to_base64(right)}, {"profile", "605"}}));
    EXPECT_THAT(texts(reply, "lines"), HasSubstr("tag 7 Dancer position -> tag 8 Torque, \"net\""));
}

TEST(OwnTable, WhoseNameIsHostileStaysOneName)
{
    for (const char* name : {"profiles/605.toml", "index.txt", "..", "a\n[x]\nb = 1", "\"\\", "\xC3\xBC/"}) {
        const json written = ask({{"do", "mapping"},
                                  {"mapping", mapping_with({"in:7"})},
                                  {"table", kTable},
                                  {"table_name", name}});
        ASSERT_EQ(written["exit"], 0) << name;
        const json read = ask({{"do", "read_mapping"}, {"file", written["octets"]}});
        ASSERT_EQ(read["exit"], 0) << name << texts(read, "messages");
        EXPECT_THAT(read["table_name"].get<std::string>(), AllOf(Not(HasSubstr("\n")), Not(HasSubstr("/"))));
        EXPECT_EQ(read["table"], kTable);
    }
}

} // namespace
} // namespace dpslave::test
