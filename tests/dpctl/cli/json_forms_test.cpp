// SPDX-License-Identifier: Apache-2.0
// The forms of JSON in the manual page of dpctl have the names that are printed, all of them and no other.
#include "dpctl/decode/decode.hpp"
#include "dpctl/decode/hex.hpp"
#include "dpctl/doctor/doctor.hpp"
#include "dpctl/dpctl_bench.hpp"
#include "dpctl/identify/identify_report.hpp"
#include "dpctl/tags/render_tags.hpp"
#include "dpctl/tags/survey.hpp"
#include "dpctl/trace/line_entry.hpp"
#include "dpctl/trace/trace_text.hpp"
#include "dpctl/tune/tune.hpp"
#include "gsd/second_hand.hpp"

#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace dpslave::dpctl {
namespace {

using Names = std::set<std::string>;

/// The names in the form of each command, as the manual page has them.
std::map<std::string, Names> forms()
{
    std::istringstream page{test::content_of(test::kSource / "docs/man/dpctl.1.scd")};
    std::map<std::string, Names> found;
    std::string command, line;
    while (std::getline(page, line) && line != "# JSON") {
    }
    while (std::getline(page, line) && line != "```") {
    }
    while (std::getline(page, line) && line != "```") {
        if (line.front() != ' ') command = line.substr(0, line.find(' '));
        static const std::regex kName{"\"([a-z0-9_]+)\""};
        for (std::sregex_iterator at{line.begin(), line.end(), kName}, end; at != end; ++at)
            found[command].insert((*at)[1]);
    }
    return found;
}

/// The names in a document, down to what is a reply or a type of the interface.
void add_names(const Json& json, Names& to)
{
    static const Names kOfInterface{"station", "info",   "leds",      "tec",      "status", "counters",
                                    "io",      "events", "answering", "incident", "version"};
    if (json.is_array())
        for (const Json& item : json) add_names(item, to);
    if (!json.is_object()) return;
    for (const auto& [name, value] : json.items()) {
        to.insert(name);
        if (!kOfInterface.contains(name)) add_names(value, to);
    }
}

Names names_in(const std::vector<Json>& documents)
{
    Names names;
    for (const Json& document : documents) add_names(document, names);
    return names;
}

/// What the real program prints: a document, or one a line.
std::vector<Json> printed(std::vector<std::string> words)
{
    test::FixtureDaemon daemon;
    words.insert(words.end(), {"--json", "--socket", daemon.socket()});
    const std::string out = test::dpctl(words).out;
    if (Json whole = Json::parse(out, nullptr, false); !whole.is_discarded()) return {whole};
    std::vector<Json> lines;
    std::istringstream text{out};
    for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
    return lines;
}

Json tune()
{
    TuneFacts facts;
    facts.port.irq_thread.emplace();
    facts.bus.emplace().thread.emplace();
    return tune_json(facts, judge_rates(facts), {TuneFinding{}});
}

Json doctor()
{
    Replies replies;
    replies.status.bus.baud = 187'500;
    return doctor_json(replies, {{"", &rules()[0], "seen"}}, {Earlier{}});
}

Json survey()
{
    SurveyReport report;
    profile::SurveyAnswer answer;
    answer.kind = profile::SurveyAnswer::Kind::denied;
    report.seen[1].add(answer);
    return survey_json(report);
}

std::vector<Json> tags()
{
    const TagFiles files = load_tables(test::kSource / "config/profiles");
    TagHits hits;
    for (const TagFile& file : files.files)
        for (const drive::Tag& tag : file.tags.all()) hits.hits.push_back({&file, &tag});
    return {tags_json(hits), tables_json(files.files)};
}

std::vector<Json> trace()
{
    const trace::Entry entry;
    Json telegram = json_of(entry, words_of(entry), {});
    telegram["note"] = "";
    telegram["decoded"] = nullptr;
    return {telegram, json_of(LineEntry{}, "", {}), {{"what", "incident"}, {"incident", nullptr}}};
}

TEST(JsonForms, OfTheManualPageHaveTheNamesThatArePrinted)
{
    const std::map<std::string, Names> expected{
        {"show", names_in(printed({"show"}))},
        {"doctor", names_in({doctor(), rules_json()})},
        {"trace", names_in(trace())},
        {"top", names_in(printed({"top"}))},
        {"metrics", names_in(printed({"metrics"}))},
        {"survey", names_in({survey()})},
        {"tune", names_in({tune()})},
        {"tag", names_in(tags())},
        {"identify", names_in({identified_json({})})},
        {"hex", names_in({hex_json(*read_numbers("1"))})},
        {"decode", names_in({decoded_json(std::vector<Decoded>{
                       {.kind = {}, .hex = {}, .lines = {{}}, .octets = {{}}, .faults = {}}})})},
    };

    const auto found = forms();

    for (const auto& [command, names] : expected)
        EXPECT_EQ(found.contains(command) ? found.at(command) : Names{}, names) << command;
    EXPECT_EQ(found.size(), expected.size());
}

} // namespace
} // namespace dpslave::dpctl
