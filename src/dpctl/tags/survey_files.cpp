// SPDX-License-Identifier: Apache-2.0
#include "dpctl/cli/whole_file.hpp"
#include "survey.hpp"

#include "dpslave/input/text_source.hpp"
#include "dpslave/io/file.hpp"
#include "dpslave/profile/profile.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>

namespace dpslave::dpctl {
namespace {

/// A file that is to be replaced by another one: a device or a pipe must not be.
std::optional<std::string> no_file(const std::filesystem::path& file)
{
    std::error_code ignored;
    const bool is_other =
        std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored);
    return is_other ? std::optional{file.string() + ": it is not a regular file: name another one"}
                    : std::nullopt;
}

/// For as long as it is open no other survey takes `file`. Nothing: another one has it.
std::optional<io::Fd> lock_on(const std::filesystem::path& file)
{
    io::Fd open{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    const bool is_taken = open && ::flock(open.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    return is_taken ? std::nullopt : std::optional{std::move(open)}; // none where it is not there yet
}

std::string sentence(const input::Faults& faults)
{
    std::string all;
    for (const input::Fault& fault : faults) all += (all.empty() ? "" : "\n") + to_string(fault);
    return all;
}

} // namespace

std::filesystem::path record_beside(const std::filesystem::path& table)
{
    return table.parent_path() / (table.stem().string() + ".survey.csv");
}

Result<SurveyFiles, std::string> SurveyFiles::open(const std::string& subject, std::filesystem::path table,
                                                   const std::filesystem::path& begin_with, bool resume,
                                                   profile::MnemonicCells mnemonics)
{
    SurveyFiles files;
    files.subject_ = subject;
    files.mnemonics_ = mnemonics;
    files.table_ = std::move(table);
    files.record_ = record_beside(files.table_);
    for (const auto& file : {files.table_, files.record_})
        if (const auto other = no_file(file)) return Failure{*other};
    auto lock = lock_on(files.record_);
    if (!lock)
        return Failure{fmt::format(
            "{}: another survey writes this file: wait until it ends, or name another table with --output",
            files.record())};
    files.lock_ = *std::move(lock);
    files.begin_with(begin_with);
    if (resume) {
        const auto record = input::read_text(io::read_regular_file, files.record());
        if (!record)
            return Failure{to_string(record.error()) +
                           " There is no survey to continue: leave out --resume to begin one."};
        auto seen = profile::read_record(*record, files.record(), subject);
        if (!seen) return Failure{sentence(seen.error())};
        files.seen = *std::move(seen);
    }
    // Now rather than after an hour: can it be joined, and can it be written?
    const auto now = files.table_now();
    if (!now) return Failure{now.error()};
    if (const auto failed = files.join(*now)) return Failure{*failed};
    files.added_.clear();
    if (const auto failed = files.save()) return Failure{*failed};
    return files;
}

/// The rows of `file` are in a new table.
void SurveyFiles::begin_with(const std::filesystem::path& file)
{
    std::error_code ignored;
    if (file.empty() || std::filesystem::exists(table_, ignored)) return;
    auto first = input::read_text(io::read_regular_file, file.string());
    if (!first) {
        not_taken_over_ = to_string(first.error());
        return;
    }
    const auto tags = profile::read_tags(*first, file.string());
    if (!tags) not_taken_over_ = sentence(tags.error());
    rows_taken_over_ = tags ? tags->all().size() : 0;
    if (rows_taken_over_ > 0) first_table_ = *std::move(first);
}

/// What cannot be read must not be replaced.
Result<SurveyFiles::Text, std::string> SurveyFiles::table_now() const
{
    std::error_code ignored;
    if (!std::filesystem::exists(table_, ignored)) return Text{first_table_};
    auto now = io::read_regular_file(table());
    if (!now) return Failure{fmt::format("{}: it cannot be read: {}", table(), now.error().why)};
    return Text{*std::move(now)};
}

std::optional<std::string> SurveyFiles::join(const Text& now)
{
    auto joined = profile::merge_survey(now.text, table(), seen, mnemonics_);
    if (!joined) return sentence(joined.error());
    joined_ = *std::move(joined);
    added_.insert(added_.end(), joined_.added.begin(), joined_.added.end());
    std::sort(added_.begin(), added_.end());
    joined_.added = added_;
    return std::nullopt;
}

/// The record first: it holds what was read, even if an edit has made the table unreadable.
std::optional<std::string> SurveyFiles::save()
{
    if (const auto failed = write_file(record_, profile::record_text(seen, subject_), true))
        return fmt::format("{}: it cannot be written: {}", record(), failed->why);
    if (auto lock = lock_on(record_)) lock_ = *std::move(lock); // it is a new file
    const auto before = table_now();
    if (!before) return before.error();
    if (auto failed = join(*before)) return failed;
    std::error_code ignored;
    if (joined_.text == before->text && std::filesystem::exists(table_, ignored)) return std::nullopt;
    if (const auto failed = write_file(table_, joined_.text, true))
        return fmt::format("{}: it cannot be written: {}", table(), failed->why);
    return std::nullopt;
}

} // namespace dpslave::dpctl
