// SPDX-License-Identifier: Apache-2.0
#include "tag_search.hpp"

#include "dpslave/base/letters.hpp"
#include "dpslave/base/number.hpp"
#include "dpslave/io/file.hpp"

#include <algorithm>
#include <cctype>
#include <optional>

namespace dpslave::dpctl {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

bool is_alphanumeric(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

bool is_number(std::string_view word)
{
    return !word.empty() &&
           std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The runs of letters and digits, in lower case.
Words words_of(std::string_view text)
{
    Words words;
    bool inside = false;
    for (const char c : text) {
        if (is_alphanumeric(c)) {
            if (!inside) words.emplace_back();
            words.back() += to_lower(c);
        }
        inside = is_alphanumeric(c);
    }
    return words;
}

/// 270, 0x10E, >10E.
std::optional<std::uint16_t> tag_number(std::string_view text)
{
    const auto number = text.starts_with('>') ? read_number("0x" + std::string{text.substr(1)}, 0, 0xFFFF)
                                              : read_number(text, 0, 0xFFFF);
    return number ? std::optional{static_cast<std::uint16_t>(*number)} : std::nullopt;
}

/// Is `wanted` in `words`, and, where it is a number, behind a word with `before` (empty = anywhere)?
bool occurs(const Words& words, const std::string& wanted, const std::string& before)
{
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (!is_number(wanted)) {
            if (words[i].find(wanted) != std::string::npos) return true;
        } else if (words[i] == wanted &&
                   (before.empty() || (i > 0 && words[i - 1].find(before) != std::string::npos))) {
            return true;
        }
    }
    return false;
}

bool says_nothing_more(const Words& name, const Words& query)
{
    return std::all_of(name.begin(), name.end(), [&query](const std::string& word) {
        return std::any_of(query.begin(), query.end(), [&word](const std::string& wanted) {
            return is_number(word) || is_number(wanted) ? word == wanted
                                                        : word.find(wanted) != std::string::npos;
        });
    });
}

enum class Match { none, part, exact };

Match match(const drive::Tag& tag, const Words& query)
{
    Words names{tag.name};
    names.insert(names.end(), tag.aliases.begin(), tag.aliases.end());
    const Words section = words_of(tag.section);
    Match best = Match::none;
    for (const std::string& name : names) {
        const Words words = words_of(name);
        std::string before;
        bool all = true;
        for (const std::string& wanted : query) {
            all = all && (occurs(words, wanted, before) || occurs(section, wanted, before));
            before = is_number(wanted) ? std::string{} : wanted;
        }
        if (all) best = std::max(best, says_nothing_more(words, query) ? Match::exact : Match::part);
    }
    return best;
}

void collect_faults(const input::Faults& from, std::vector<std::string>& into)
{
    for (const input::Fault& fault : from) into.push_back(to_string(fault));
}

/// What the profile adds to what is known of its table.
void add_device(TagFile& file, const profile::Profile& profile)
{
    if (file.devices.empty()) {
        file.mnemonics = profile.mnemonics;
        file.extended_demand = false;
    }
    file.devices.push_back({profile.name, profile.device});
    file.extended_demand = file.extended_demand || profile.personality.demand == dp::DemandForm::extended;
    for (const std::uint16_t tag : profile.never_written)
        if (std::find(file.never_written.begin(), file.never_written.end(), tag) == file.never_written.end())
            file.never_written.push_back(tag);
}

} // namespace

TagFiles load_table(const fs::path& file)
{
    TagFiles result;
    auto tags = profile::load_tags(io::read_regular_file, file.string());
    if (tags)
        result.files.push_back({.name = file.filename().string(),
                                .tags = *std::move(tags),
                                .devices = {},
                                .mnemonics = drive::MnemonicRule::none,
                                .extended_demand = true,
                                .never_written = {}});
    else
        collect_faults(tags.error(), result.faults);
    return result;
}

TagFiles load_table_of(const fs::path& profiles, const std::string& name)
{
    TagFiles result;
    auto profile = profile::load_profile(io::read_regular_file, profiles.string(), name);
    if (!profile) {
        collect_faults(profile.error(), result.faults);
        return result;
    }
    TagFile& file = result.files.emplace_back();
    file.name = fs::path{profile->tag_file}.filename().string();
    file.tags = profile->tags;
    add_device(file, *profile);
    return result;
}

TagFiles load_tables(const fs::path& profiles)
{
    TagFiles result;
    std::vector<fs::path> paths;
    std::error_code error;
    for (fs::directory_iterator entry{profiles / ".." / "tags", error}, end; !error && entry != end;
         entry.increment(error))
        if (entry->path().extension() == ".csv") paths.push_back(entry->path().lexically_normal());
    if (error)
        result.faults.push_back((profiles / ".." / "tags").lexically_normal().string() + ": " +
                                error.message() +
                                "; name the folder of profiles beside it with --profiles DIR");
    std::sort(paths.begin(), paths.end());
    for (const fs::path& path : paths) {
        TagFiles one = load_table(path);
        for (TagFile& file : one.files) result.files.push_back(std::move(file));
        result.faults.insert(result.faults.end(), one.faults.begin(), one.faults.end());
    }
    for (const std::string& name : io::names_in(profiles.string(), ".toml")) {
        const auto profile = profile::load_profile(io::read_regular_file, profiles.string(), name);
        if (!profile) {
            collect_faults(profile.error(), result.faults);
            continue;
        }
        for (TagFile& file : result.files)
            if (fs::path{profile->tag_file}.filename() == file.name) add_device(file, *profile);
    }
    return result;
}

TagHits search(const std::vector<TagFile>& files, const std::vector<std::string>& query, bool all)
{
    TagHits exact, part;
    std::vector<std::uint16_t> numbers;
    Words words;
    for (const std::string& word : query) {
        if (const auto number = tag_number(word)) numbers.push_back(*number);
        for (std::string& one : words_of(word)) words.push_back(std::move(one));
    }
    const bool by_number = numbers.size() == query.size();
    for (const TagFile& file : files) {
        if (by_number) {
            for (const std::uint16_t number : numbers)
                if (const drive::Tag* tag = file.tags.find(number)) part.hits.push_back({&file, tag});
            continue;
        }
        for (const drive::Tag* tag : file.tags.in_table_order()) {
            const Match found = match(*tag, words);
            if (found == Match::exact) exact.hits.push_back({&file, tag});
            if (found == Match::part || (found == Match::exact && all)) part.hits.push_back({&file, tag});
        }
    }
    if (exact.hits.empty() || all) return part;
    exact.left_out = part.hits.size();
    return exact;
}

} // namespace dpslave::dpctl
