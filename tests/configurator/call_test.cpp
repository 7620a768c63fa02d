// SPDX-License-Identifier: Apache-2.0
/// The page's requests, asked as the page asks them.
#include "dpslave/configurator/configurator.hpp"
#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace dpslave::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// The files of this tree under the names that the page has.
Result<std::string, Unreadable> shipped(const std::string& name)
{
    const std::string root = DPSLAVE_SOURCE_DIR;
    if (name == "index.txt") {
        std::string index = "mappings/gain-scheduling.toml\n";
        for (const std::string& profile : io::names_in(root + "/config/profiles", ".toml"))
            index += "profiles/" + profile + ".toml\n";
        return index;
    }
    return io::read_regular_file(root + (name.starts_with("mappings/") ? "/gsd/" : "/config/") + name);
}

json ask(const std::string& request)
{
    return json::parse(configurator::call(request, shipped));
}

TEST(ConfiguratorCall, RefusesWhatIsNoRequestWithASentence)
{
    for (const char* request : {"", "\xFF\xFE", "[]", "17", R"({"do": 3})", R"({"do": "dance"})",
                                R"({"do": "check"})", R"({"do": "check", "file": "!"})"}) {
        const json reply = ask(request);
        EXPECT_EQ(reply["exit"], 2) << request;
        EXPECT_EQ(reply["refusals"].size(), 1U) << request;
    }
}

TEST(ConfiguratorCall, ListsTheProfilesWithTheirLimits)
{
    const json reply = ask(R"({"do": "profiles"})");

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
    const json reply = ask(R"({"do": "samples"})");

    ASSERT_EQ(reply["samples"].size(), 1U);
    EXPECT_EQ(reply["samples"][0]["mapping"]["profile"], "2408f");
    EXPECT_EQ(reply["samples"][0]["mapping"]["list"],
              (json{"in:1", "out:6", "out:8", "out:9", "out:18", "out:17"}));
}

TEST(ConfiguratorCall, ChecksAFileAndNamesLineAndSeverity)
{
    const json reply = ask(R"({"do": "check", "name": "A.GSD", "file": "bm90aGluZwo="})"); // "nothing"

    EXPECT_EQ(reply["exit"], 1);
    ASSERT_FALSE(reply["findings"].empty());
    EXPECT_EQ(reply["findings"][0]["severity"], "error");
    EXPECT_THAT(reply["lines"][0].get<std::string>(),
                HasSubstr("A.GSD: error: there is no line #Profibus_DP"));
}

} // namespace
} // namespace dpslave::test
