// SPDX-License-Identifier: Apache-2.0
#include "dpslave/base/base64.hpp"

#include <gmock/gmock.h>

using namespace dpslave;
using testing::ElementsAre;

namespace {

TEST(Base64, HasTheValuesOfTheStandard)
{
    for (const auto& [plain, coded] :
         std::initializer_list<std::pair<const char*, const char*>>{{"", ""},
                                                                    {"f", "Zg=="},
                                                                    {"fo", "Zm8="},
                                                                    {"foo", "Zm9v"},
                                                                    {"foob", "Zm9vYg=="},
                                                                    {"fooba", "Zm9vYmE="},
                                                                    {"foobar", "Zm9vYmFy"}}) {
        EXPECT_EQ(to_base64(bytes_of(plain)), coded);
        const auto back = from_base64(coded);
        ASSERT_TRUE(back);
        EXPECT_EQ(std::string(back->begin(), back->end()), plain);
    }
}

TEST(Base64, EveryOctetComesBack)
{
    std::vector<std::uint8_t> all;
    for (int i = 0; i < 256; ++i) all.push_back(static_cast<std::uint8_t>(255 - i));

    EXPECT_EQ(from_base64(to_base64(all)), all);
    EXPECT_THAT(*from_base64("+/8="), ElementsAre(0xFB, 0xFF));
}

TEST(Base64, RefusesWhatIsNone)
{
    for (const char* const text : {"Z", "Zg", "Zg=", "Zm9v\n", "Zm=v", "====", "Zm9-", "Z\0AA"})
        EXPECT_FALSE(from_base64(text)) << text;
}

} // namespace
