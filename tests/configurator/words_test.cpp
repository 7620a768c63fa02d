// SPDX-License-Identifier: Apache-2.0
// The page shows the sentences that dpctl prints. There is no command line on it, so no sentence names one.
#include "hostile.hpp"
#include "station.hpp"

#include <gmock/gmock.h>

#include <regex>
#include <set>

namespace dpslave::test {
namespace {

using profile::Profile;
using profile::Selection;
using testing::IsEmpty;
using testing::IsSupersetOf;

bool names_the_command_line(const std::string& sentence)
{
    return sentence.starts_with("--") || sentence.find(" --") != std::string::npos ||
           sentence.find("dpctl") != std::string::npos;
}

/// What was answered: the sentences that name the command line, and the codes of all findings.
class Answers {
public:
    ~Answers()
    {
        EXPECT_GT(count_, 0U);
        EXPECT_THAT(wrong_, IsEmpty());
    }

    void add(const json& reply)
    {
        for (const char* key : {"lines", "messages", "refusals"})
            for (const json& one : reply[key]) add_sentence(one);
        if (!reply.contains("findings")) return;
        for (const json& finding : reply["findings"]) {
            add_sentence(finding["text"]);
            if (finding.contains("code")) codes.insert(finding["code"].get<std::string>());
        }
    }

    void add(const profile::Draft& draft)
    {
        for (const profile::Note& note : draft.notes) {
            add_sentence(note.text);
            codes.emplace(note.code);
        }
    }

    std::set<std::string> codes;

private:
    void add_sentence(const std::string& sentence)
    {
        ++count_;
        const bool is_line_of_a_file = sentence.starts_with("+ ") || sentence.starts_with("- "); // of a diff
        if (!is_line_of_a_file && names_the_command_line(sentence)) wrong_.insert(sentence);
    }

    std::size_t count_ = 0;
    std::set<std::string> wrong_;
};

/// The codes that a source gives to its findings: refuse("ident_missing", ...
std::set<std::string> codes_in(const char* source)
{
    static const std::regex kCode{R"re(\b(?:refuse|warn|error)\(\s*"([a-z_]+)")re"};
    const std::string text = content_of(kSource / source);
    std::set<std::string> codes;
    for (std::sregex_iterator at{text.begin(), text.end(), kCode}, end; at != end; ++at)
        codes.insert((*at)[1]);
    EXPECT_GT(codes.size(), 3U) << source;
    return codes;
}

TEST(Words, NameNoOptionWhateverTheFileIs)
{
    std::vector<std::string> files = hostile_files();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kSource / "gsd"))
        if (entry.path().extension() == ".GSD") files.push_back(content_of(entry.path()));
    files.emplace_back("#Profibus_DP\nModel_Name = \"T630\"\n");
    ASSERT_GT(files.size(), 10U);
    const std::string other = to_base64(files.back());
    Answers answers;
    for (const std::string& octets : files) {
        const std::string file = to_base64(octets);
        answers.add(ask({{"do", "check"}, {"file", file}, {"name", "x.gsd"}, {"strict", true}}));
        answers.add(ask({{"do", "read_mapping"}, {"file", file}}));
        for (const char* profile : {"", "590", "605", "2408f"})
            for (const char* wanted : {"show", "import", "diff"})
                answers.add(ask({{"do", wanted}, {"file", file}, {"other", other}, {"profile", profile}}));
    }
}

TEST(Words, NameNoOptionWhateverTheRequestIs)
{
    Answers answers;
    for (const json& request : hostile_requests()) answers.add(ask(request));
    for (const char* request : {"", "[]", R"({"do": "dance"})", R"({"do": "check"})"})
        answers.add(ask_text(request));
}

TEST(Words, NameNoOptionWhereTheProfileOrTheTableIsWrong)
{
    const std::string file = to_base64(content_of(kSource / "gsd/590/590_0533.GSD"));
    Answers answers;
    for (const char* profile : {"", "591", "profiles/590", "../590"})
        for (const char* wanted : {"tags", "make", "preview", "show", "import", "diff", "mapping"})
            answers.add(ask({{"do", wanted},
                             {"file", file},
                             {"other", file},
                             {"profile", profile},
                             {"mapping", {{"profile", profile}}}}));
    for (const char* wanted : {"tags", "make", "show", "import", "diff", "mapping"})
        answers.add(ask({{"do", wanted},
                         {"file", file},
                         {"other", file},
                         {"profile", "590"},
                         {"mapping", {{"profile", "590"}}},
                         {"table", "rubbish"}}));
    const input::TextSource nothing = [](const std::string&) -> Result<std::string, Unreadable> {
        return Failure{Unreadable{"it is not there"}};
    };
    answers.add(json::parse(configurator::reply_of(
        configurator::make({nothing, "profiles", {"590"}}, {"620", {}}, "mine.csv", ""))));
}

std::vector<std::uint16_t> tags(std::uint16_t first, std::size_t count)
{
    std::vector<std::uint16_t> all(count);
    for (std::uint16_t& tag : all) tag = first++;
    return all;
}

/// One selection at least for each code.
std::vector<std::pair<Profile, Selection>> refused_selections()
{
    Profile no_mapping = load("590"), no_tags = load("590"), closed = load("590"), bare = load("590");
    no_mapping.personality.prm.list = dp::TagList::exact;
    no_tags.personality.prm.list = dp::TagList::none;
    closed.tags_only_from_table = true;
    bare.personality.demand_identifier = 0;
    bare.personality.may_have_no_parameters = false;
    Profile with_text = load("590");
    const auto table = profile::read_tags("tag,name,type\n7,Label,STRING\n", "mine.csv");
    EXPECT_TRUE(table);
    if (table) with_text.tags = *table;
    const Profile controller = load("2408f");
    return {{load("590"), {.model = std::string(33, 'm')}},
            {load("590"), {.description = "5 \xE2\x84\xA6"}},
            {controller, {}},
            {load("590"), {.ident = 0}},
            {load("590"), {.ident = 0x1234}},
            {load("590"), {.max_tsdr = 70'000}},
            {load("590"), {.max_tsdr = 11}},
            {no_mapping, {}},
            {no_tags, {.in = {1}}},
            {closed, {.in = {2047}}},
            {bare, {.demand = true}},
            {load("590"), {.in_out = {5}}},
            {load("590"), {.in = {0, 5, 5, 2048}, .out = {6, 6}}},
            {load("590"), {.in = tags(1, 13)}},
            {load("605"), {.in = tags(1, 130)}},
            {with_text, {.in = {7}}},
            {load("590"), {.in = {1}, .tags = std::vector<std::uint16_t>{2}}},
            {load("590"),
             {.list = std::vector<profile::GsdParameter>{{profile::Direction::in, 1}},
              .modules = {{.name = "a", .identifiers = {0x50}, .preset = true},
                          {.name = "b", .identifiers = {0x60}}}}},
            {controller, {.in = {1}, .ident = 1, .identifiers = {*profile::read_identifier("52")}}},
            {controller, {.out = {5, 199}}},
            {controller, {.in = tags(500, 60), .out = tags(20, 58), .demand = true}}};
}

TEST(Words, NameNoOptionForAnyFindingOfAMapping)
{
    Answers answers;
    for (const auto& [profile, selection] : refused_selections()) {
        answers.add(draft_of(profile, selection));
        const configurator::Files files{shipped, "profiles", {}};
        answers.add(
            json::parse(configurator::reply_of(make(files, {profile.name, selection}, "", "a name"))));
    }
    EXPECT_THAT(answers.codes, IsSupersetOf(codes_in("src/profile/gsd_device.cpp")));
}

TEST(Words, NameNoOptionForAnyFindingOfARunningStation)
{
    configurator::RunningStation station = unwinder();
    station.keys.ident = 0x1234;
    station.usual_reply = 61;
    station.rates[3].second = 120;
    station.rates.pop_back();
    station.last_prm = "88 01 0A 0B 05 33 00 00 3A 00 39";
    station.last_cfg = "60 50";
    const std::string file = file_of({"out:55", "in:57", "in:99"});
    Answers answers;
    answers.add(judge(file, station, "mine.csv"));
    answers.add(judge(with(file, "187.5_supp", "3M_supp"), station, "mine.csv"));
    answers.add(judge(file_of({"in-out:9"}, "605"), station));
    station.keys.ident = 0x0533;
    answers.add(judge(file, station, "mine.csv"));
    station.usual_reply.reset();
    station.slowest_reply = 61;
    station.unscaled = {57};
    answers.add(judge(file, station, "mine.csv"));
    answers.add(judge(file, station, "none.csv"));
    answers.add(judge("no GSD", station));
    station.profile = "of a site";
    answers.add(judge(file, station));
    EXPECT_THAT(answers.codes, IsSupersetOf(codes_in("src/configurator/station_check.cpp")));
}

} // namespace
} // namespace dpslave::test
