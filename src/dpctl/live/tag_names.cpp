// SPDX-License-Identifier: Apache-2.0
#include "tag_names.hpp"

#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/number.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/base/typed.hpp"
#include "dpslave/input/wording.hpp"
#include "dpslave/report/replies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kMostShown = 20; ///< of several tags that a name fits

/// The parts of a name that have so many words as were written: a name may have many more.
std::vector<std::string> parts_of(const std::string& name, std::size_t words)
{
    std::vector<std::size_t> begins{0};
    for (std::size_t i = 1; i < name.size(); ++i)
        if (name[i - 1] == ' ' && name[i] != ' ') begins.push_back(i);
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < begins.size(); ++i) {
        const std::size_t end = i + words < begins.size() ? begins[i + words] - 1 : name.size();
        parts.push_back(name.substr(begins[i], end - begins[i]));
    }
    return parts;
}

/// The name that has the part which is nearest to what was written; empty: none is near.
std::string nearest_tag(const std::string& written, const std::string& station, Session& session)
{
    const auto json = session.ask("FindTags", station_parameter(station));
    if (!json) return {};
    const std::string wanted = to_lower(written);
    const auto words = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), ' ')) + 1;
    std::map<std::string, std::string> names; // by part
    std::vector<std::string> parts;
    for (const report::NamedTag& one : report::read<report::FindTagsReply>(*json).tags)
        for (const std::string& part : parts_of(to_lower(one.name), words))
            if (names.emplace(part, one.name).second) parts.push_back(part);
    const std::string_view near = input::nearest(wanted, parts);
    return near.empty() ? std::string{} : names.at(std::string{near});
}

bool is_whole(const std::string& name, const std::string& wanted)
{
    return name == wanted;
}
bool begins_so(const std::string& name, const std::string& wanted)
{
    return name.starts_with(wanted);
}

/// Those of `found` whose names fit, case aside.
std::vector<report::NamedTag> those_of(const report::FindTagsReply& found, const std::string& wanted,
                                       bool (*fits)(const std::string&, const std::string&))
{
    std::vector<report::NamedTag> those;
    for (const report::NamedTag& one : found.tags)
        if (fits(to_lower(one.name), to_lower(wanted))) those.push_back(one);
    return those;
}

/// The tags that have `name` in their names. The failure is an exit status.
Result<report::FindTagsReply, int> tags_named(const std::string& name, const std::string& station,
                                              Session& session)
{
    Json parameters = station_parameter(station);
    parameters["name"] = name;
    const auto json = session.ask("FindTags", parameters);
    if (!json) return Failure{json.error()};
    return report::read<report::FindTagsReply>(*json);
}

Result<std::int64_t, int> find_tag(const std::string& name, const std::string& station, Session& session)
{
    Terminal& terminal = session.terminal();
    auto found = tags_named(name, station, session);
    if (!found) return Failure{found.error()};
    for (const auto fits : {is_whole, begins_so})
        if (const auto those = those_of(*found, name, fits); those.size() == 1) return those.front().tag;
    if (found->tags.size() == 1) return found->tags.front().tag;
    const std::string shown = printable(found->station), wanted = printable(name);
    if (found->tags.empty()) {
        const std::string near = printable(nearest_tag(name, station, session));
        terminal.err << fmt::format(
            "dpctl: no tag of {} has '{}' in its name; {}dpctl read --names prints the names\n", shown,
            wanted, near.empty() ? near : fmt::format("did you mean '{}'? ", near));
        return Failure{static_cast<int>(kUsage)};
    }
    for (report::NamedTag& one : found->tags) one.name = printable(one.name);
    terminal.err << fmt::format("dpctl: '{}' fits {} tags of {}:\n{}", wanted, found->tags.size(), shown,
                                tag_lines(found->tags, kMostShown, terminal.look()));
    if (found->tags.size() > kMostShown)
        terminal.err << fmt::format("  and {} more\n", found->tags.size() - kMostShown);
    terminal.err << "Write the number, or more of the name.\n";
    return Failure{static_cast<int>(kUsage)};
}

} // namespace

std::string tag_lines(const std::vector<report::NamedTag>& tags, std::size_t most, Look look)
{
    Table table({">TAG", "NAME"});
    for (std::size_t i = 0; i < tags.size() && i < most; ++i)
        table.add({std::to_string(tags[i].tag), tags[i].name});
    return table.empty() ? std::string{} : table.str(look, 2);
}

Result<std::vector<std::int64_t>, int> find_tags(const std::vector<std::string>& words,
                                                 const std::string& station, Session& session)
{
    std::vector<std::int64_t> tags;
    for (const std::string& word : words) {
        const auto typed = read_tags(word);
        if (!typed) continue; // the command line was judged
        for (const TypedTag& one : *typed) {
            if (one.name.empty()) {
                for (std::int64_t tag = one.span.first; tag <= one.span.last; ++tag) tags.push_back(tag);
                continue;
            }
            const auto tag = find_tag(one.name, station, session);
            if (!tag) return Failure{tag.error()};
            tags.push_back(*tag);
        }
    }
    return tags;
}

Result<std::int64_t, int> find_whole_tag(const std::string& word, const std::string& station,
                                         Session& session)
{
    constexpr std::int64_t kLast = 0xFFFF;
    if (const auto number = read_number(word, 0, kLast)) return *number;
    const auto found = tags_named(word, station, session);
    if (!found) return Failure{found.error()};
    const auto whole = those_of(*found, word, is_whole);
    if (whole.size() == 1) return whole.front().tag;
    std::ostream& err = session.terminal().err;
    err << fmt::format("dpctl: no tag of {} is called '{}': write the number, or the whole name\n",
                       printable(found->station), printable(word));
    if (!found->tags.empty()) err << tag_lines(found->tags, kMostShown, session.terminal().look());
    return Failure{static_cast<int>(kUsage)};
}

} // namespace dpslave::dpctl
