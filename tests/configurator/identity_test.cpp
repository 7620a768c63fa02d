// SPDX-License-Identifier: Apache-2.0
// make, import, make: the same octets, whatever the mapping.
#include "page.hpp"

#include <gmock/gmock.h>

#include <random>

namespace dpslave::test {
namespace {

using Random = std::mt19937;

std::uint32_t below(Random& random, std::uint32_t end)
{
    return static_cast<std::uint32_t>(random() % end);
}

/// Letters of ISO 8859-1 and some that are none, quotes and comment marks.
std::string some_text(Random& random, std::uint32_t longest)
{
    static const std::vector<std::string> kPieces{
        "a",        "Z", "7", " ", "\"",           ";",       "\\", "\xC3\xBC",
        "\xC3\x83", "=", "#", "'", "\xE2\x84\xA6", "\xC2\xBC"};
    std::string text = "T";
    for (std::uint32_t i = below(random, longest); i > 0; --i)
        text += kPieces[below(random, static_cast<std::uint32_t>(kPieces.size()))];
    return text;
}

json some_mapping(Random& random, const json& profile)
{
    json mapping{{"profile", profile["name"]}, {"list", json::array()}};
    const auto most = std::min<std::uint32_t>(profile["max_parameters"].get<std::uint32_t>(),
                                              below(random, 3) == 0 ? 200 : 12);
    std::set<std::string> used;
    for (std::uint32_t i = below(random, most + 1); i > 0; --i) {
        const json& lists = profile["lists"];
        const std::string direction = lists[below(random, static_cast<std::uint32_t>(lists.size()))];
        const std::string tag = std::to_string(
            1 + below(random, std::min<std::uint32_t>(profile["max_tag"].get<std::uint32_t>(), 900)));
        if (used.insert(tag).second) mapping["list"].push_back(direction + ':' + tag);
    }
    if (below(random, 2) == 0) mapping["demand"] = true;
    if (profile["ident"].is_null() || below(random, 3) == 0) mapping["ident"] = 1 + below(random, 0xFFFF);
    if (below(random, 3) == 0) mapping["max_tsdr"] = 11 + below(random, 1500);
    if (below(random, 3) == 0) mapping["description"] = some_text(random, 30);
    if (below(random, 3) == 0) mapping["model"] = some_text(random, 20);
    return mapping;
}

TEST(MakeImportMake, IsTheIdentityOverAllProfiles)
{
    int made = 0;
    const json known = ask({{"do", "profiles"}});
    for (const json& profile : known["profiles"]) {
        Random random{4711};
        for (int i = 0; i < 12; ++i) {
            const json mapping = some_mapping(random, profile);
            const json first = ask({{"do", "make"}, {"mapping", mapping}});
            if (first["exit"] != 0) continue; // MaxTsdr without effect
            ++made;
            const json imported =
                ask({{"do", "import"}, {"file", first["octets"]}, {"profile", profile["name"]}});
            ASSERT_EQ(imported["exit"], 0) << mapping << texts(imported, "refusals");
            EXPECT_THAT(imported["lost"], testing::IsEmpty()) << mapping << texts(imported, "messages");
            const json again = ask({{"do", "make"}, {"mapping", imported["mapping"]}});
            ASSERT_EQ(from_base64(again.value("octets", "")), from_base64(first["octets"])) << mapping;

            const json kept = ask({{"do", "read_mapping"}, {"file", imported["octets"]}});
            ASSERT_EQ(kept["mapping"], imported["mapping"]) << "the mapping file holds all of it";

            const SecondHand file = second_hand(from_base64(first["octets"]));
            EXPECT_EQ(first["chk_cfg"], json(file.cfg())) << mapping;
        }
    }
    EXPECT_GT(made, 80);
}

} // namespace
} // namespace dpslave::test
