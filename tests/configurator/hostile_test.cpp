// SPDX-License-Identifier: Apache-2.0
// Whatever is dropped on the page, the answer is a sentence.
#include "hostile.hpp"

#include <gmock/gmock.h>

namespace dpslave::test {
namespace {

using testing::HasSubstr;

/// Exit 1 and at least one sentence.
void expect_a_sentence(const json& reply)
{
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_GT(reply["lines"].size() + reply["messages"].size() + reply["refusals"].size(), 0U);
}

TEST(HostileFile, IsRefusedWithASentenceByEveryRequest)
{
    const std::string gsd = to_base64(content_of(kSource / "gsd/605/605_1649.GSD"));
    for (const std::string& octets : hostile_files()) {
        const std::string file = to_base64(octets);
        expect_a_sentence(ask({{"do", "check"}, {"file", file}, {"name", "x.gsd"}}));
        expect_a_sentence(ask({{"do", "show"}, {"file", file}}));
        expect_a_sentence(ask({{"do", "import"}, {"file", file}}));
        expect_a_sentence(ask({{"do", "diff"}, {"file", file}, {"other", gsd}}));
        expect_a_sentence(ask({{"do", "diff"}, {"file", gsd}, {"other", file}}));
        expect_a_sentence(ask({{"do", "read_mapping"}, {"file", file}}));
    }
}

TEST(HostileFile, Of20MegabytesIsRefused)
{
    const json reply = ask({{"do", "check"}, {"file", std::string(std::size_t{28} * 1'000'000, 'A')}});
    EXPECT_EQ(reply["exit"], 1);
    EXPECT_THAT(texts(reply, "refusals"), HasSubstr("larger than 1 MiB"));
}

TEST(HostileFile, HasItsNamesAsTextAndNoControlCharacters)
{
    const std::string file =
        "#Profibus_DP\r\nIdent_Number = 0x1649\r\n"
        "Model_Name = \"<script>\x1B[31m\xE2\x80\xAE\"\r\nModule = \"<img onerror=x>\" 0x50\r\n1\r\n"
        "EndModule\r\n";
    const json reply = ask({{"do", "import"}, {"file", to_base64(file)}, {"profile", "605"}});
    const json show = ask({{"do", "show"}, {"file", to_base64(file)}});
    EXPECT_THAT(show["device"]["model"].get<std::string>(), HasSubstr("<script>"));
    for (const json& one : {reply, show})
        for (const char c : texts(one, "lines") + texts(one, "messages") + texts(one, "refusals"))
            EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 0x20);
}

TEST(HostileRequest, IsReadToItsEndWhateverItIs)
{
    for (const json& request : hostile_requests()) {
        const json reply = ask(request);
        EXPECT_TRUE(reply["exit"] == 0 || !reply["refusals"].empty() || !reply["messages"].empty() ||
                    !reply["lines"].empty())
            << request;
    }
    EXPECT_EQ(ask_text(std::string(100'000, '['))["exit"], 2);
}

} // namespace
} // namespace dpslave::test
