// SPDX-License-Identifier: Apache-2.0
/// Makes a tag table from the answers of a drive. It keeps the answers of each tag and their record as a
/// file, and says which tag is asked next, how long that takes, and what the rows of the table are. It is
/// pure: texts and times go in, texts come out.
#pragma once

#include "dpslave/base/result.hpp"
#include "dpslave/base/typed.hpp"
#include "dpslave/input/fault.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dpslave::profile {

/// "1-600, 1000". `tags`: ascending.
std::string spans_text(std::span<const std::uint16_t> tags);

/// The result of one survey read.
struct SurveyAnswer {
    enum class Kind : std::uint8_t {
        text,    ///< EI-ASCII: what lies between mnemonic and ETX
        word,    ///< Modbus: the 16 bits, there is no text
        denied,  ///< the drive refused; `text` says why
        silence, ///< no answer to this read, which may be the line
    };
    Kind kind = Kind::silence;
    std::string text;
    std::uint16_t word = 0;
};

/// The form of a tag's answer.
enum class SurveyForm : std::uint8_t {
    none,        ///< it never did
    number,      ///< "-12.5", "30."
    hexadecimal, ///< ">1B0B"
    other,       ///< a text
    mixed,       ///< more than one of these: no row can be made
    word,        ///< Modbus: 16 bits without a known form
};
std::string_view text(SurveyForm form) noexcept;

/// A decimal number as written in an answer: 12.50 is 1250 with 2 decimals.
struct SeenNumber {
    std::int64_t counts = 0;
    unsigned decimals = 0;
};
std::string text(SeenNumber number);

/// All that was seen of one tag.
struct Sighting {
    std::string mnemonic; ///< that it was asked by; empty with Modbus
    std::uint32_t answers = 0;
    std::uint32_t silences = 0;
    std::uint32_t denials = 0;
    SurveyForm form = SurveyForm::none;
    unsigned digits = 0; ///< hexadecimal: most digits of an answer
    unsigned decimals =
        0; ///< number: most decimals of an answer. The drive leaves out zeros, so a lower bound
    SeenNumber lowest, highest; ///< of number, hexadecimal and word
    std::string last;           ///< the last answer
    std::string denied;         ///< why, the last time; empty: never

    std::uint32_t asked() const { return answers + silences + denials; }
    void add(const SurveyAnswer& answer);
};

/// The results of a survey, by tag.
using Survey = std::map<std::uint16_t, Sighting>;

/// The record of a survey as a CSV file, from which it can go on. Each row names the station, and the record
/// of another station is refused.
std::string record_text(const Survey& survey, std::string_view station);
Result<Survey, input::Faults> read_record(std::string_view content, const std::string& file,
                                          std::string_view station);

/// Decides which tag is asked next: of the tags that are still wanted the one that was asked least,
/// ascending. A tag that was only ever denied is asked once; one that never answered three times, because a
/// fault of the line may be the reason.
class SurveyPlan {
public:
    /// `tags`: ascending. `passes`: how often each tag is to be asked; 0 = without end.
    SurveyPlan(std::vector<TagSpan> tags, std::uint32_t passes) : spans_(std::move(tags)), passes_(passes) {}

    /// Returns the next tag after what `seen` has by now; nullopt if the survey is over.
    std::optional<std::uint16_t> next(const Survey& seen);
    /// Reads that are left, where there is an end to the passes: of tags that were not asked yet as many as
    /// the others took on the average.
    std::size_t left(const Survey& seen) const;
    std::size_t tags() const; ///< that there are to ask

private:
    bool is_wanted(const Sighting& one) const;

    std::vector<TagSpan> spans_;
    std::uint32_t passes_;
    std::vector<std::uint16_t> round_; ///< tags that were asked equally often, and less than any other
    std::size_t at_ = 0;
};

/// Measures how fast a survey goes, by its last reads.
class SurveyPace {
public:
    void took(std::chrono::nanoseconds one);
    /// Returns how long `reads` more will take at the pace of the last 64 reads; nullopt before the eighth.
    std::optional<std::chrono::seconds> time_for(std::size_t reads) const;

private:
    static constexpr std::size_t kWindow = 64, kEnough = 8;
    std::array<std::chrono::nanoseconds, kWindow> window_{};
    std::size_t count_ = 0;
};

/// Says how long a survey waits for a drive that does not answer, or for another survey to end: 30 s. If a
/// time is given it waits for the drive until that is over. Times count from the begin of the survey.
class SurveyPatience {
public:
    enum class Verdict : std::uint8_t { wait, no_drive, other_survey, time_is_over };

    explicit SurveyPatience(std::optional<std::chrono::seconds> time) : time_(time) {}
    bool is_time_over(std::chrono::nanoseconds now) const { return time_ && now >= *time_; }
    Verdict waits(bool for_drive, std::chrono::nanoseconds now);
    void was_answered() { since_.reset(); }

private:
    static constexpr std::chrono::seconds kLongest{30};
    std::optional<std::chrono::seconds> time_;
    std::optional<std::chrono::nanoseconds> since_;
};

/// A tag table after a survey.
struct SurveyedTable {
    std::string text;                        ///< the CSV file as a whole
    std::vector<std::uint16_t> added;        ///< tags with a new row
    std::vector<std::uint16_t> waiting;      ///< rows with confirmed = no, the new ones among them
    std::vector<std::string> contradictions; ///< what the drive answered against a row, a sentence each
};

/// Says what a survey does with confirmed rows without a mnemonic.
enum class MnemonicCells : std::uint8_t {
    keep,
    fill, ///< the one that it was asked by, where the drive answered and the row agrees: the table needs no
          ///< rule
};

/// Joins what was seen with `table`, the text of a tag table; empty, or nothing but a byte order mark = there
/// is none yet. New rows have confirmed = no; rows with confirmed = no are widened (more decimals, further
/// extremes) and keep their other cells; every other row stays as it is, octet by octet, but for the cells of
/// new columns and MnemonicCells. Faults: `table` is no tag table.
Result<SurveyedTable, input::Faults> merge_survey(std::string_view table, const std::string& file,
                                                  const Survey& seen,
                                                  MnemonicCells mnemonics = MnemonicCells::keep);

} // namespace dpslave::profile
