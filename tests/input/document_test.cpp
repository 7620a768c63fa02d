// SPDX-License-Identifier: Apache-2.0
#include "profile/files.hpp"

#include "dpslave/input/document.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/io/file.hpp"

#include <gmock/gmock.h>

namespace dpslave {
namespace {

using input::Document;
using input::Table;
using test::Folder;
using test::short_forms;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

class TomlDocument : public testing::Test {
protected:
    Document& read(std::string_view content)
    {
        document_.emplace(io::read_regular_file, folder_.write("d.toml", content).string());
        return *document_;
    }

    Folder folder_;
    std::optional<Document> document_;
};

TEST_F(TomlDocument, gives_what_was_asked_for_and_is_content)
{
    Document& document =
        read("text = \"a\"\nnumber = 0x10\nreal = 1\nyes = true\nlist = [1, 2]\n[sub]\nmode = \"b\"\n");
    Table root = document.root();

    EXPECT_EQ(root.text("text"), "a");
    EXPECT_EQ(root.integer("number", 0, 16), 16);
    EXPECT_EQ(root.real("real", 0, 1), 1.0);
    EXPECT_EQ(root.boolean("yes"), true);
    EXPECT_THAT(root.integers("list", 1, 2).value(), ElementsAre(1, 2));
    EXPECT_EQ(root.table("sub").choice<int>("mode", {{"a", 1}, {"b", 2}}), 2);
    EXPECT_EQ(root.text("absent"), std::nullopt);
    EXPECT_FALSE(root.table("absent_table").exists());
    EXPECT_THAT(document.faults(), IsEmpty());
}

std::string repeated(std::string_view part, int times)
{
    std::string out;
    for (int i = 0; i < times; ++i) out += part;
    return out;
}

TEST_F(TomlDocument, that_is_nested_deeper_than_any_of_ours_is_a_fault_and_is_not_walked_down)
{
    constexpr int kDeep = 200'000;
    for (const std::string& content :
         {"a = 1\n" + repeated("a.", kDeep) + "a=1\n", "a = 1\nb=" + repeated("[", kDeep),
          "a = 1\nb=" + repeated("{a=", kDeep), "a = 1\n[" + repeated("a . ", kDeep) + "a]\n",
          "a = 1\n" + repeated("\"a\".", kDeep) + "a=1\n", "a = 1\nb = [\"\\\"\", " + repeated("[", kDeep)}) {
        Document& document = read(content);
        EXPECT_FALSE(document.readable());
        EXPECT_THAT(short_forms(document.faults()),
                    ElementsAre(AllOf(StartsWith("2:"), HasSubstr("nested deeper"))));
    }
}

TEST_F(TomlDocument, with_a_bracket_that_no_name_follows_is_a_fault)
{
    for (const char* content : {"[ =1]\n", "a = 1\n[\t.x]\n", "[[ [a]]\n", "[ \n", "  [#a]\n", "[+a]\n"}) {
        Document& document = read(content);
        EXPECT_FALSE(document.readable());
        EXPECT_THAT(short_forms(document.faults()),
                    ElementsAre(HasSubstr("the name of a table has to follow this bracket")))
            << content;
    }
}

TEST_F(TomlDocument, with_a_control_character_is_a_fault_at_its_place)
{
    using namespace std::string_view_literals;
    for (const auto content : {"a = 1\n# \0\n"sv, "a = 1\nb\x01 = 2\n"sv, "a = 1\n\"\x7F\" = 2\n"sv}) {
        Document& document = read(content);
        EXPECT_FALSE(document.readable());
        EXPECT_THAT(short_forms(document.faults()),
                    ElementsAre(AllOf(StartsWith("2:"), HasSubstr("control character"))));
    }
}

TEST_F(TomlDocument, takes_blanks_around_the_name_of_a_table)
{
    Document& document = read("[ a ]\n[\t\"b c\" . d]\n[[ e ]]\nf = [\n  [ +1, -1 ],\n]\n");

    EXPECT_TRUE(document.readable());
    EXPECT_THAT(document.root().keys(), testing::UnorderedElementsAre("a", "b c", "e"));
}

TEST_F(TomlDocument, with_dots_and_brackets_in_texts_and_comments_is_not_nested)
{
    const std::string dots = repeated("a.[{", 100);
    Document& document = read("a = \"" + dots + "\" # " + dots + "\nb = '" + dots + "'\nc = \"\"\"\n" + dots +
                              "\n\"\"\"\n" + repeated("# x.y.z\n", 100));
    Table root = document.root();
    root.has("a");
    root.has("b");
    root.has("c");

    EXPECT_TRUE(document.readable());
    EXPECT_THAT(document.faults(), IsEmpty());
}

TEST_F(TomlDocument, with_thousands_of_faults_reports_the_first_ones_and_that_there_are_more)
{
    std::string content;
    for (int i = 0; i < 12'000; ++i) content += "wrong" + std::to_string(i) + " = 1\n";
    Document& document = read(content);
    document.root().text("port");

    const auto faults = document.faults();
    ASSERT_EQ(faults.size(), input::kMaxFaults + 1);
    EXPECT_THAT(faults.back().what, HasSubstr("more faults"));
}

TEST_F(TomlDocument, of_iso_8859_1_or_utf_8_says_what_its_author_wrote)
{
    for (const char* const content : {"name = \"Z\xFCrich\"\n", "name = \"Z\u00FCrich\"\n"}) {
        Document& document = read(content);

        EXPECT_EQ(document.root().text("name"), "Z\u00FCrich");
        EXPECT_THAT(document.faults(), IsEmpty());
    }
}

TEST_F(TomlDocument, of_iso_8859_1_cannot_bring_a_control_character_to_a_terminal)
{
    Document& document = read("name = \"\x9B"
                              "2J\"\n");

    EXPECT_EQ(document.root().text("name"), std::nullopt);
    ASSERT_EQ(document.faults().size(), 1u);
    EXPECT_THAT(document.faults()[0].what, HasSubstr("control character"));
}

TEST_F(TomlDocument, faults_show_foreign_text_without_what_a_terminal_executes)
{
    Document& document = read("\"\\u001b[2J\\u009b\\u202e\\u000aforged\" = 1\nname = \"Z\u00FCrich\"\n");
    document.root().integer("name", 0, 1);
    std::string all;
    for (const auto& fault : document.faults()) all += to_string(fault);

    EXPECT_THAT(all, AllOf(HasSubstr("\\x1B[2J\\x9B\\u202E\\x0Aforged"), HasSubstr("Z\u00FCrich")));
    EXPECT_EQ(all.find('\x1b'), std::string::npos);
    EXPECT_EQ(all.find('\n'), std::string::npos);
}

TEST_F(TomlDocument, a_fault_with_a_value_of_a_whole_file_is_a_sentence_that_can_be_read)
{
    Document& document = read("name = \"" + std::string(900'000, 'x') + "\"\n");
    document.root().choice<int>("name", {{"a", 1}});

    EXPECT_LT(to_string(document.faults().at(0)).size(), 1200u);
}

TEST_F(TomlDocument, an_unknown_key_is_a_fault_that_names_the_nearest)
{
    Document& document = read("[bus]\nprot = \"x\"\nzzzzzzzz = 1\n");
    Table root = document.root();
    Table bus = root.table("bus");
    bus.text("port");
    bus.text("baud");

    EXPECT_THAT(
        short_forms(document.faults()),
        ElementsAre(
            AllOf(StartsWith("2:1: unknown key 'prot' in [bus]"), HasSubstr("did you mean 'port'?")),
            AllOf(StartsWith("3:1: unknown key 'zzzzzzzz'"), HasSubstr("known here are port, baud"))));
}

TEST_F(TomlDocument, an_unknown_table_is_one_fault_and_its_keys_are_none)
{
    Document& document = read("[busses]\na = 1\nb = 2\n");
    document.root().table("bus");

    EXPECT_THAT(short_forms(document.faults()),
                ElementsAre(HasSubstr("unknown key 'busses' at the top of the file")));
}

TEST_F(TomlDocument, a_value_of_another_type_is_a_fault_that_says_what_is_wanted)
{
    Document& document = read(
        "a = 1\nb = \"1\"\nc = 1.5\nd = [\"x\", 3]\ne = 1979-05-27\nf = \"\"\ng = \"a\\u0007\"\nh = nan\n");
    Table root = document.root();
    root.text("a");
    root.integer("b", 0, 9);
    root.boolean("c");
    root.texts("d");
    root.table("e");
    root.text("f");
    root.text("g");
    root.real("h", 0, 1);

    EXPECT_THAT(short_forms(document.faults()),
                ElementsAre("1:5: 'a' must be a text in quotes, not 1.",
                            "2:5: 'b' must be a whole number from 0 to 9, not \"1\".",
                            "3:5: 'c' must be true or false, not 1.5.",
                            "4:11: 'd' must be a list of texts in quotes, not 3.",
                            AllOf(StartsWith("5:5: "), HasSubstr("not a date")),
                            AllOf(StartsWith("6:5: "), HasSubstr("is empty")),
                            AllOf(StartsWith("7:5: "), HasSubstr("control character")),
                            AllOf(StartsWith("8:5: "), HasSubstr("a number from 0 to 1"))));
}

TEST_F(TomlDocument, one_of_a_closed_set_names_the_set_and_the_nearest)
{
    Document& document = read("a = \"hodl\"\n");
    document.root().choice<int>("a", {{"zero", 0}, {"hold", 1}});

    EXPECT_THAT(short_forms(document.faults()),
                ElementsAre("1:5: 'a' must be \"zero\" or \"hold\", not \"hodl\". Did you mean \"hold\"?"));
}

TEST_F(TomlDocument, tables_with_single_brackets_where_double_ones_are_wanted_are_a_fault)
{
    Document& document = read("[line]\nname = \"a\"\n");
    EXPECT_THAT(document.root().tables("line"), IsEmpty());

    EXPECT_THAT(short_forms(document.faults()), ElementsAre(HasSubstr("[[line]] in double brackets")));
}

TEST_F(TomlDocument, a_missing_key_is_reported_at_its_table_with_a_line_to_add)
{
    Document& document = read("x = 1\n\n[[line]]\nname = \"a\"\n");
    Table root = document.root();
    root.integer("x", 0, 1);
    auto lines = root.tables("line");
    ASSERT_EQ(lines.size(), 1U);
    lines[0].text("name");
    lines[0].require("port", "port = \"/dev/ttyS2\"");

    EXPECT_THAT(short_forms(document.faults()),
                ElementsAre("3:1: 'port' is missing in [[line]]: add port = \"/dev/ttyS2\"."));
}

TEST_F(TomlDocument, what_is_no_toml_is_one_fault_with_its_place)
{
    Document& document = read("[bus]\nport = /dev/ttyS1\n");

    EXPECT_FALSE(document.readable());
    EXPECT_THAT(short_forms(document.faults()),
                ElementsAre(AllOf(StartsWith("2:8: "), HasSubstr("not TOML"))));
}

TEST_F(TomlDocument, a_key_that_stands_twice_is_a_fault)
{
    EXPECT_THAT(short_forms(read("a = 1\na = 2\n").faults()),
                ElementsAre(AllOf(StartsWith("2:"), HasSubstr("cannot redefine"))));
}

TEST(Nearest, is_the_word_that_was_probably_meant_and_none_where_too_much_differs)
{
    const std::vector<std::string> legal{"port", "baud", "direction", "gpio_active_low"};

    EXPECT_EQ(input::nearest("prot", legal), "port");
    EXPECT_EQ(input::nearest("gpio_activ_low", legal), "gpio_active_low");
    EXPECT_EQ(input::nearest("quux", legal), "");
    EXPECT_EQ(input::nearest("x", legal), "");
    EXPECT_EQ(input::listed(std::vector<std::string>{"a", "b", "c"}), "\"a\", \"b\" or \"c\"");
}

TEST_F(TomlDocument, with_a_character_beyond_ascii_outside_of_texts_and_comments_names_its_place)
{
    for (const std::string character : {"é", "\u2C60", "\uFC30", "\u00A0", "\u3000"}) {
        for (const char* const around :
             {"# x\n  @ = 1\n", "# x\na @= 1\n", "# x\na=b'@'\n", "# x\n[t@]\n", "# x\na = 'b'@\n",
              "# x\na = 1\"@\"\n", "# x\na = 1.'@'\n", "# x\na = 0='@'\n", "# x\na = -{'@'}\n",
              "# x\na = +['@']\n", "# x\na = [[1], 2.'@']\n", "# x\na = {b = 1.'@'}\n",
              "# x\na = 1979-05-27T00:00:00.'@'\n", "# x\na = 1979-05-27 T07.'@'\n"}) {
            std::string content = around;
            content.replace(content.find('@'), 1, character);
            const auto faults = read(content).faults();
            ASSERT_EQ(faults.size(), 1U) << content;
            EXPECT_EQ(faults.front().line, 2U) << content;
            EXPECT_THAT(faults.front().what, HasSubstr("only texts in quotes and comments")) << content;
        }
    }
}

TEST_F(TomlDocument, may_have_any_character_in_texts_and_comments)
{
    Document& document =
        read("\xEF\xBB\xBF# \u2C60\n\"é\" = 'é'\nb = [\"é\",'é']\nc = \"\"\"é\\\\é\"\"\" # é\n");
    EXPECT_EQ(document.root().text("é"), "é");
    EXPECT_EQ(document.root().text("c"), "é\\é");
    document.root().texts("b");
    EXPECT_THAT(document.faults(), IsEmpty());
}

TEST_F(TomlDocument, may_have_any_character_in_the_quotes_of_each_part_of_a_key)
{
    Document& document =
        read("1.'é' = 'a'\nb = {c=1,2.\"é\"='d'}\ne = [1, # é\n'é']\n['f'.'é'.\"é\"]\n[[g.'é']]\n");
    EXPECT_TRUE(document.readable());
    EXPECT_EQ(document.root().table("1").text("é"), "a");
    EXPECT_EQ(document.root().table("b").table("2").text("é"), "d");
    EXPECT_TRUE(document.root().table("f").table("é").has("é"));
    EXPECT_TRUE(document.root().table("g").has("é"));
}

TEST_F(TomlDocument, with_a_bracket_or_a_brace_that_closes_something_else_names_its_place)
{
    for (const std::string content :
         {"a = [}\n", "a = [[1]}\n", "a = {b=[1,}\n", "a = {b=1]\n", "a = 1]\n", "]\n", "}\n"}) {
        const auto faults = read(content).faults();
        ASSERT_EQ(faults.size(), 1U) << content;
        EXPECT_EQ(faults.front().column, content.size() - 1) << content;
        EXPECT_THAT(faults.front().what, HasSubstr("nothing of this kind is open here")) << content;
    }
}

TEST_F(TomlDocument, with_two_numbers_for_one_value_names_the_second)
{
    for (const std::string content :
         {"a = 1 2", "a = 1979-05-27 1,1", "a = [1979-05-27 0", "a = {b = 0x1 1"}) {
        const auto faults = read(content).faults();
        ASSERT_EQ(faults.size(), 1U) << content;
        EXPECT_EQ(faults.front().column, content.rfind(' ') + 2) << content;
        EXPECT_THAT(faults.front().what, HasSubstr("a second number follows")) << content;
    }
    EXPECT_THAT(short_forms(read("a = 1 # 2\nb = [1 , 2\n , 3 ] # 4\n").faults()),
                Each(HasSubstr("this key is not known")));
}

TEST_F(TomlDocument, whose_text_goes_on_beyond_ascii_after_a_backslash_names_the_backslash)
{
    for (const std::string after : {"\n  é", "é", " \r\n\u2C60"}) {
        const auto faults = read("a = \"\"\"b\\" + after + "\"\"\"\n").faults();
        ASSERT_EQ(faults.size(), 1U) << after;
        EXPECT_THAT(faults.front().what, HasSubstr("on one line")) << after;
    }
}

/// With the sanitizers the assertions of toml++ are judges, too.
TEST(Toml, of_any_three_tokens_behind_any_begin_is_read_or_has_a_fault_within_the_text)
{
    const std::vector<std::string> begins{
        "", "a = ", "a = [", "a = {b=", "[a.", "a = 1979-05-27 ", "a = \"\"\"", "a = '''"};
    const std::vector<std::string> tokens{"1", ".", "'", "\"", "=",    "[",  "{", ",", "]",
                                          "}", "#", " ", "\n", "\r\n", "\\", "é", "-", "t"};
    for (const std::string& begin : begins)
        for (const std::string& first : tokens)
            for (const std::string& second : tokens)
                for (const std::string& third : tokens) {
                    const std::string content = begin + first + second + third;
                    const Document document{
                        [&](const std::string&) -> Result<std::string, Unreadable> { return content; },
                        "d.toml"};
                    const auto faults = document.faults();
                    ASSERT_EQ(document.readable(), faults.empty()) << content;
                    for (const auto& fault : faults) ASSERT_LE(fault.line, 4U) << content;
                }
}

} // namespace
} // namespace dpslave
