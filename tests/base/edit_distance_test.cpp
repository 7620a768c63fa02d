// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/edit_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace {

using dpslave::edit_distance;

/// By the definition, without a table: what is left of both words after each first edit.
std::size_t by_definition(std::string_view a, std::string_view b)
{
    if (a.empty() || b.empty()) return a.size() + b.size();
    const std::size_t kept = by_definition(a.substr(1), b.substr(1)) + (a[0] == b[0] ? 0 : 1);
    return std::min({kept, by_definition(a.substr(1), b) + 1, by_definition(a, b.substr(1)) + 1});
}

TEST(EditDistance, CountsWhatIsToBeAddedRemovedOrChanged)
{
    EXPECT_EQ(edit_distance("Vendor_Name", "Vendor_Name", 9), 0u);
    EXPECT_EQ(edit_distance("Vendr_Name", "Vendor_Name", 9), 1u);
    EXPECT_EQ(edit_distance("Vendor_Names", "Vendor_Name", 9), 1u);
    EXPECT_EQ(edit_distance("Vender_Nome", "Vendor_Name", 9), 2u);
    EXPECT_EQ(edit_distance("", "abc", 9), 3u);
}

TEST(EditDistance, IsOneMoreThanTheLimitForWordsThatDifferByMore)
{
    EXPECT_EQ(edit_distance("Revision", "OrderNumber", 2), 3u);
    EXPECT_EQ(edit_distance("a", "abcdefgh", 2), 3u);
    EXPECT_EQ(edit_distance("abc", "xyz", 2), 3u);
    EXPECT_EQ(edit_distance("abc", "abd", 0), 1u);
}

TEST(EditDistance, IsThatOfTheDefinitionForRandomWordsAndLimits)
{
    std::mt19937 random{1};
    const auto word = [&random] {
        std::string letters;
        for (auto left = random() % 7; left > 0; --left) letters += static_cast<char>('a' + random() % 3);
        return letters;
    };
    for (int i = 0; i < 2000; ++i) {
        const std::string a = word(), b = word();
        const std::size_t most = random() % 7;
        EXPECT_EQ(edit_distance(a, b, most), std::min(by_definition(a, b), most + 1))
            << a << " and " << b << " with " << most;
    }
}

} // namespace
