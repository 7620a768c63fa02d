// SPDX-License-Identifier: Apache-2.0
#include "tag_names.hpp"

#include "dpctl/cli/ask.hpp"
#include "dpctl/cli/fields.hpp"
#include "dpctl/cli/table.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/printable.hpp"
#include "dpslave/profile/survey.hpp"
#include "dpslave/report/replies.hpp"
#include "dpslave/toml/wording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>

namespace dpslave::dpctl {
namespace {

constexpr std::size_t kMostShown = 20; ///< of several tags that a name fits

std::string tag_lines(const std::vector<report::NamedTag>& tags, std::size_t most, Look look)
{
    Table table({">TAG", "NAME"});
    for (std::size_t i = 0; i < tags.size() && i < most; ++i)
        table.add({std::to_string(tags[i].tag), tags[i].name});
    return table.empty() ? std::string{} : table.str(look, 2);
}

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
std::string nearest_tag(const std::string& written, const Options& options, Terminal& terminal)
{
    const auto json = ask(options, terminal, "FindTags", station_parameter(options));
    if (!json) return {};
    const std::string wanted = to_lower(written);
    const auto words = static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), ' ')) + 1;
    std::map<std::string, std::string> names; // by part
    std::vector<std::string> parts;
    for (const report::NamedTag& one : report::read<report::FindTagsReply>(*json).tags)
        for (const std::string& part : parts_of(to_lower(one.name), words))
            if (names.emplace(part, one.name).second) parts.push_back(part);
    const std::string_view near = toml::nearest(wanted, parts);
    return near.empty() ? std::string{} : names.at(std::string{near});
}

Result<std::int64_t, int> find_tag(const std::string& name, const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    parameters["name"] = name;
    const auto json = ask(options, terminal, "FindTags", parameters);
    if (!json) return Failure{json.error()};
    auto found = report::read<report::FindTagsReply>(*json);
    if (found.tags.size() == 1) return found.tags.front().tag;
    const std::string station = printable(found.station), wanted = printable(name);
    if (found.tags.empty()) {
        const std::string near = printable(nearest_tag(name, options, terminal));
        terminal.err << fmt::format(
            "dpctl: no tag of {} has '{}' in its name; {}dpctl read --list prints the names\n", station,
            wanted, near.empty() ? near : fmt::format("did you mean '{}'? ", near));
        return Failure{static_cast<int>(kUsage)};
    }
    for (report::NamedTag& one : found.tags) one.name = printable(one.name);
    terminal.err << fmt::format("dpctl: '{}' fits {} tags of {}:\n{}", wanted, found.tags.size(), station,
                                tag_lines(found.tags, kMostShown, terminal.look()));
    if (found.tags.size() > kMostShown)
        terminal.err << fmt::format("  and {} more\n", found.tags.size() - kMostShown);
    terminal.err << "Write the number, or more of the name.\n";
    return Failure{static_cast<int>(kUsage)};
}

} // namespace

std::optional<std::chrono::milliseconds> parse_interval(std::string_view text)
{
    constexpr std::int64_t kShortest = 100;
    if (!text.ends_with("ms")) return profile::parse_duration(text);
    text.remove_suffix(2);
    std::int64_t count = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), count);
    constexpr std::int64_t kLongest = 1'000'000'000; // 11 days
    if (fault != std::errc{} || end != text.data() + text.size() || count < kShortest || count > kLongest)
        return std::nullopt;
    return std::chrono::milliseconds{count};
}

Result<std::vector<std::int64_t>, int> find_tags(const Options& options, Terminal& terminal)
{
    std::vector<std::int64_t> tags;
    for (const std::string& word : options.words) {
        const bool is_number = word.find_first_not_of("0123456789") == std::string::npos;
        const auto tag = is_number ? Result<std::int64_t, int>{std::int64_t{std::stoi(word)}}
                                   : find_tag(word, options, terminal);
        if (!tag) return Failure{tag.error()};
        tags.push_back(*tag);
    }
    return tags;
}

int list_tags(const Options& options, Terminal& terminal)
{
    Json parameters = station_parameter(options);
    if (!options.words.empty()) parameters["name"] = joined(options.words, " ");
    return show(options, terminal, "FindTags", parameters, [&](const Json& reply) {
        const auto found = report::read<report::FindTagsReply>(reply);
        if (found.tags.empty()) return fmt::format("no tag of {} has such a name\n", found.station);
        return tag_lines(found.tags, found.tags.size(), terminal.look());
    });
}

} // namespace dpslave::dpctl
