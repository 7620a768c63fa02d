// SPDX-License-Identifier: Apache-2.0
#include "gsd_files.hpp"
#include "survey.hpp"

#include "dpslave/profile/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace dpslave::dpctl {
namespace {

/// Nothing: there is no such file, or it cannot be read. What is no regular file is never waited for.
std::optional<std::string> content_of(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return std::nullopt;
    std::ifstream in{file, std::ios::binary};
    std::ostringstream text;
    text << in.rdbuf();
    return in.good() ? std::optional{text.str()} : std::nullopt;
}

/// A file that is to be replaced by another one: a device or a pipe must not be.
std::optional<std::string> no_file(const std::filesystem::path& file)
{
    std::error_code ignored;
    const bool is_other =
        std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
    return is_other ? std::optional{file.string() + ": it is no regular file: name another one"}
                    : std::nullopt;
}

std::string sentence(const profile::Faults& faults)
{
    std::string all;
    for (const profile::Fault& fault : faults) all += (all.empty() ? "" : "\n") + to_string(fault);
    return all;
}

} // namespace

std::filesystem::path record_beside(const std::filesystem::path& table)
{
    return table.parent_path() / (table.stem().string() + ".survey.csv");
}

Result<SurveyFiles, std::string> SurveyFiles::open(std::filesystem::path table,
                                                   const std::filesystem::path& begin_with, bool resume)
{
    SurveyFiles files;
    files.table_ = std::move(table);
    files.record_ = record_beside(files.table_);
    for (const auto& file : {files.table_, files.record_})
        if (const auto other = no_file(file)) return Failure{*other};
    std::error_code ignored;
    if (!begin_with.empty() && !std::filesystem::exists(files.table_, ignored)) {
        std::string first = content_of(begin_with).value_or("");
        const auto tags = profile::read_tags(first, begin_with.string());
        files.rows_taken_over_ = tags ? tags->all().size() : 0;
        if (files.rows_taken_over_ > 0) files.first_table_ = std::move(first);
    }
    if (resume) {
        const auto record = content_of(files.record_);
        if (!record)
            return Failure{fmt::format("{}: it cannot be read, so there is no survey to go on with: leave "
                                       "--resume out to begin one",
                                       files.record())};
        auto seen = profile::read_record(*record, files.record());
        if (!seen) return Failure{sentence(seen.error())};
        files.seen = *std::move(seen);
    }
    // Now rather than after an hour: can it be joined, and can it be written?
    if (const auto failed = files.join(files.table_now())) return Failure{*failed};
    files.added_.clear();
    if (const auto failed = files.save()) return Failure{*failed};
    return files;
}

std::string SurveyFiles::table_now() const
{
    return content_of(table_).value_or(first_table_);
}

std::optional<std::string> SurveyFiles::join(const std::string& table_text)
{
    auto joined = profile::merge_survey(table_text, table(), seen);
    if (!joined) return sentence(joined.error());
    joined_ = *std::move(joined);
    added_.insert(added_.end(), joined_.added.begin(), joined_.added.end());
    std::sort(added_.begin(), added_.end());
    joined_.added = added_;
    return std::nullopt;
}

/// The record first: it holds what was read, even where the table has become none under the hands of a
/// person.
std::optional<std::string> SurveyFiles::save()
{
    if (const auto failed = write_file(record_, profile::record_text(seen), true))
        return fmt::format("{}: it cannot be written: {}", record(), failed->why);
    const std::string before = table_now();
    if (auto failed = join(before)) return failed;
    std::error_code ignored;
    if (joined_.text == before && std::filesystem::exists(table_, ignored)) return std::nullopt;
    if (const auto failed = write_file(table_, joined_.text, true))
        return fmt::format("{}: it cannot be written: {}", table(), failed->why);
    return std::nullopt;
}

} // namespace dpslave::dpctl
