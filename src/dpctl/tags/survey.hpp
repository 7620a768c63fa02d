// SPDX-License-Identifier: Apache-2.0
/// What `dpctl survey` shows and writes.
#pragma once

#include "dpctl/cli/fields.hpp"

#include "dpslave/base/result.hpp"
#include "dpslave/io/fd.hpp"
#include "dpslave/profile/survey.hpp"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dpslave::dpctl {

/// The two files of a survey: the tag table, and beside it the record of what was read. Another survey that
/// would write the same ones is refused meanwhile.
class SurveyFiles {
public:
    /// `subject`: the station, and the rule where one is named; only its own record is continued.
    /// `begin_with`: a table whose rows are in the new one where there is no `table` yet; empty = none. The
    /// error is a sentence.
    static Result<SurveyFiles, std::string>
    open(const std::string& subject, std::filesystem::path table, const std::filesystem::path& begin_with,
         bool resume, profile::MnemonicCells mnemonics = profile::MnemonicCells::keep);

    /// Joins what was seen with the table as it is now and writes both files, each whole or not at all. The
    /// error is a sentence.
    std::optional<std::string> save();

    profile::Survey seen;
    const profile::SurveyedTable& joined() const { return joined_; } ///< of the last save()
    std::string table() const { return table_.string(); }
    std::string record() const { return record_.string(); }
    std::size_t rows_taken_over() const { return rows_taken_over_; } ///< of `begin_with`
    /// Why `begin_with` could not be read, a sentence; empty: it could, or it was not needed.
    const std::string& not_taken_over() const { return not_taken_over_; }

private:
    struct Text {
        std::string text; ///< of a tag table
    };
    void begin_with(const std::filesystem::path& file);
    Result<Text, std::string> table_now() const;
    std::optional<std::string> join(const Text& now);

    std::string subject_;
    profile::MnemonicCells mnemonics_ = profile::MnemonicCells::keep;
    std::filesystem::path table_, record_;
    std::string first_table_; ///< until `table_` is there
    std::size_t rows_taken_over_ = 0;
    std::string not_taken_over_;
    io::Fd lock_; ///< on the record
    profile::SurveyedTable joined_;
    std::vector<std::uint16_t> added_; ///< by this survey
};

/// "unwinder.survey.csv" beside "unwinder.csv".
std::filesystem::path record_beside(const std::filesystem::path& table);

/// What a survey has come to.
struct SurveyReport {
    std::string station, table, record;
    std::size_t tags = 0; ///< that there were to ask
    bool complete = false;
    profile::Survey seen; ///< of those
    profile::SurveyedTable joined;
};
Json survey_json(const SurveyReport& report);
std::string render_survey(const SurveyReport& report);

/// Where a survey stands.
struct SurveyProgress {
    std::size_t visited = 0, tags = 0, answering = 0, denied = 0, silent = 0;
    double share = 0;                         ///< of the whole, 0 to 1
    std::optional<std::chrono::seconds> left; ///< nothing: not measured yet
    bool is_time_given = false;               ///< `left` is what is left of the time given with --for
    bool waits_for_drive = false;             ///< it does not answer
};
/// "412 of 1612 tags asked: 58 answer, 354 denied, 0 silent; about 1 min 10 s left".
std::string progress_line(const SurveyProgress& progress);
/// "[######----] " before it.
std::string progress_bar(const SurveyProgress& progress);

} // namespace dpslave::dpctl
