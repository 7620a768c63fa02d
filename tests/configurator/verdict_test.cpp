// SPDX-License-Identifier: Apache-2.0
/// The verdict of a mapping, and that of the file that was saved of it.
#include "page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dpslave::test {
namespace {

using testing::HasSubstr;

/// Severity and sentence of each finding.
std::vector<std::string> verdict_of(const json& reply)
{
    std::vector<std::string> all;
    for (const json& one : reply["findings"])
        all.push_back(one["severity"].get<std::string>() + ": " + one["text"].get<std::string>());
    return all;
}

json of_code(const json& reply, const std::string& code)
{
    for (const json& one : reply["findings"])
        if (one["code"] == code) return one;
    return {};
}

TEST(Verdict, OfAMappingIsThatOfTheSavedFileWhateverItsNameIs)
{
    const std::vector<json> mappings{
        {{"profile", "2408f"}, {"ident", 0x1652}},
        {{"profile", "605"}, {"ident", 0x1652}, {"list", {"in:1", "out:2"}}, {"max_tsdr", 2000}},
        {{"profile", "590"}, {"demand", true}, {"list", {"in:1"}}},
        {{"profile", "690plus"},
         {"ident", 1},
         {"list",
          {"in:271", "in:300", "in:301", "in:302", "in:303", "in:304", "in:305", "in:306", "in:307", "in:308",
           "in:309", "in:310", "in:311", "in:312", "in:313", "in:314", "in:315", "in:316"}}},
    };
    std::size_t said = 0;
    for (const json& mapping : mappings)
        for (const char* name : {"MINE.GSD", "EURO1652.GSD", "lower.gsd", "MINE.TXT"}) {
            const json made = ask({{"do", "make"}, {"mapping", mapping}, {"name", name}});
            ASSERT_EQ(made["exit"], 0) << made;
            const json preview = ask({{"do", "preview"}, {"mapping", mapping}, {"name", name}});
            const json checked =
                ask({{"do", "check"}, {"file", made["octets"]}, {"name", name}, {"mapping", mapping}});

            EXPECT_EQ(verdict_of(checked), verdict_of(preview)) << mapping << name;
            EXPECT_EQ(checked["lines"].size(), preview["findings"].size() + 2);
            said += preview["findings"].size();
        }
    EXPECT_GT(said, 16U);
}

TEST(Verdict, NamesTheFieldThatMendsEachFinding)
{
    const json name = ask({{"do", "preview"},
                           {"mapping", {{"profile", "2408f"}, {"ident", 0x1652}}},
                           {"name", "EURO2400.GSD"}});
    EXPECT_EQ(of_code(name, "file_name")["field"], "name");
    const json mapping{{"profile", "2408f"},
                       {"max_tsdr", 11},
                       {"model", std::string(40, 'M')},
                       {"description", std::string(300, 'D')},
                       {"list", {"in:1", "in:1"}}};
    const json reply = ask({{"do", "preview"}, {"mapping", mapping}});

    EXPECT_EQ(of_code(reply, "ident_missing")["field"], "ident");
    EXPECT_EQ(of_code(reply, "max_tsdr_no_effect")["field"], "max_tsdr");
    EXPECT_EQ(of_code(reply, "read_twice")["field"], "list");
    EXPECT_EQ(of_code(reply, "text_too_long")["field"], "model");
    EXPECT_EQ(reply["findings"][1]["field"], "description");
}

TEST(Verdict, OfARefusedMappingNamesTheWrongKey)
{
    const json reply = ask({{"do", "preview"}, {"mapping", {{"profile", "2408f"}, {"model", "a\tb"}}}});

    EXPECT_EQ(reply["exit"], 2);
    EXPECT_EQ(reply["field"], "model");
}

TEST(Verdict, OfAFileOfAnotherDeviceIsTheRefusalOfTheSlave)
{
    const std::string file = made_file({{"profile", "605"}, {"list", {"in-out:1"}}});
    const json other =
        ask({{"do", "check"}, {"file", to_base64(file)}, {"name", "A.GSD"}, {"profile", "590"}});

    EXPECT_EQ(other["exit"], 1);
    EXPECT_EQ(other["verdict"]["refusal"]["code"], "prm_ident");
    EXPECT_THAT(verdict_of(other),
                testing::Contains(HasSubstr("Or write the ident of the file into the station.")));
}

TEST(Verdict, OfAFileThatWasMadeHereKnowsItsProfile)
{
    for (const char* profile : {"2404f", "2408f", "584s", "590", "605"}) {
        const std::string file = made_file({{"profile", profile}, {"ident", 0x1652}, {"list", {"in:1"}}});
        const json reply = ask({{"do", "import"}, {"file", to_base64(file)}});

        EXPECT_EQ(reply["mapping"]["profile"], profile) << texts(reply, "refusals");
    }
}

} // namespace
} // namespace dpslave::test
